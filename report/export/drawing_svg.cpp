// What is here: a drawing as SVG. What is not: DXF (drawing_dxf.cpp), reading of SVG (geometry/drawn_svg.cpp).
#include <fmt/format.h>

#include <cmath>

#include "report/export/drawing.h"
#include "report/export/xml.h"

namespace perfora::report {
namespace {

constexpr int file_digits = 6;  // a nanometre

std::string number(double value) {
  return mm_text(value, file_digits);
}

/// Coordinates of a layer: those of the block, or of the sheet.
class Frame {
 public:
  Frame(const Drawing& drawing, Layer layer)
      : of_block_(layer == Layer::block || layer == Layer::holes || layer == Layer::centres), drawing_(drawing) {}
  bool of_block() const { return of_block_; }
  double x(Point p) const { return of_block_ ? p.x - drawing_.origin.x : p.x; }
  double y(Point p) const { return of_block_ ? p.y - drawing_.origin.y : drawing_.height - p.y; }
  std::string place(Point p) const { return number(x(p)) + " " + number(y(p)); }
  /// Whether an anticlockwise arc turns towards rising angles of this frame.
  int sweep(double bulge) const { return (bulge > 0.0) == of_block_ ? 1 : 0; }

 private:
  bool of_block_;
  const Drawing& drawing_;
};

/// Radius of the arc that leads from `a` to `b` with this bulge.
double radius_of(Point a, Point b, double bulge) {
  const double chord = std::hypot(b.x - a.x, b.y - a.y), size = std::abs(bulge);
  return chord * (1.0 + size * size) / (4.0 * size);
}

std::string rim_path(const Drawing::Rim& rim, const Frame& frame) {
  std::string path = "M " + frame.place(rim.corners.front().at);
  for (std::size_t k = 0; k < rim.corners.size(); ++k) {
    const RimCorner& corner = rim.corners[k];
    const Point next = rim.corners[(k + 1) % rim.corners.size()].at;
    if (corner.bulge == 0.0) {
      if (k + 1 < rim.corners.size()) path += " L " + frame.place(next);
      continue;
    }
    const std::string radius = number(radius_of(corner.at, next, corner.bulge));
    path += fmt::format(" A {0} {0} 0 {1} {2} {3}", radius, std::abs(corner.bulge) > 1.0 ? 1 : 0,
                        frame.sweep(corner.bulge), frame.place(next));
  }
  return path + " Z";
}

const char* style(Layer layer) {
  switch (layer) {
    case Layer::block:
      return "fill=\"none\" stroke=\"black\" stroke-width=\"0.7\"";
    case Layer::holes:
      return "fill=\"none\" stroke=\"black\" stroke-width=\"0.35\"";
    case Layer::centres:
      return "fill=\"none\" stroke=\"#555\" stroke-width=\"0.13\"";
    case Layer::loading:
      return "fill=\"black\" stroke=\"black\" stroke-width=\"0.7\"";
    case Layer::frame:
      return "fill=\"none\" stroke=\"black\" stroke-width=\"0.35\"";
    default:
      return "fill=\"black\" stroke=\"black\" stroke-width=\"0.18\"";
  }
}

std::string texts_of(const Drawing& drawing, Layer layer) {
  std::string out;
  constexpr const char* anchors[] = {"start", "middle", "end"};
  for (const Drawing::Text& text : drawing.texts) {
    if (text.layer != layer) continue;
    const std::string x = number(text.at.x), y = number(drawing.height - text.at.y);
    // Capitals of common fonts are 0.72 of the font size high.
    out +=
        fmt::format("<text x=\"{}\" y=\"{}\" font-size=\"{}\" text-anchor=\"{}\"{}>{}</text>\n", x, y,
                    number(text.height / 0.72), anchors[static_cast<int>(text.align)],
                    text.angle == 0.0 ? "" : fmt::format(" transform=\"rotate({} {} {})\"", number(-text.angle), x, y),
                    escaped_xml(text.text));
  }
  return out.empty()
             ? out
             : "<g stroke=\"none\" fill=\"black\" font-family=\"DejaVu Sans, Arial, sans-serif\">\n" + out + "</g>\n";
}

std::string layer_body(const Drawing& drawing, Layer layer) {
  const Frame frame(drawing, layer);
  std::string out;
  for (const Drawing::Line& line : drawing.lines)
    if (line.layer == layer)
      out += fmt::format("<line x1=\"{}\" y1=\"{}\" x2=\"{}\" y2=\"{}\"/>\n", number(frame.x(line.from)),
                         number(frame.y(line.from)), number(frame.x(line.to)), number(frame.y(line.to)));
  for (const Drawing::Circle& circle : drawing.circles)
    if (circle.layer == layer)
      out += fmt::format("<circle cx=\"{}\" cy=\"{}\" r=\"{}\"/>\n", number(frame.x(circle.centre)),
                         number(frame.y(circle.centre)), number(0.5 * circle.diameter));
  for (const Drawing::Rim& rim : drawing.rims)
    if (rim.layer == layer) out += "<path d=\"" + rim_path(rim, frame) + "\"/>\n";
  for (const Drawing::Arrow& arrow : drawing.arrows)
    if (arrow.layer == layer)
      out += "<path d=\"M " + frame.place(arrow.tip) + " L " + frame.place(arrow.left) + " L " +
             frame.place(arrow.right) + " Z\" stroke=\"none\"/>\n";
  return out + texts_of(drawing, layer);
}

}  // namespace

std::string as_svg(const Drawing& drawing) {
  std::string out = fmt::format(
      "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n<svg xmlns=\"http://www.w3.org/2000/svg\" version=\"1.1\" "
      "width=\"{0}mm\" height=\"{1}mm\" viewBox=\"0 0 {0} {1}\">\n<title>{2}</title>\n<rect width=\"{0}\" "
      "height=\"{1}\" "
      "fill=\"white\" id=\"paper\"/>\n",
      number(drawing.width), number(drawing.height), escaped_xml(drawing.title));
  for (const Layer layer : all_layers) {
    const std::string body = layer_body(drawing, layer);
    if (body.empty()) continue;
    const std::string place = Frame(drawing, layer).of_block()
                                  ? fmt::format(" transform=\"matrix(1 0 0 -1 {} {})\"", number(drawing.origin.x),
                                                number(drawing.height - drawing.origin.y))
                                  : std::string();
    out += fmt::format("<g id=\"{}\" {}{}>\n{}</g>\n", layer_name(layer), style(layer), place, body);
  }
  return out + "</svg>\n";
}

}  // namespace perfora::report
