// What is here: outlines of a DXF file. What is not: blocks, splines, solids, chains of single lines: said by name.
// Format: Autodesk's DXF reference: pairs of lines, a group code and a value. Read here and not by a library: those in
// Debian say no line of an error, and give circles and polylines back in the same pairs.
#include <algorithm>
#include <charconv>
#include <cmath>
#include <map>
#include <numbers>
#include <optional>

#include "geometry/drawn_outline.h"
#include "geometry/drawn_shapes.h"
#include "geometry/layout_limits.h"
#include "io/error.h"
#include "io/letters.h"
#include "io/numbers.h"
#include "io/text.h"

namespace perfora::geometry {
namespace {

struct Group {
  int code = 0;
  std::string_view value;
  int line = 0;  ///< of the value
};

[[noreturn]] void refuse_dxf(const DrawnSource& source, int line, const std::string& problem,
                             const std::string& allowed,
                             const std::string& remedy = "write the file again as ASCII DXF") {
  throw io::InputError({source.name, line, "layout.file"}, problem, allowed, remedy);
}

/// Pairs one after another.
class Groups {
 public:
  Groups(std::string_view text, const DrawnSource& source) : rest_(text), source_(source) { advance(); }

  bool at_end() const { return ended_; }
  const Group& now() const { return group_; }
  void advance() {
    std::string_view code, value;
    if (!next_line(code) || (io::trimmed(code).empty() && io::trimmed(rest_).empty())) {
      ended_ = true;
      return;
    }
    const std::string_view digits = io::trimmed(code);
    int number = 0;
    const auto [end, error] = std::from_chars(digits.data(), digits.data() + digits.size(), number);
    if (error != std::errc{} || end != digits.data() + digits.size())
      refuse_dxf(source_, line_, io::in_quotes(digits) + " is no group code", "a whole number on every other line");
    if (!next_line(value)) refuse_dxf(source_, line_, "the file ends within a pair", "a value behind each group code");
    group_ = {number, io::trimmed(value), line_};
  }

 private:
  bool next_line(std::string_view& line) {
    if (rest_.empty()) return false;
    const std::size_t end = rest_.find('\n');
    line = rest_.substr(0, end);
    rest_ = end == std::string_view::npos ? std::string_view{} : rest_.substr(end + 1);
    ++line_;
    return true;
  }
  std::string_view rest_;
  const DrawnSource& source_;
  int line_ = 0;
  bool ended_ = false;
  Group group_;
};

/// One entity: its groups up to the next code 0.
struct Entity {
  std::string_view type;
  int line = 0;
  std::vector<Group> groups;
};

class DxfReader {
 public:
  DxfReader(std::string_view text, const DrawnSource& source) : source_(source), groups_(text, source) {
    metres_ = source.metres;
  }

  std::vector<DrawnShape> shapes() {
    bool found = false;
    while (!groups_.at_end()) {
      const Group group = groups_.now();
      groups_.advance();
      if (group.code != 0 || group.value != "SECTION" || groups_.at_end()) continue;
      const std::string_view name = groups_.now().value;
      if (name == "HEADER") read_header();
      if (name != "ENTITIES") continue;
      found = true;
      read_entities();
    }
    if (!found) refuse_dxf(source_, 0, "the file has no section ENTITIES", "an ASCII DXF file, whole");
    return std::move(shapes_);
  }

 private:
  double number(const Group& group) const {
    const std::optional<double> value = io::number_from(group.value);
    if (!value || !std::isfinite(*value))
      refuse_dxf(source_, group.line, io::in_quotes(group.value) + " is no finite number",
                 "a number behind group code " + std::to_string(group.code));
    return *value;
  }
  int flags(const Group& group) const { return static_cast<int>(std::clamp(number(group), -1e6, 1e6)); }

  void read_header() {
    while (!groups_.at_end() && !(groups_.now().code == 0)) {
      const bool unit = groups_.now().code == 9 && groups_.now().value == "$INSUNITS";
      groups_.advance();
      if (unit && !groups_.at_end() && metres_ == 0.0) metres_ = metres_of(flags(groups_.now()));
    }
  }

  /// Of $INSUNITS; 0 for none.
  static double metres_of(int unit) {
    static const std::map<int, double> metres = {{1, 0.0254}, {2, 0.3048}, {4, 1e-3},    {5, 1e-2},   {6, 1.0},
                                                 {13, 1e-6},  {14, 0.1},   {10, 0.9144}, {9, 25.4e-6}};
    const auto found = metres.find(unit);
    return found == metres.end() ? 0.0 : found->second;
  }

  Entity next_entity() {
    Entity entity{groups_.now().value, groups_.now().line, {}};
    groups_.advance();
    for (; !groups_.at_end() && groups_.now().code != 0; groups_.advance()) entity.groups.push_back(groups_.now());
    return entity;
  }

  void read_entities() {
    groups_.advance();
    while (!groups_.at_end()) {
      if (groups_.now().code != 0) {
        groups_.advance();
        continue;
      }
      if (groups_.now().value == "ENDSEC" || groups_.now().value == "EOF") return;
      const Entity entity = next_entity();
      if (entity.type == "POLYLINE")
        add_polyline(entity);
      else
        add(entity);
      if (shapes_.size() > static_cast<std::size_t>(maximum_holes) * 4)
        refuse_dxf(source_, entity.line, "the drawing has too many outlines", "fewer", "keep the holes only");
    }
    refuse_dxf(source_, 0, "the file ends within its entities", "a file that ends with ENDSEC and EOF");
  }

  DrawnShape shape_of(const Entity& entity) const {
    DrawnShape shape;
    shape.line = entity.line;
    for (const Group& group : entity.groups)
      if (group.code == 8) shape.layers = {io::lower(group.value)};
    return shape;
  }

  static bool in_paper_space(const Entity& entity) {
    return std::any_of(entity.groups.begin(), entity.groups.end(),
                       [](const Group& group) { return group.code == 67 && group.value == "1"; });
  }

  std::optional<double> value_of(const Entity& entity, int code) const {
    for (const Group& group : entity.groups)
      if (group.code == code) return number(group);
    return std::nullopt;
  }
  double needed(const Entity& entity, int code) const {
    const auto value = value_of(entity, code);
    if (!value)
      refuse_dxf(source_, entity.line, "this " + std::string(entity.type) + " has no group " + std::to_string(code),
                 "a whole entity");
    return *value;
  }

  /// Entities seen from behind have x turned around.
  Affine to_metres(const Entity& entity) const {
    if (metres_ == 0.0)
      throw io::InputError({source_.name, 0, "layout.file_unit"}, "the drawing does not say what its lengths mean",
                           "$INSUNITS in the file, or a unit here", "write file_unit = \"mm\" under [layout]");
    return {value_of(entity, 230).value_or(1.0) < 0.0 ? -metres_ : metres_, 0.0, 0.0, metres_, 0.0, 0.0};
  }

  void add(const Entity& entity) {
    if (in_paper_space(entity)) return;
    static const std::map<std::string_view, const char*> open = {{"LINE", "single lines are not joined"},
                                                                 {"ARC", "single arcs are not joined"}};
    static const std::map<std::string_view, const char*> hiding = {{"INSERT", "blocks are not read"},
                                                                   {"SPLINE", "splines are not read"},
                                                                   {"REGION", "regions are not read"},
                                                                   {"MLINE", "multilines are not read"},
                                                                   {"3DSOLID", "solids are not read"}};
    if (entity.type == "CIRCLE") return add_circle(entity);
    if (entity.type == "ELLIPSE") return add_ellipse(entity);
    if (entity.type == "LWPOLYLINE") return add_light_polyline(entity);
    DrawnShape shape = shape_of(entity);
    if (const auto found = open.find(entity.type); found != open.end()) shape.problem = found->second;
    if (const auto found = hiding.find(entity.type); found != hiding.end()) {
      shape.problem = found->second;
      shape.hides_holes = true;
    }
    if (!shape.problem.empty()) shapes_.push_back(std::move(shape));
  }

  void add_circle(const Entity& entity) {
    DrawnShape shape = shape_of(entity);
    const Affine map = to_metres(entity);
    shape.centre = map({needed(entity, 10), needed(entity, 20)});
    shape.diameter = 2.0 * metres_ * needed(entity, 40);
    if (!(shape.diameter > 0.0))
      refuse_dxf(source_, entity.line, "this circle has no size", "a positive radius", "correct or remove it");
    shapes_.push_back(std::move(shape));
  }

  void add_ellipse(const Entity& entity) {
    const Point centre{needed(entity, 10), needed(entity, 20)}, axis{needed(entity, 11), needed(entity, 21)};
    const double ratio = needed(entity, 40), from = value_of(entity, 41).value_or(0.0),
                 to = value_of(entity, 42).value_or(2.0 * std::numbers::pi);
    DrawnOutline outline(to_metres(entity));
    constexpr double whole = 2.0 * std::numbers::pi - 1e-6;
    if (to - from >= whole)
      outline.ellipse(centre, axis, {-ratio * axis.y, ratio * axis.x}, 0.0, 2.0 * std::numbers::pi);
    keep(shape_of(entity), outline, !outline.empty());
  }

  struct Corner {
    Point at;
    double bulge = 0.0;
  };

  void add_light_polyline(const Entity& entity) {
    std::vector<Corner> corners;
    bool closed = false;
    for (const Group& group : entity.groups) {
      if (group.code == 70) closed = (flags(group) & 1) != 0;
      if (group.code == 10) corners.push_back({{number(group), 0.0}, 0.0});
      if (corners.empty()) continue;
      if (group.code == 20) corners.back().at.y = number(group);
      if (group.code == 42) corners.back().bulge = number(group);
    }
    keep(entity, corners, closed);
  }

  void add_polyline(const Entity& entity) {
    const int kind = static_cast<int>(value_of(entity, 70).value_or(0.0));
    std::vector<Corner> corners;
    while (!groups_.at_end() && groups_.now().code == 0 && groups_.now().value == "VERTEX") {
      const Entity vertex = next_entity();
      corners.push_back({{needed(vertex, 10), needed(vertex, 20)}, value_of(vertex, 42).value_or(0.0)});
    }
    if (groups_.at_end() || groups_.now().value != "SEQEND")
      refuse_dxf(source_, entity.line, "this POLYLINE does not end", "its VERTEX entities and SEQEND");
    next_entity();
    if (in_paper_space(entity)) return;
    constexpr int three_dimensional = 8 | 16 | 64;
    if ((kind & three_dimensional) != 0) {
      DrawnShape shape = shape_of(entity);
      shape.problem = "polylines in space and meshes are not read";
      shape.hides_holes = true;
      shapes_.push_back(std::move(shape));
      return;
    }
    keep(entity, corners, (kind & 1) != 0);
  }

  void keep(const Entity& entity, const std::vector<Corner>& corners, bool closed) {
    if (corners.empty()) return;
    DrawnOutline outline(to_metres(entity));
    outline.add(corners.front().at);
    for (std::size_t k = 0; k + 1 < corners.size(); ++k) outline.bulge_to(corners[k + 1].at, corners[k].bulge);
    if (closed) outline.bulge_to(corners.front().at, corners.back().bulge);
    keep(shape_of(entity), outline, closed || outline.returns());
  }

  void keep(DrawnShape shape, const DrawnOutline& outline, bool closed) {
    if (outline.too_long())
      refuse_dxf(source_, shape.line, "this outline has too many corners",
                 "at most " + std::to_string(DrawnOutline::most_corners), "draw it with fewer");
    if (!closed) shape.problem = "this line is not closed";
    shape.corners = outline.corners();
    const RoundOutline round = round_outline(shape.corners);
    if (closed && round.diameter > 0.0) {
      shape.diameter = round.diameter;
      shape.centre = round.centre;
    }
    shapes_.push_back(std::move(shape));
  }

  const DrawnSource& source_;
  Groups groups_;
  double metres_ = 0.0;
  std::vector<DrawnShape> shapes_;
};

}  // namespace

std::vector<DrawnShape> read_dxf(std::string_view text, const DrawnSource& source) {
  if (text.starts_with("AutoCAD Binary DXF")) refuse_dxf(source, 0, "this is a binary DXF file", "an ASCII DXF file");
  return DxfReader(text, source).shapes();
}

}  // namespace perfora::geometry
