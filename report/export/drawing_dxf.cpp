// What is here: a drawing as DXF R12. What is not: SVG (drawing_svg.cpp), reading of DXF (geometry/drawn_dxf.cpp).
// Format: Autodesk's DXF reference, pairs of a group code and a value.
#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <cstdint>

#include "report/export/drawing.h"

namespace perfora::report {
namespace {

/// Writes pairs of group code and value.
class Groups {
 public:
  void add(int code, const std::string& value) { text_ += fmt::format("{:>3}\n{}\n", code, value); }
  void add(int code, int value) { add(code, std::to_string(value)); }
  void add(int code, double value) { add(code, mm_text(value, 9)); }
  void add(int code, Point place) {
    add(code, place.x);
    add(code + 10, place.y);
    add(code + 20, 0.0);
  }
  const std::string& text() const { return text_; }

 private:
  std::string text_;
};

std::string name_of(Layer layer) {
  std::string name = layer_name(layer);
  std::transform(name.begin(), name.end(), name.begin(),
                 [](unsigned char c) { return static_cast<char>(std::toupper(c)); });
  return name;
}

int colour_of(Layer layer) {
  constexpr int white_or_black = 7, red = 1, green = 3, blue = 5, grey = 8;
  switch (layer) {
    case Layer::holes:
      return blue;
    case Layer::centres:
      return red;
    case Layer::dimensions:
      return green;
    case Layer::frame:
      return grey;
    default:
      return white_or_black;
  }
}

/// R12 is ASCII: other signs as \U+XXXX, the sign of a diameter as %%c.
std::string ascii(const std::string& utf8) {
  std::string out;
  for (std::size_t k = 0; k < utf8.size();) {
    const auto lead = static_cast<unsigned char>(utf8[k]);
    const std::size_t length = lead < 0x80 ? 1 : lead < 0xe0 ? 2 : lead < 0xf0 ? 3 : 4;
    if (length == 1) {
      out += lead < 0x20 ? ' ' : utf8[k];
      ++k;
      continue;
    }
    std::uint32_t point = lead & (0xffu >> (length + 1));
    for (std::size_t more = 1; more < length && k + more < utf8.size(); ++more)
      point = point << 6 | (static_cast<unsigned char>(utf8[k + more]) & 0x3fu);
    constexpr std::uint32_t stroked_o = 0xd8, largest = 0xffff;
    out += point == stroked_o ? "%%c" : point > largest ? "?" : fmt::format("\\U+{:04X}", point);
    k += length;
  }
  return out;
}

void add_header(Groups& out, const Drawing& drawing) {
  out.add(0, "SECTION");
  out.add(2, "HEADER");
  out.add(9, "$ACADVER");
  out.add(1, "AC1009");
  out.add(9, "$INSUNITS");  // R12 knows no units; programs of today read them all the same
  out.add(70, 4);
  out.add(9, "$EXTMIN");
  out.add(10, Point{-drawing.origin.x, -drawing.origin.y});
  out.add(9, "$EXTMAX");
  out.add(10, Point{drawing.width - drawing.origin.x, drawing.height - drawing.origin.y});
  out.add(0, "ENDSEC");
}

void add_tables(Groups& out) {
  out.add(0, "SECTION");
  out.add(2, "TABLES");
  out.add(0, "TABLE");
  out.add(2, "LTYPE");
  out.add(70, 1);
  out.add(0, "LTYPE");
  out.add(2, "CONTINUOUS");
  out.add(70, 0);
  out.add(3, "Solid line");
  out.add(72, 65);
  out.add(73, 0);
  out.add(40, 0.0);
  out.add(0, "ENDTAB");
  out.add(0, "TABLE");
  out.add(2, "LAYER");
  out.add(70, static_cast<int>(std::size(all_layers)));
  for (const Layer layer : all_layers) {
    out.add(0, "LAYER");
    out.add(2, name_of(layer));
    out.add(70, 0);
    out.add(62, colour_of(layer));
    out.add(6, "CONTINUOUS");
  }
  out.add(0, "ENDTAB");
  out.add(0, "ENDSEC");
}

class Entities {
 public:
  Entities(Groups& out, const Drawing& drawing) : out_(out), drawing_(drawing) {}

  void add(const Drawing::Line& line) {
    begin("LINE", line.layer);
    out_.add(10, of_block(line.from));
    out_.add(11, of_block(line.to));
  }
  void add(const Drawing::Circle& circle) {
    begin("CIRCLE", circle.layer);
    out_.add(10, of_block(circle.centre));
    out_.add(40, 0.5 * circle.diameter);
  }
  void add(const Drawing::Rim& rim) {
    begin("POLYLINE", rim.layer);
    out_.add(66, 1);  // corners follow
    out_.add(10, Point{});
    out_.add(70, 1);  // closed
    for (const RimCorner& corner : rim.corners) {
      begin("VERTEX", rim.layer);
      out_.add(10, of_block(corner.at));
      if (corner.bulge != 0.0) out_.add(42, fmt::format("{:.15g}", corner.bulge));
    }
    begin("SEQEND", rim.layer);
  }
  void add(const Drawing::Arrow& arrow) {
    begin("SOLID", arrow.layer);
    out_.add(10, of_block(arrow.tip));
    out_.add(11, of_block(arrow.left));
    out_.add(12, of_block(arrow.right));
    out_.add(13, of_block(arrow.right));
  }
  void add(const Drawing::Text& text) {
    begin("TEXT", text.layer);
    out_.add(10, of_block(text.at));
    out_.add(40, text.height);
    out_.add(1, ascii(text.text));
    out_.add(50, text.angle);
    if (text.align == Drawing::Align::left) return;
    out_.add(72, text.align == Drawing::Align::middle ? 1 : 2);
    out_.add(11, of_block(text.at));
  }

 private:
  void begin(const char* type, Layer layer) {
    out_.add(0, type);
    out_.add(8, name_of(layer));
  }
  Point of_block(Point p) const { return {p.x - drawing_.origin.x, p.y - drawing_.origin.y}; }

  Groups& out_;
  const Drawing& drawing_;
};

}  // namespace

std::string as_dxf(const Drawing& drawing) {
  Groups out;
  out.add(999, ascii(drawing.title));
  add_header(out, drawing);
  add_tables(out);
  out.add(0, "SECTION");
  out.add(2, "ENTITIES");
  Entities entities(out, drawing);
  for (const auto& one : drawing.rims) entities.add(one);
  for (const auto& one : drawing.circles) entities.add(one);
  for (const auto& one : drawing.lines) entities.add(one);
  for (const auto& one : drawing.arrows) entities.add(one);
  for (const auto& one : drawing.texts) entities.add(one);
  out.add(0, "ENDSEC");
  out.add(0, "EOF");
  return out.text();
}

}  // namespace perfora::report
