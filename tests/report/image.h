// What is here: a PNG file read back, pixel by pixel.
#pragma once

#include <cairo.h>

#include <cstdint>
#include <filesystem>

namespace perfora::report::testing {

/// A picture of the file; one of no size where it cannot be read.
struct Image {
  explicit Image(const std::filesystem::path& path) : surface(cairo_image_surface_create_from_png(path.c_str())) {}
  ~Image() { cairo_surface_destroy(surface); }
  Image(const Image&) = delete;
  Image& operator=(const Image&) = delete;
  int width() const { return cairo_image_surface_get_width(surface); }
  int height() const { return cairo_image_surface_get_height(surface); }
  /// 0xrrggbb
  unsigned at(int x, int y) const {
    const unsigned char* row = cairo_image_surface_get_data(surface) + y * cairo_image_surface_get_stride(surface);
    return reinterpret_cast<const std::uint32_t*>(row)[x] & 0xffffffu;
  }
  cairo_surface_t* surface;
};

}  // namespace perfora::report::testing
