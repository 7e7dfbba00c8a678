// What is here: a page to draw on (PNG, SVG or PDF by extension) with text, colours and boxes.
// What is not: axes (chart.h), blocks (block_picture.h). Internal to this room: the only headers that name cairo are
// this one and its users'.
#pragma once

#include <cairo.h>

#include <filesystem>
#include <string>
#include <vector>

namespace perfora::report {

/// sRGB, 0 to 1.
struct Colour {
  double red = 0.0, green = 0.0, blue = 0.0;
};
/// `share` of `b` in `a`.
Colour mix(const Colour& a, const Colour& b, double fraction);
constexpr Colour hex(unsigned rgb) {
  return {static_cast<double>((rgb >> 16) & 255u) / 255.0, static_cast<double>((rgb >> 8) & 255u) / 255.0,
          static_cast<double>(rgb & 255u) / 255.0};
}

/// The colours of every picture. Distinct hues follow Okabe and Ito, "Color Universal Design" (2008), told apart by
/// colour-blind readers.
namespace palette {
inline constexpr Colour ink = hex(0x24262b);
inline constexpr Colour soft_ink = hex(0x6b7079);
inline constexpr Colour grid = hex(0xe6e7ea);
inline constexpr Colour paper = hex(0xffffff);
inline constexpr Colour concrete = hex(0xcdc5b6);
inline constexpr Colour concrete_edge = hex(0x8f8675);
inline constexpr Colour damaged = hex(0x9c1c1c);
inline constexpr Colour dust = hex(0xa89f97);
inline constexpr Colour blue = hex(0x0072b2);
inline constexpr Colour vermilion = hex(0xd55e00);
inline constexpr Colour green = hex(0x009e73);
inline constexpr Colour purple = hex(0xaa4499);
inline constexpr Colour band = hex(0xdcebf5);
/// Arms of a study and other series.
const std::vector<Colour>& series();
/// Fragments other than the largest.
const std::vector<Colour>& fragments();
}  // namespace palette

/// Page units: pixels of a PNG.
struct Box {
  double x = 0.0, y = 0.0, width = 0.0, height = 0.0;
  double right() const { return x + width; }
  double bottom() const { return y + height; }
};

enum class Align { left, centre, right };

struct TextStyle {
  double size = 17.0;
  Colour colour = palette::ink;
  bool bold = false;
  Align align = Align::left;
  bool halo = false;  ///< white rim, for text that lies over lines
};

/// What is left of a text that is too wide.
enum class Keep { begin, end };

/// One page. The extension of `path` says the kind; throws io::InputError for another than .png, .svg, .pdf (before
/// anything is drawn).
class Canvas {
 public:
  Canvas(std::filesystem::path path, double width, double height);
  ~Canvas();
  Canvas(const Canvas&) = delete;
  Canvas& operator=(const Canvas&) = delete;

  cairo_t* context() const { return context_; }
  double width() const { return width_; }
  double height() const { return height_; }
  /// Pixels an embedded image should have for one page unit.
  double image_scale() const { return vector_ ? 2.0 : 1.0; }

  /// Baseline at y.
  void text(double x, double y, const std::string& text, const TextStyle& style = {});
  /// Text turned by 90 degrees to the left, centred on (x, y).
  void text_upright(double x, double y, const std::string& text, const TextStyle& style = {});
  double text_width(const std::string& text, const TextStyle& style = {});
  /// `text` where it is not wider than `width`; else what fits of the part that `keep` says, with "..." for the rest.
  std::string fit(const std::string& text, double width, const TextStyle& style = {}, Keep keep = Keep::begin);
  void line(double x0, double y0, double x1, double y1, const Colour& colour, double thickness = 1.0,
            const std::vector<double>& dashes = {});
  void fill(const Box& box, const Colour& colour, double opacity = 1.0);
  void frame(const Box& box, const Colour& colour, double thickness = 1.0);
  void disc(double x, double y, double radius, const Colour& fill, const Colour& rim, double rim_thickness = 1.0);
  /// A letter in a dark circle.
  void badge(double x, double y, const std::string& letter);

  /// Writes the file whole, by rename.
  void write();

 private:
  std::filesystem::path path_;
  double width_, height_;
  bool vector_ = false;
  std::string bytes_;
  cairo_surface_t* surface_ = nullptr;
  cairo_t* context_ = nullptr;
};

void set_colour(cairo_t* context, const Colour& colour, double opacity = 1.0);

}  // namespace perfora::report
