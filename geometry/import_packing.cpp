// What is here: a packing of someone else's: read from CSV or files of LAMMPS, checked. What is not: packings made here
// (make_packing.cpp), the formats of LAMMPS (lammps_file.h).
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>
#include <string>

#include "geometry/lammps_file.h"
#include "geometry/make_packing.h"
#include "geometry/plane.h"
#include "io/csv.h"
#include "io/error.h"
#include "io/files.h"
#include "io/text.h"
#include "io/text_file.h"
#include "io/units.h"

namespace perfora::geometry {

namespace {

/// Discs in m, from the lower left corner of their box, in the plane of the block.
struct Discs {
  std::vector<double> x, y, radius;
  std::vector<int> lines;
};

/// Refuses a disc that lies within another one. Discs by rising x, each against those that begin within the largest
/// diameter: called only where there is such a pair.
void refuse_disc_within_another(const Packing& packing, const std::vector<int>& lines,
                                const std::filesystem::path& file) {
  std::vector<std::size_t> order(packing.x.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) { return packing.x[a] < packing.x[b]; });
  const double reach = 2.0 * *std::max_element(packing.radius.begin(), packing.radius.end());
  for (std::size_t k = 0; k < order.size(); ++k)
    for (std::size_t next = 1; next < order.size(); ++next) {
      const std::size_t i = order[k], j = order[(k + next) % order.size()];
      double dx = packing.x[j] - packing.x[i], dy = packing.y[j] - packing.y[i];
      if (dx < 0.0) dx += packing.width;
      if (dx > reach) break;
      dx -= packing.width * std::round(dx / packing.width);
      dy -= packing.height * std::round(dy / packing.height);
      if (std::hypot(dx, dy) > std::abs(packing.radius[i] - packing.radius[j])) continue;
      throw io::InputError({file.string(), lines[std::max(i, j)], "packing.file"},
                           fmt::format("this disc and the one of line {} lie within each other, as they are or across "
                                       "the boundary",
                                       lines[std::min(i, j)]),
                           "discs of a packing touch at most", "give each disc once, and one frame of a trajectory");
    }
}

double metres(std::string_view unit, const io::Origin& origin = {}) {
  return io::parse_quantity(io::Value{fmt::format("1 {}", unit)}, io::Dimension::length, origin);
}

/// m of one unit of length of the file; 0: nobody says.
double unit_of(const PackingOptions& options) {
  if (options.file_unit.empty()) return 0.0;
  const io::Origin origin{options.file.string(), 0, "packing.file_unit"};
  if (!io::is_unit(options.file_unit, io::Dimension::length))
    throw io::InputError(origin, io::in_quotes(options.file_unit) + " is no unit of length",
                         io::accepted_units(io::Dimension::length), "write file_unit = \"mm\"");
  return metres(options.file_unit, origin);
}

/// The planes by their names in a design.
constexpr std::pair<ImportPlane, const char*> planes[] = {
    {ImportPlane::xy, "xy"}, {ImportPlane::xz, "xz"}, {ImportPlane::yz, "yz"}};

std::array<std::size_t, 3> axes_of(ImportPlane plane) {
  if (plane == ImportPlane::xz) return {0, 2, 1};
  if (plane == ImportPlane::yz) return {1, 2, 0};
  return {0, 1, 2};
}

Discs scaled(io::CsvTable table, double unit) {
  for (auto& column : table.columns)
    for (double& value : column) value *= unit;
  return {std::move(table.columns[0]), std::move(table.columns[1]), std::move(table.columns[2]),
          std::move(table.lines)};
}

Discs discs_of_csv(const PackingOptions& options) {
  const auto most = static_cast<std::size_t>(maximum_discs);
  const std::vector<std::string> names = io::csv_names(options.file);
  const auto axes = axes_of(options.file_plane);
  const std::string first(1, "xyz"[axes[0]]), second(1, "xyz"[axes[1]]);
  const bool with_units = std::any_of(names.begin(), names.end(), [](const std::string& name) {
    return name.find_first_of("[(") != std::string::npos;
  });
  const bool diameters =
      std::any_of(names.begin(), names.end(), [](const std::string& name) { return name.starts_with("diameter"); }) &&
      std::none_of(names.begin(), names.end(), [](const std::string& name) { return name.starts_with("radius"); });
  const std::string size = diameters ? "diameter" : "radius";
  const auto has = [&](char axis) {
    return std::any_of(names.begin(), names.end(), [&](const std::string& name) {
      return name.substr(0, name.find_first_of(" [(")) == std::string(1, axis);
    });
  };
  for (const auto& [plane, name] : planes)
    if (options.file_plane == ImportPlane::xy && has(name[0]) && has(name[1]) && !(has('x') && has('y')))
      throw io::InputError({options.file.string(), 1, "packing.file_plane"},
                           fmt::format("the file has columns {} and {}, not x and y", name[0], name[1]), "",
                           fmt::format("write file_plane = \"{}\" under [packing]", name));
  const double unit = unit_of(options);
  if (with_units && unit > 0.0)
    throw io::InputError({options.file.string(), 1, "packing.file_unit"}, "the header names units already",
                         "units in the header, or file_unit", "leave one of them out");
  io::CsvTable table;
  if (with_units) {
    const auto column = [](const std::string& name) {
      return io::CsvQuantity{{name}, io::Dimension::length, name + " [mm]"};
    };
    table = io::read_csv(options.file, {column(first), column(second), column(size)}, most);
  } else {
    table = io::read_csv(options.file, {first, second, size}, most);
  }
  if (diameters)
    for (double& value : table.columns[2]) value *= 0.5;
  if (unit == 0.0) return {table.columns[0], table.columns[1], table.columns[2], table.lines};
  return scaled(std::move(table), unit);
}

/// What would make a box that is not the cell fit: another plane, another unit, another frame, the cell itself.
std::string remedy_for_box(const LammpsSpheres& spheres, const PackingOptions& options, double unit, double width,
                           double height) {
  const auto span = [&](std::size_t axis) { return spheres.high[axis] - spheres.low[axis]; };
  const auto alike = [](double found, double wanted) { return std::abs(found - wanted) <= 1e-3 * wanted; };
  const auto fits = [&](ImportPlane plane, double of_unit) {
    const auto axes = axes_of(plane);
    return alike(of_unit * span(axes[0]), width) && alike(of_unit * span(axes[1]), height);
  };
  constexpr const char* units[] = {"m", "cm", "mm", "um"};
  for (const auto& [plane, name] : planes)
    if (plane != options.file_plane && fits(plane, unit)) return fmt::format("write file_plane = \"{}\"", name);
  for (const char* name : units)
    if (fits(options.file_plane, metres(name))) return fmt::format("write file_unit = \"{}\"", name);
  for (const auto& [plane, plane_name] : planes)
    for (const char* name : units)
      if (fits(plane, metres(name)))
        return fmt::format("write file_plane = \"{}\" and file_unit = \"{}\"", plane_name, name);
  const auto axes = axes_of(options.file_plane);
  if (alike(unit * span(axes[0]), width) && unit * span(axes[1]) < height)
    return "of a dump the last frame counts, which is compressed where the dump is of a run: write the block before it "
           "is "
           "loaded with perfora export RUN.h5 --lammps-dump --at 0, or give the cell the size of the box";
  return "give the cell the size of the box, or correct packing.file_unit or packing.file_plane";
}

void check_box(const PackingOptions& options, const LammpsSpheres& spheres, const std::array<std::size_t, 3>& axes,
               double unit, double width, double height) {
  constexpr double alike = 1e-6;
  for (const std::size_t k : {std::size_t{0}, std::size_t{1}}) {
    const double box = unit * (spheres.high[axes[k]] - spheres.low[axes[k]]), cell = k == 0 ? width : height;
    const bool fits = spheres.periodic[axes[k]] ? std::abs(box - cell) <= alike * cell : box <= (1.0 + alike) * cell;
    if (fits) continue;
    throw io::InputError(
        {options.file.string(), 0, k == 0 ? "cell.width" : "cell.height"},
        fmt::format("the box of the file is {} along {}, the cell {}", io::quantity(box, io::Dimension::length),
                    "xyz"[axes[k]], io::quantity(cell, io::Dimension::length)),
        spheres.periodic[axes[k]] ? "a periodic box of the size of the cell" : "a box no larger than the cell",
        remedy_for_box(spheres, options, unit, width, height));
  }
}

void check_plane(const PackingOptions& options, const LammpsSpheres& spheres, std::size_t axis) {
  if (spheres.radius.empty()) return;
  const auto [low, high] = std::minmax_element(spheres.place[axis].begin(), spheres.place[axis].end());
  const double largest = *std::max_element(spheres.radius.begin(), spheres.radius.end());
  if (*high - *low <= largest) return;
  throw io::InputError(
      {options.file.string(), spheres.lines[static_cast<std::size_t>(high - spheres.place[axis].begin())],
       "packing.file_plane"},
      fmt::format("the discs lie in no plane: {} goes from {} to {}", "xyz"[axis], *low, *high), "discs in one plane",
      "name the plane by packing.file_plane, or give a two-dimensional packing");
}

Discs discs_of_lammps(const PackingOptions& options, const LammpsSpheres& spheres, double width, double height) {
  double unit = unit_of(options);
  if (unit == 0.0) unit = metres_of_lammps_units(spheres.units);
  if (unit == 0.0)
    throw io::InputError({options.file.string(), 0, "packing.file_unit"},
                         spheres.units.empty() ? "the file does not say the unit of its lengths"
                                               : "units " + io::in_quotes(spheres.units) + " have no length in metres",
                         io::accepted_units(io::Dimension::length), "write file_unit = \"mm\" under [packing]");
  const auto axes = axes_of(options.file_plane);
  check_box(options, spheres, axes, unit, width, height);
  check_plane(options, spheres, axes[2]);
  Discs discs;
  for (const double x : spheres.place[axes[0]]) discs.x.push_back(unit * (x - spheres.low[axes[0]]));
  for (const double y : spheres.place[axes[1]]) discs.y.push_back(unit * (y - spheres.low[axes[1]]));
  for (const double radius : spheres.radius) discs.radius.push_back(unit * radius);
  discs.lines = spheres.lines;
  return discs;
}

Discs read_discs(const PackingOptions& options, double width, double height) {
  constexpr std::size_t enough = 4000;
  const std::string beginning = io::read_beginning(options.file, enough), name = options.file.string();
  const auto most = static_cast<std::size_t>(maximum_discs);
  if (is_lammps_dump(beginning))
    return discs_of_lammps(options, read_lammps_dump(io::read_file(options.file), name, most), width, height);
  if (io::is_hdf5(beginning))
    throw io::InputError({name, 0, "packing.file"}, "is an HDF5 file", "CSV, or a dump or data file of LAMMPS",
                         "give a packing of perfora by --packing, not as packing.file");
  if (is_lammps_data(beginning))
    return discs_of_lammps(options, read_lammps_data(io::read_file(options.file), name, most), width, height);
  return discs_of_csv(options);
}

}  // namespace

std::string import_note(const PackingOptions& options) {
  constexpr std::size_t enough = 4000;
  const std::string beginning = io::read_beginning(options.file, enough);
  if (is_lammps_dump(beginning) || is_lammps_data(beginning) || !io::csv_names(options.file).empty()) return {};
  const auto axes = axes_of(options.file_plane);
  return fmt::format(
      "{} has no header: its columns are taken for {}, {} and radius{}; name them in a first line, such as "
      "\"x [mm], y [mm], diameter [mm]\"",
      options.file.string(), "xyz"[axes[0]], "xyz"[axes[1]],
      options.file_unit.empty() ? " in metres" : fmt::format(" in {}", options.file_unit));
}

Packing import_packing(const PackingOptions& options, double width, double height) {
  const Discs discs = read_discs(options, width, height);
  const std::filesystem::path& file = options.file;
  Packing packing;
  packing.width = width;
  packing.height = height;
  const double side = std::min(width, height);
  for (std::size_t k = 0; k < discs.x.size(); ++k) {
    const double radius = discs.radius[k];
    if (!(radius > 0.0 && 2.0 * radius * largest_discs_along_a_side <= side))
      throw io::InputError(
          {file.string(), discs.lines[k], "packing.file"}, "a disc of this radius does not belong in the cell",
          fmt::format("radii above 0, and a cell of at least {:g} of the largest discs along each side",
                      largest_discs_along_a_side),
          options.file_unit.empty()
              ? "give x, y and radius in metres, or say their unit: file_unit = \"mm\" under [packing]"
              : "correct packing.file_unit, or the cell");
    packing.x.push_back(wrapped(discs.x[k], width));
    packing.y.push_back(wrapped(discs.y[k], height));
    packing.radius.push_back(radius);
  }
  if (discs.x.size() < 2)
    throw io::InputError({file.string(), 0, "packing.file"}, "there are fewer than two discs", "two or more",
                         "give one disc a line");
  packing.key = packing_key(options, width, height, 0);
  packing.quality = measure_packing(packing);
  if (packing.quality.solid_fraction >= 1.0)
    throw io::InputError(
        {file.string(), 0, "packing.file"},
        fmt::format("the discs have {:.4g} times the area of the cell of {}", packing.quality.solid_fraction,
                    io::quantities({width, height}, io::Dimension::length, " x ")),
        "less than the cell", "give one frame of a trajectory, or the cell that the packing was made in");
  if (packing.quality.max_overlap_ratio >= 1.0) refuse_disc_within_another(packing, discs.lines, file);
  return packing;
}

}  // namespace perfora::geometry
