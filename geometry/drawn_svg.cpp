// What is here: outlines of an SVG file. What is not: path data and transforms (svg_text.h), style sheets: what is
// drawn counts, whatever its colour.
#include <algorithm>
#include <cstring>
#include <numbers>
#include <pugixml.hpp>

#include "geometry/drawn_shapes.h"
#include "geometry/layout_limits.h"
#include "geometry/svg_text.h"
#include "io/error.h"
#include "io/letters.h"
#include "io/text.h"

namespace perfora::geometry {
namespace {

constexpr int deepest_groups = 200;  // groups within groups

/// "path" of "svg:path".
std::string_view plain_name(const pugi::xml_node& node) {
  const std::string_view name = node.name();
  const std::size_t colon = name.find(':');
  return colon == std::string_view::npos ? name : name.substr(colon + 1);
}

class SvgReader {
 public:
  SvgReader(std::string_view text, const DrawnSource& source) : text_(text), source_(source) {}

  std::vector<DrawnShape> shapes() {
    pugi::xml_document document;
    const pugi::xml_parse_result parsed = document.load_buffer(text_.data(), text_.size());
    if (!parsed)
      refuse(line_at(parsed.offset), std::string("this is no XML: ") + parsed.description(), "an SVG file, whole");
    const pugi::xml_node root = document.document_element();
    if (plain_name(root) != "svg")
      refuse(line_of(root), "the file holds " + io::in_quotes(root.name()) + ", no drawing", "the element svg");
    walk(root, page_to_metres(root), {}, 0);
    return std::move(shapes_);
  }

 private:
  [[noreturn]] void refuse(int line, const std::string& problem, const std::string& allowed,
                           const std::string& remedy = "correct the file, or write it again as plain SVG") const {
    throw io::InputError({source_.name, line, "layout.file"}, problem, allowed, remedy);
  }
  int line_at(std::ptrdiff_t offset) const {
    const auto end = std::min(text_.size(), static_cast<std::size_t>(std::max<std::ptrdiff_t>(offset, 0)));
    return 1 + static_cast<int>(std::count(text_.begin(), text_.begin() + static_cast<std::ptrdiff_t>(end), '\n'));
  }
  int line_of(const pugi::xml_node& node) const { return line_at(node.offset_debug()); }

  SvgLength length(const pugi::xml_node& node, const char* name, bool needed = false) const {
    const pugi::xml_attribute attribute = node.attribute(name);
    if (!attribute) {
      if (needed) refuse(line_of(node), std::string(node.name()) + " has no " + name, "a whole element");
      return {};
    }
    const auto value = svg_length(attribute.value());
    if (!value)
      refuse(line_of(node), std::string(name) + "=" + io::in_quotes(attribute.value()) + " is no length", "a number");
    return *value;
  }
  /// In units of the drawing: a number without a unit, or in px, which are the same.
  double number(const pugi::xml_node& node, const char* name, bool needed = false) const {
    const SvgLength value = length(node, name, needed);
    if (!value.unit.empty() && value.unit != "px")
      refuse(line_of(node), std::string(name) + " has the unit " + value.unit, "plain numbers within the drawing");
    return value.value;
  }

  /// y upwards from the lower edge of the page.
  Affine page_to_metres(const pugi::xml_node& root) const {
    double left = 0.0, top = 0.0, wide = 0.0, high = 0.0;
    const SvgLength width = length(root, "width"), height = length(root, "height");
    if (const pugi::xml_attribute box = root.attribute("viewBox")) {
      SvgScanner scanner(box.value());
      const auto x = scanner.number(), y = scanner.number(), w = scanner.number(), h = scanner.number();
      if (!x || !y || !w || !h || !(*w > 0.0 && *h > 0.0))
        refuse(line_of(root), "viewBox=" + io::in_quotes(box.value()) + " is no page",
               "four numbers, the last two positive");
      left = *x;
      top = *y;
      wide = *w;
      high = *h;
    } else if (width.metres() == 0.0 && height.metres() == 0.0) {
      wide = width.value;
      high = height.value;
    }
    double metres = source_.metres;
    if (metres == 0.0 && wide > 0.0 && width.metres() > 0.0) metres = width.metres() / wide;
    if (metres > 0.0 && source_.metres == 0.0 && height.metres() > 0.0) {
      constexpr double alike = 1e-3;
      if (std::abs(height.metres() / high - metres) > alike * metres)
        refuse(line_of(root), "width and height stretch the page differently", "one scale for both");
    }
    if (metres == 0.0)
      throw io::InputError(
          {source_.name, line_of(root), "layout.file_unit"}, "the drawing does not say what its lengths mean",
          "width=\"150mm\" and viewBox in the file, or a unit here", "write file_unit = \"mm\" under [layout]");
    return {metres, 0.0, 0.0, -metres, -metres * left, metres * (top + high)};
  }

  void walk(const pugi::xml_node& parent, const Affine& to_metres, const std::vector<std::string>& layers, int depth) {
    if (depth > deepest_groups) refuse(line_of(parent), "groups stand too deep within each other", "fewer groups");
    for (const pugi::xml_node node : parent.children()) {
      if (node.type() != pugi::node_element) continue;
      const std::string_view name = plain_name(node);
      if (std::strcmp(node.attribute("display").value(), "none") == 0) continue;
      Affine map = to_metres;
      if (const pugi::xml_attribute attribute = node.attribute("transform")) {
        const auto own = svg_transform(attribute.value());
        if (!own)
          refuse(line_of(node), "transform=" + io::in_quotes(attribute.value()) + " is no transform",
                 "those of SVG 1.1");
        map = map.after(*own);
      }
      if (name == "g" || name == "a" || name == "switch") {
        std::vector<std::string> inner = layers;
        for (const char* label : {"id", "inkscape:label"})
          if (const pugi::xml_attribute attribute = node.attribute(label))
            inner.push_back(io::lower(attribute.value()));
        walk(node, map, inner, depth + 1);
      } else {
        DrawnShape shape;
        shape.layers = layers;
        shape.line = line_of(node);
        add(node, name, map, shape);
      }
      if (shapes_.size() > static_cast<std::size_t>(maximum_holes) * 4)
        refuse(line_of(node), "the drawing has too many outlines", "fewer", "keep the holes only");
    }
  }

  void add(const pugi::xml_node& node, std::string_view name, const Affine& map, const DrawnShape& shape) {
    if (name == "circle") return add_ellipse(node, map, shape, "r", "r");
    if (name == "ellipse") return add_ellipse(node, map, shape, "rx", "ry");
    if (name == "rect") return add_rect(node, map, shape);
    if (name == "polygon") return add_polygon(node, map, shape);
    if (name == "path") return add_path(node, map, shape);
    DrawnShape other = shape;
    if (name == "use" || name == "svg") {
      other.problem = "elements \"" + std::string(name) + "\" are not read";
      other.hides_holes = true;
    } else if (name == "line" || name == "polyline") {
      other.problem = "this line is not closed";
    }
    if (!other.problem.empty()) shapes_.push_back(std::move(other));
  }

  void keep(DrawnShape shape, const DrawnOutline& outline) {
    if (outline.too_long())
      refuse(shape.line, "this outline has too many corners", "at most " + std::to_string(DrawnOutline::most_corners),
             "draw it with fewer");
    shape.corners = outline.corners();
    const RoundOutline round = round_outline(shape.corners);
    if (shape.problem.empty() && round.diameter > 0.0) {
      shape.diameter = round.diameter;
      shape.centre = round.centre;
    }
    shapes_.push_back(std::move(shape));
  }

  void add_ellipse(const pugi::xml_node& node, const Affine& map, DrawnShape shape, const char* rx, const char* ry) {
    const Point centre{number(node, "cx"), number(node, "cy")};
    const double x = number(node, rx, true), y = number(node, ry, true);
    if (!(x > 0.0 && y > 0.0)) refuse(shape.line, "this has no size", "positive radii", "correct or remove it");
    // A transformation that keeps angles leaves a circle one, exactly.
    const double stretch = std::hypot(map.a, map.b), other = std::hypot(map.c, map.d);
    constexpr double alike = 1e-12;
    if (x == y && std::abs(stretch - other) <= alike * stretch &&
        std::abs(map.a * map.c + map.b * map.d) <= alike * stretch * stretch) {
      shape.centre = map(centre);
      shape.diameter = 2.0 * x * stretch;
      shapes_.push_back(std::move(shape));
      return;
    }
    DrawnOutline outline(map);
    outline.ellipse(centre, {x, 0.0}, {0.0, y}, 0.0, 2.0 * std::numbers::pi);
    keep(std::move(shape), outline);
  }

  void add_rect(const pugi::xml_node& node, const Affine& map, DrawnShape shape) {
    const double x = number(node, "x"), y = number(node, "y");
    const double w = number(node, "width", true), h = number(node, "height", true);
    if (!(w > 0.0 && h > 0.0))
      refuse(shape.line, "this has no size", "positive width and height", "correct or remove it");
    double rx = number(node, "rx"), ry = number(node, "ry");
    if (!node.attribute("rx")) rx = ry;
    if (!node.attribute("ry")) ry = rx;
    rx = std::clamp(rx, 0.0, 0.5 * w);
    ry = std::clamp(ry, 0.0, 0.5 * h);
    DrawnOutline outline(map);
    if (rx == 0.0 || ry == 0.0) {
      for (const Point corner : {Point{x, y}, Point{x + w, y}, Point{x + w, y + h}, Point{x, y + h}})
        outline.add(corner);
    } else {
      const auto corner = [&](double cx, double cy, double from) {
        outline.add({cx + rx * std::cos(from), cy + ry * std::sin(from)});
        outline.ellipse({cx, cy}, {rx, 0.0}, {0.0, ry}, from, from + 0.5 * std::numbers::pi);
      };
      corner(x + w - rx, y + ry, -0.5 * std::numbers::pi);
      corner(x + w - rx, y + h - ry, 0.0);
      corner(x + rx, y + h - ry, 0.5 * std::numbers::pi);
      corner(x + rx, y + ry, std::numbers::pi);
    }
    keep(std::move(shape), outline);
  }

  void add_polygon(const pugi::xml_node& node, const Affine& map, DrawnShape shape) {
    SvgScanner scanner(node.attribute("points").value());
    DrawnOutline outline(map);
    while (!scanner.at_end()) {
      const auto x = scanner.number(), y = scanner.number();
      if (!x || !y) refuse(shape.line, "the points of this polygon are no pairs of numbers", "x,y x,y ...");
      outline.add({*x, *y});
    }
    keep(std::move(shape), outline);
  }

  void add_path(const pugi::xml_node& node, const Affine& map, const DrawnShape& shape) {
    const SvgPath path = svg_path(node.attribute("d").value(), map);
    if (!path.problem.empty())
      refuse(shape.line, "the data of this path cannot be read: " + path.problem, "those of SVG 1.1");
    for (const SvgSubpath& piece : path.pieces) {
      DrawnShape one = shape;
      if (!piece.closed && !piece.outline.returns()) one.problem = "this line is not closed";
      keep(std::move(one), piece.outline);
    }
  }

  std::string_view text_;
  const DrawnSource& source_;
  std::vector<DrawnShape> shapes_;
};

}  // namespace

std::vector<DrawnShape> read_svg(std::string_view text, const DrawnSource& source) {
  return SvgReader(text, source).shapes();
}

}  // namespace perfora::geometry
