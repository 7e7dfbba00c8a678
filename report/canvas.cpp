// What is here: the page over cairo. What is not: what is drawn on it.
#include "report/canvas.h"

#include <cairo-pdf.h>
#include <cairo-svg.h>

#include <algorithm>
#include <cmath>
#include <new>
#include <numbers>
#include <stdexcept>

#include "io/error.h"
#include "io/files.h"
#include "io/letters.h"

namespace perfora::report {
namespace {

constexpr const char* font = "DejaVu Sans";
/// Page units of vector files are points; half a point a unit makes the picture fit on a landscape A4 sheet.
constexpr double points_per_unit = 0.5;

cairo_status_t append_bytes(void* target, const unsigned char* data, unsigned length) {
  try {
    static_cast<std::string*>(target)->append(reinterpret_cast<const char*>(data), length);
  } catch (const std::bad_alloc&) {  // must not pass through cairo
    return CAIRO_STATUS_NO_MEMORY;
  }
  return CAIRO_STATUS_SUCCESS;
}

std::string lower_extension(const std::filesystem::path& path) {
  return io::lower(path.extension().string());
}

}  // namespace

Colour mix(const Colour& a, const Colour& b, double fraction) {
  return {a.red + (b.red - a.red) * fraction, a.green + (b.green - a.green) * fraction,
          a.blue + (b.blue - a.blue) * fraction};
}

const std::vector<Colour>& palette::series() {
  static const std::vector<Colour> colours = {hex(0x0072b2), hex(0xe69f00), hex(0x009e73), hex(0xcc79a7),
                                              hex(0x56b4e9), hex(0xd55e00), hex(0x882255), hex(0x999933)};
  return colours;
}

const std::vector<Colour>& palette::fragments() {
  static const std::vector<Colour> colours = {hex(0x6fb3dd), hex(0xeab544), hex(0x4fae94), hex(0xd69abd),
                                              hex(0x3f7fb5), hex(0xe3da7b), hex(0x8fcbb9), hex(0x9b86bd),
                                              hex(0xb9aa4c), hex(0xa8cfe8)};
  return colours;
}

void set_colour(cairo_t* context, const Colour& colour, double opacity) {
  cairo_set_source_rgba(context, colour.red, colour.green, colour.blue, opacity);
}

Canvas::Canvas(std::filesystem::path path, double width, double height)
    : path_(std::move(path)), width_(width), height_(height) {
  const std::string extension = lower_extension(path_);
  vector_ = extension == ".svg" || extension == ".pdf";
  if (!vector_ && extension != ".png")
    throw io::InputError(
        {path_.string(), 0, ""},
        extension.empty() ? "the picture has no extension" : "no pictures of kind \"" + extension + "\"",
        ".png, .svg or .pdf", "name the output with one of these");
  if (extension == ".svg") {
    surface_ =
        cairo_svg_surface_create_for_stream(append_bytes, &bytes_, width * points_per_unit, height * points_per_unit);
  } else if (extension == ".pdf") {
    surface_ =
        cairo_pdf_surface_create_for_stream(append_bytes, &bytes_, width * points_per_unit, height * points_per_unit);
  } else {
    surface_ = cairo_image_surface_create(CAIRO_FORMAT_RGB24, static_cast<int>(width), static_cast<int>(height));
  }
  context_ = cairo_create(surface_);
  if (vector_) cairo_scale(context_, points_per_unit, points_per_unit);
  fill({0.0, 0.0, width_, height_}, palette::paper);
}

Canvas::~Canvas() {
  cairo_destroy(context_);
  cairo_surface_destroy(surface_);
}

namespace {

void choose_font(cairo_t* context, const TextStyle& style) {
  cairo_select_font_face(context, font, CAIRO_FONT_SLANT_NORMAL,
                         style.bold ? CAIRO_FONT_WEIGHT_BOLD : CAIRO_FONT_WEIGHT_NORMAL);
  cairo_set_font_size(context, style.size);
}

double start_of(Align align, double width) {
  if (align == Align::left) return 0.0;
  return align == Align::centre ? -width / 2.0 : -width;
}

/// Draws at the current origin.
void show(cairo_t* context, double x, double y, const std::string& text, const TextStyle& style) {
  if (style.halo) {
    cairo_move_to(context, x, y);
    cairo_text_path(context, text.c_str());
    set_colour(context, palette::paper, 0.9);
    cairo_set_line_width(context, 5.0);
    cairo_set_line_join(context, CAIRO_LINE_JOIN_ROUND);
    cairo_stroke(context);
  }
  set_colour(context, style.colour);
  cairo_move_to(context, x, y);
  cairo_show_text(context, text.c_str());
  cairo_new_path(context);
}

}  // namespace

double Canvas::text_width(const std::string& text, const TextStyle& style) {
  choose_font(context_, style);
  cairo_text_extents_t extents;
  cairo_text_extents(context_, text.c_str(), &extents);
  return extents.x_advance;
}

void Canvas::text(double x, double y, const std::string& text, const TextStyle& style) {
  const double start = x + start_of(style.align, text_width(text, style));
  show(context_, start, y, text, style);
}

void Canvas::text_upright(double x, double y, const std::string& text, const TextStyle& style) {
  const double width = text_width(text, style);
  cairo_save(context_);
  cairo_translate(context_, x, y);
  cairo_rotate(context_, -std::numbers::pi / 2.0);
  show(context_, -width / 2.0, style.size * 0.35, text, style);
  cairo_restore(context_);
}

std::string Canvas::fit(const std::string& text, double width, const TextStyle& style, Keep keep) {
  if (text_width(text, style) <= width) return text;
  std::string shorter = text;
  const auto shown = [&] { return keep == Keep::begin ? shorter + "..." : "..." + shorter; };
  const auto continues = [](char c) { return (static_cast<unsigned char>(c) & 0xc0u) == 0x80u; };
  while (!shorter.empty() && text_width(shown(), style) > width) {  // whole characters of UTF-8
    if (keep == Keep::begin) {
      while (shorter.size() > 1 && continues(shorter.back())) shorter.pop_back();
      shorter.pop_back();
    } else {
      shorter.erase(0, 1);
      while (!shorter.empty() && continues(shorter.front())) shorter.erase(0, 1);
    }
  }
  return shown();
}

void Canvas::line(double x0, double y0, double x1, double y1, const Colour& colour, double thickness,
                  const std::vector<double>& dashes) {
  set_colour(context_, colour);
  cairo_set_line_width(context_, thickness);
  cairo_set_dash(context_, dashes.data(), static_cast<int>(dashes.size()), 0.0);
  cairo_move_to(context_, x0, y0);
  cairo_line_to(context_, x1, y1);
  cairo_stroke(context_);
  cairo_set_dash(context_, nullptr, 0, 0.0);
}

void Canvas::fill(const Box& box, const Colour& colour, double opacity) {
  set_colour(context_, colour, opacity);
  cairo_rectangle(context_, box.x, box.y, box.width, box.height);
  cairo_fill(context_);
}

void Canvas::frame(const Box& box, const Colour& colour, double thickness) {
  set_colour(context_, colour);
  cairo_set_line_width(context_, thickness);
  cairo_rectangle(context_, box.x, box.y, box.width, box.height);
  cairo_stroke(context_);
}

void Canvas::disc(double x, double y, double radius, const Colour& fill, const Colour& rim, double rim_thickness) {
  cairo_new_path(context_);
  cairo_arc(context_, x, y, radius, 0.0, 2.0 * std::numbers::pi);
  set_colour(context_, fill);
  cairo_fill_preserve(context_);
  set_colour(context_, rim);
  cairo_set_line_width(context_, rim_thickness);
  cairo_stroke(context_);
}

void Canvas::badge(double x, double y, const std::string& letter) {
  disc(x, y, 11.5, palette::ink, palette::paper, 2.0);
  text(x, y + 5.5, letter, {.size = 15.0, .colour = palette::paper, .bold = true, .align = Align::centre});
}

void Canvas::write() {
  cairo_status_t status = cairo_status(context_);
  if (vector_) {
    cairo_show_page(context_);
    cairo_surface_finish(surface_);
  } else {
    cairo_surface_flush(surface_);
    const cairo_status_t written = cairo_surface_write_to_png_stream(surface_, append_bytes, &bytes_);
    if (status == CAIRO_STATUS_SUCCESS) status = written;
  }
  if (status == CAIRO_STATUS_SUCCESS) status = cairo_surface_status(surface_);
  if (status == CAIRO_STATUS_NO_MEMORY) throw std::bad_alloc();
  if (status != CAIRO_STATUS_SUCCESS)
    throw std::runtime_error(path_.string() + ": the picture was not drawn: " + cairo_status_to_string(status));
  io::write_file(path_, bytes_);
}

}  // namespace perfora::report
