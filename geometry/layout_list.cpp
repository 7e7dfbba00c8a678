// What is here: the rows of a list of holes. What is not: whether their walls are thick enough (layout.cpp).
#include "geometry/layout_list.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <string>

#include "geometry/drawn_holes.h"
#include "geometry/layout.h"
#include "geometry/make_shape.h"
#include "geometry/outline_file.h"
#include "geometry/plane.h"
#include "io/csv.h"
#include "io/text.h"
#include "io/units.h"

namespace perfora::geometry {
namespace {

using Usual = std::function<Shape(double)>;

std::string name_of_next(const std::vector<Perforation>& holes) {
  return "hole " + std::to_string(holes.size() + 1);
}

void add_listed(std::vector<Perforation>& holes, const LayoutOptions& cell, double x, double y, Shape shape,
                const io::Origin& origin) {
  if (!(x >= 0.0 && x <= cell.width && y >= 0.0 && y <= cell.height))
    throw io::InputError(origin,
                         name_of_next(holes) + " at (" + io::quantity(x, io::Dimension::length) + ", " +
                             io::quantity(y, io::Dimension::length) + ") lies outside the cell",
                         "0 to " + io::quantity(cell.width, io::Dimension::length) + " in x, 0 to " +
                             io::quantity(cell.height, io::Dimension::length) + " in y",
                         "give centres in metres within the cell");
  holes.push_back({wrapped(x, cell.width), wrapped(y, cell.height), std::move(shape)});
}

void add_usual(std::vector<Perforation>& holes, const LayoutOptions& cell, const Usual& usual, double x, double y,
               double diameter, const io::Origin& origin) {
  if (!(std::isfinite(diameter) && diameter > 0.0))
    throw io::InputError(origin, name_of_next(holes) + " has no size", "a positive diameter in metres",
                         "correct or leave out this hole");
  add_listed(holes, cell, x, y, usual(diameter), origin);
}

io::Origin unit_key(const LayoutOptions& options) {
  return {options.file.string(), 0, "layout.file_unit"};
}

/// A file whose first line names its columns: x, y and diameter, or more of its shapes.
class NamedRows {
 public:
  NamedRows(const LayoutOptions& options, const Usual& usual, io::CsvTexts table)
      : options_(options), usual_(usual), table_(std::move(table)) {
    const io::Origin header{options.file.string(), 0, "layout.file"};
    for (auto name = table_.names.begin(); name != table_.names.end(); ++name)
      if (!name->empty() && std::find(std::next(name), table_.names.end(), *name) != table_.names.end())
        throw io::InputError(header, "names the column " + *name + " twice", "", "remove one of them");
    for (const char* name : {"x", "y", "diameter"})
      if (!place_of("wkt") && !place_of(name))
        throw io::InputError(header, std::string("has no column ") + name,
                             "its columns are " + io::joined(table_.names) + "; x, y and diameter, or wkt, are wanted",
                             "name the columns in the first line; drawings end in .dxf, .svg or .wkt");
    const bool units =
        std::any_of(table_.units.begin(), table_.units.end(), [](const auto& one) { return !one.empty(); });
    if (units && !options.file_unit.empty())
      throw io::InputError(unit_key(options), "the header names units already", "units in the header, or file_unit",
                           "leave one of them out");
  }

  std::vector<Perforation> holes() const {
    std::vector<Perforation> holes;
    for (std::size_t row = 0; row < table_.rows.size(); ++row)
      if (text(row, "wkt").empty())
        add_by_name(holes, row);
      else
        add_outline(holes, row);
    if (holes.empty())
      throw io::InputError({options_.file.string(), 0, ""}, "holds no holes", "a hole a line", "check the path");
    return holes;
  }

 private:
  io::Origin origin(std::size_t row) const { return {options_.file.string(), table_.lines[row], "layout.file"}; }

  std::optional<std::size_t> place_of(const char* column) const {
    const auto found = std::find(table_.names.begin(), table_.names.end(), column);
    if (found == table_.names.end()) return std::nullopt;
    return static_cast<std::size_t>(found - table_.names.begin());
  }

  std::string text(std::size_t row, const char* column) const {
    const auto place = place_of(column);
    return place ? table_.rows[row][*place] : std::string();
  }

  /// Of the plain numbers of a column: from the header, or file_unit for lengths; "": SI.
  std::string unit_of(const char* column, io::Dimension dimension) const {
    const std::string& own = table_.units[*place_of(column)];
    return own.empty() && dimension == io::Dimension::length ? options_.file_unit : own;
  }

  /// Numbers without a unit of their own are in that of the column.
  std::optional<double> number(std::size_t row, const char* column, io::Dimension dimension) const {
    const std::string field = text(row, column);
    if (field.empty()) return std::nullopt;
    const double plain = io::number_in(field);
    const std::string unit = std::isnan(plain) ? std::string() : unit_of(column, dimension);
    std::string quantity = field;
    if (!unit.empty()) quantity.append(" ").append(unit);
    const bool has_unit = std::isnan(plain) || !unit.empty();
    const double value = has_unit ? io::parse_quantity({quantity, 0}, dimension, origin(row)) : plain;
    if (!std::isfinite(value))
      throw io::InputError(origin(row), std::string("column ") + column + ": " + field + " is not a finite number");
    return value;
  }

  double needed(std::size_t row, const char* column) const {
    const auto value = number(row, column, io::Dimension::length);
    if (!value)
      throw io::InputError(origin(row), std::string("column ") + column + " is missing or empty",
                           "x, y, diameter and what the shape needs, or wkt", "complete this line");
    return *value;
  }

  void refuse(std::size_t row, std::initializer_list<const char*> unwanted, const std::string& why) const {
    for (const char* column : unwanted)
      if (!text(row, column).empty())
        throw io::InputError(origin(row), std::string("column ") + column + " means nothing " + why, "an empty field",
                             "empty it");
  }

  ShapeKind kind_of(std::size_t row, const std::string& name) const {
    const auto kind = shape_kind_called(name);
    if (kind && *kind != ShapeKind::polygon) return *kind;
    throw io::InputError(origin(row), "there is no shape \"" + name + "\" in a list",
                         "circle, ellipse, slot, diamond, triangle, teardrop",
                         kind ? "give the outline of a polygon in a column wkt" : "correct this line");
  }

  Shape made(std::size_t row, ShapeKind kind, const ShapeSize& size) const {
    constexpr const char* members[] = {"diameter", "breadth", "angle", "corner_radius", "wkt"};
    if (const auto fault = fault_of(kind, size))
      throw io::InputError(origin(row),
                           std::string("column ") + members[static_cast<int>(fault->where)] + ": " + fault->problem,
                           fault->allowed, "correct this line");
    return make_shape(kind, size);
  }

  void add_by_name(std::vector<Perforation>& holes, std::size_t row) const {
    const double x = needed(row, "x"), y = needed(row, "y"), diameter = needed(row, "diameter");
    const std::string name = text(row, "shape");
    if (name.empty()) {
      refuse(row, {"breadth", "angle", "corner_radius"}, "without a shape");
      return add_usual(holes, options_, usual_, x, y, diameter, origin(row));
    }
    const ShapeKind kind = kind_of(row, name);
    if (kind == ShapeKind::circle) refuse(row, {"breadth"}, "for a circle");
    ShapeSize size;
    size.length = diameter;
    if (kind != ShapeKind::circle) size.breadth = needed(row, "breadth");
    size.angle = number(row, "angle", io::Dimension::angle).value_or(0.0);
    size.corner_radius = number(row, "corner_radius", io::Dimension::length).value_or(0.0);
    add_listed(holes, options_, x, y, made(row, kind, size), origin(row));
  }

  // The middle of an outline may lie beyond an edge that the outline crosses.
  void add_outline(std::vector<Perforation>& holes, std::size_t row) const {
    refuse(row, {"x", "y", "diameter", "breadth", "angle"}, "beside wkt, which says where the corners are");
    const std::string name = text(row, "shape");
    if (!name.empty() && name != "polygon") refuse(row, {"shape"}, "beside wkt, which is a polygon");
    auto read = parse_wkt_polygon(text(row, "wkt"));
    if (const auto* problem = std::get_if<std::string>(&read))
      throw io::InputError(origin(row), "column wkt: " + *problem, "POLYGON ((x y, x y, ...)) in metres",
                           "correct this line");
    ShapeSize size;
    size.outline = std::get<std::vector<Point>>(std::move(read));
    if (const std::string unit = unit_of("wkt", io::Dimension::length); !unit.empty()) {
      const double scale = io::parse_quantity({"1 " + unit, 0}, io::Dimension::length, origin(row));
      for (Point& corner : size.outline) corner = {scale * corner.x, scale * corner.y};
    }
    size.corner_radius = number(row, "corner_radius", io::Dimension::length).value_or(0.0);
    Shape shape = made(row, ShapeKind::polygon, size);
    const Point middle = middle_of(size.outline);
    const Perforation hole{middle.x, middle.y, std::move(shape)};
    const Bounds box = hole.bounds();
    const bool reaches_in =
        box.right > 0.0 && box.left < options_.width && box.top > 0.0 && box.bottom < options_.height;
    const double x = reaches_in ? wrapped(middle.x, options_.width) : middle.x;
    const double y = reaches_in ? wrapped(middle.y, options_.height) : middle.y;
    add_listed(holes, options_, x, y, hole.shape, origin(row));
  }

  const LayoutOptions& options_;
  const Usual& usual_;
  io::CsvTexts table_;
};

}  // namespace

std::vector<Perforation> listed_holes(const LayoutOptions& options, const Usual& usual, std::size_t most,
                                      const io::Origin& keys) {
  std::vector<Perforation> holes;
  if (options.file.empty()) {
    for (std::size_t k = 0; k + 2 < options.holes.size(); k += 3)
      add_usual(holes, options, usual, options.holes[k], options.holes[k + 1], options.holes[k + 2], keys);
    return holes;
  }
  if (is_drawing(options.file)) return drawn_holes(options, most);
  if (!io::csv_names(options.file).empty())
    return NamedRows(options, usual, io::read_csv_texts(options.file, most)).holes();
  const io::CsvTable table = io::read_csv(options.file, {"x", "y", "diameter"}, most);
  const double unit = options.file_unit.empty()
                          ? 1.0
                          : io::parse_quantity({"1 " + options.file_unit, 0}, io::Dimension::length, unit_key(options));
  for (std::size_t k = 0; k < table.rows(); ++k)
    add_usual(holes, options, usual, unit * table.columns[0][k], unit * table.columns[1][k], unit * table.columns[2][k],
              {options.file.string(), table.lines[k], "layout.file"});
  return holes;
}

}  // namespace perfora::geometry
