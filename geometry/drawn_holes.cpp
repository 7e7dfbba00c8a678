// What is here: which outlines of a drawing are the block and its holes. What is not: whether walls are thick enough
// (layout.cpp).
#include "geometry/drawn_holes.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>

#include "geometry/drawn_shapes.h"
#include "geometry/layout.h"
#include "geometry/make_shape.h"
#include "geometry/outline_file.h"
#include "io/error.h"
#include "io/files.h"
#include "io/letters.h"
#include "io/text.h"
#include "io/units.h"

namespace perfora::geometry {
namespace {

constexpr double same_image = 1e-6;       // m: of two images of a hole
constexpr double block_tolerance = 1e-4;  // of the cell

Bounds bounds_of_shape(const DrawnShape& shape) {
  if (shape.diameter > 0.0) {
    const double r = 0.5 * shape.diameter;
    return {shape.centre.x - r, shape.centre.x + r, shape.centre.y - r, shape.centre.y + r};
  }
  constexpr double far = std::numeric_limits<double>::infinity();
  Bounds box{far, -far, far, -far};
  for (const Point& corner : shape.corners) {
    box.left = std::min(box.left, corner.x);
    box.right = std::max(box.right, corner.x);
    box.bottom = std::min(box.bottom, corner.y);
    box.top = std::max(box.top, corner.y);
  }
  return box;
}

bool is_in(const DrawnShape& shape, const std::string& layer) {
  return std::find(shape.layers.begin(), shape.layers.end(), layer) != shape.layers.end();
}

class Drawn {
 public:
  Drawn(const LayoutOptions& options, std::size_t most) : options_(options), most_(most) {}

  std::vector<Perforation> holes() {
    shapes_ = read();
    choose_layer();
    find_block();
    std::vector<Perforation> holes;
    for (const DrawnShape& shape : shapes_)
      if (is_hole(shape)) add(holes, shape);
    if (holes.empty())
      throw io::InputError(origin(0), "the drawing holds no holes",
                           layer_.empty() ? "closed outlines" : "closed outlines in the layer " + io::in_quotes(layer_),
                           "check the file, and layout.file_layer");
    return holes;
  }

 private:
  io::Origin origin(int line) const { return {options_.file.string(), line, "layout.file"}; }

  double metres() const {
    if (options_.file_unit.empty()) return 0.0;
    const io::Origin key{options_.file.string(), 0, "layout.file_unit"};
    if (!io::is_unit(options_.file_unit, io::Dimension::length))
      throw io::InputError(key, io::in_quotes(options_.file_unit) + " is no unit of length",
                           io::accepted_units(io::Dimension::length), "write file_unit = \"mm\"");
    return io::parse_quantity(io::Value{"1 " + options_.file_unit}, io::Dimension::length, key);
  }

  std::vector<DrawnShape> read() const {
    constexpr std::size_t largest_file = std::size_t{1} << 26;
    const std::string text = io::read_file(options_.file, largest_file),
                      kind = io::lower(options_.file.extension().string());
    const DrawnSource source{options_.file.string(), metres()};
    return kind == ".dxf" ? read_dxf(text, source) : kind == ".svg" ? read_svg(text, source) : read_wkt(text, source);
  }

  void choose_layer() {
    const auto there = [this](const std::string& name) {
      return std::any_of(shapes_.begin(), shapes_.end(), [&](const DrawnShape& shape) { return is_in(shape, name); });
    };
    layer_ = io::lower(options_.file_layer);
    if (layer_.empty() && there("holes")) layer_ = "holes";
    if (layer_.empty() || there(layer_)) return;
    std::vector<std::string> names;
    for (const DrawnShape& shape : shapes_) names.insert(names.end(), shape.layers.begin(), shape.layers.end());
    std::sort(names.begin(), names.end());
    names.erase(std::unique(names.begin(), names.end()), names.end());
    throw io::InputError({options_.file.string(), 0, "layout.file_layer"},
                         "the drawing has no layer or group " + io::in_quotes(options_.file_layer),
                         names.empty() ? "none: it has no layers" : io::joined(names), "name the one with the holes");
  }

  bool has_size_of_cell(const Bounds& box) const {
    return std::abs(box.width() - options_.width) <= block_tolerance * options_.width &&
           std::abs(box.height() - options_.height) <= block_tolerance * options_.height;
  }
  static bool is_rectangle(const DrawnShape& shape, const Bounds& box) {
    constexpr std::size_t corners = 4;
    return shape.diameter == 0.0 && shape.corners.size() == corners &&
           std::all_of(shape.corners.begin(), shape.corners.end(), [&](const Point& corner) {
             const double off_x = std::min(corner.x - box.left, box.right - corner.x),
                          off_y = std::min(corner.y - box.bottom, box.top - corner.y);
             return off_x <= block_tolerance * box.width() && off_y <= block_tolerance * box.height();
           });
  }

  void find_block() {
    for (std::size_t k = 0; k < shapes_.size(); ++k) {
      const DrawnShape& shape = shapes_[k];
      if (!shape.problem.empty()) continue;
      const Bounds box = bounds_of_shape(shape);
      const bool named = is_in(shape, "block") && layer_ != "block";
      if (named && !has_size_of_cell(box))
        throw io::InputError(
            origin(shape.line),
            "the block of the drawing is " + io::quantities({box.width(), box.height()}, io::Dimension::length, " x "),
            "the cell of " + io::quantities({options_.width, options_.height}, io::Dimension::length, " x "),
            "correct cell.width and cell.height, or layout.file_unit");
      if (!named && !(is_rectangle(shape, box) && has_size_of_cell(box))) continue;
      if (block_ && !named) continue;
      block_ = k;
      corner_ = {box.left, box.bottom};
      if (named) return;
    }
  }

  bool is_hole(const DrawnShape& shape) const {
    if (block_ && &shape == &shapes_[*block_]) return false;
    if (layer_.empty() ? is_in(shape, "block") : !is_in(shape, layer_)) return false;
    if (shape.problem.empty()) return true;
    if (layer_.empty() && !shape.hides_holes) return false;
    throw io::InputError(origin(shape.line), shape.problem, "closed outlines and circles",
                         layer_.empty() ? "take it apart, or name the layer of the holes in layout.file_layer"
                                        : "close or take it apart, or move it to another layer");
  }

  Perforation hole_of(const DrawnShape& shape) const {
    if (shape.diameter > 0.0) return {shape.centre.x - corner_.x, shape.centre.y - corner_.y, Circle{shape.diameter}};
    ShapeSize size;
    size.outline = shape.corners;
    if (const auto fault = fault_of(ShapeKind::polygon, size))
      throw io::InputError(origin(shape.line), "this outline is no hole: " + fault->problem, fault->allowed,
                           "correct or remove it");
    const Point middle = middle_of(shape.corners);
    return {middle.x - corner_.x, middle.y - corner_.y, make_shape(ShapeKind::polygon, size)};
  }

  void add(std::vector<Perforation>& holes, const DrawnShape& shape) const {
    Perforation hole = hole_of(shape);
    const Bounds box = hole.bounds();
    if (!(box.right > 0.0 && box.left < options_.width && box.top > 0.0 && box.bottom < options_.height))
      throw io::InputError(origin(shape.line),
                           "hole " + std::to_string(holes.size() + 1) + " at (" +
                               io::quantity(hole.x, io::Dimension::length) + ", " +
                               io::quantity(hole.y, io::Dimension::length) + ") lies outside the cell",
                           "0 to " + io::quantity(options_.width, io::Dimension::length) + " in x, 0 to " +
                               io::quantity(options_.height, io::Dimension::length) + " in y",
                           "draw the outline of the block, whose lower left corner is then the origin");
    const bool crosses = box.left < 0.0 || box.right > options_.width || box.bottom < 0.0 || box.top > options_.height;
    hole.x = wrapped(hole.x, options_.width);
    hole.y = wrapped(hole.y, options_.height);
    if (crosses && std::any_of(holes.begin(), holes.end(), [&](const Perforation& other) { return same(hole, other); }))
      return;
    if (holes.size() == most_)
      throw io::InputError(origin(shape.line), "the drawing has too many holes", "at most " + std::to_string(most_),
                           "keep the holes of one block");
    holes.push_back(std::move(hole));
  }

  bool same(const Perforation& a, const Perforation& b) const {
    const double dx = std::remainder(a.x - b.x, options_.width), dy = std::remainder(a.y - b.y, options_.height);
    return std::hypot(dx, dy) < same_image && std::abs(a.largest_extent() - b.largest_extent()) < same_image &&
           std::abs(a.smallest_extent() - b.smallest_extent()) < same_image;
  }

  const LayoutOptions& options_;
  std::size_t most_;
  std::vector<DrawnShape> shapes_;
  std::string layer_;
  std::optional<std::size_t> block_;
  Point corner_;
};

}  // namespace

bool is_drawing(const std::filesystem::path& file) {
  const std::string kind = io::lower(file.extension().string());
  return kind == ".dxf" || kind == ".svg" || kind == ".wkt";
}

std::vector<Perforation> drawn_holes(const LayoutOptions& options, std::size_t most) {
  return Drawn(options, most).holes();
}

std::vector<DrawnShape> read_wkt(std::string_view text, const DrawnSource& source) {
  auto read = parse_wkt_polygons(text);
  const auto line = [&](std::size_t offset) {
    return 1 + static_cast<int>(std::count(text.begin(), text.begin() + static_cast<std::ptrdiff_t>(offset), '\n'));
  };
  if (const auto* problem = std::get_if<WktProblem>(&read))
    throw io::InputError({source.name, line(problem->offset), "layout.file"}, problem->text,
                         "POLYGON ((x y, x y, ...)), a hole each, or MULTIPOLYGON", "correct the text");
  const double metres = source.metres > 0.0 ? source.metres : 1.0;
  std::vector<DrawnShape> shapes;
  for (WktPolygon& polygon : std::get<std::vector<WktPolygon>>(read)) {
    DrawnShape shape;
    shape.line = line(polygon.offset);
    for (const Point& corner : polygon.corners) shape.corners.push_back({metres * corner.x, metres * corner.y});
    shapes.push_back(std::move(shape));
  }
  return shapes;
}

}  // namespace perfora::geometry
