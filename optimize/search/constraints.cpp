// What is here: measuring a layout against the constraints of a study. What is not: simulations.
#include "optimize/search/constraints.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "geometry/layout.h"
#include "geometry/wall.h"
#include "io/text.h"

namespace perfora::optimize {
namespace {

/// Bounds of g: a constraint further off than this is as bad as it gets, and NLopt must see finite numbers only.
constexpr double largest_value = 1e3;
constexpr double border = 1e-9;
constexpr double violation_scale = 1e3;

double bounded(double value) {
  return std::clamp(value, -largest_value, largest_value);
}

double wanted_wall(const ConstraintKeys& keys, const Design& design) {
  const double horizon = design.solver.material.horizon * design.packing.mean_diameter;
  return std::max({keys.thinnest_wall, design.layout.scale * design.layout.minimum_wall, horizon});
}

}  // namespace

void describe(io::Schema& schema, ConstraintKeys& keys) {
  auto section =
      schema.section("constraints", "What every candidate must keep; checked on its layout before any simulation.");
  section.real("thinnest_wall", keys.thinnest_wall, io::Dimension::length, io::Range::non_negative(),
               "Smallest wall between holes; the horizon of the bonds holds as well");
  section.real_list("porosity", keys.porosity, io::Dimension::ratio, io::Range::between(0.0, 1.0),
                    "Lowest and highest fraction of the cell that holes may take");
}

LayoutMeasure measure_layout(const DesignFile& design) {
  LayoutMeasure measure;
  try {
    const auto seed = design.design().seeds.effective(0).layout;
    const auto layout = geometry::place_perforations(design.design().layout, seed, &design.schema());
    measure.thinnest_wall = layout.perforations.empty() ? std::numeric_limits<double>::infinity()
                                                        : geometry::thinnest_wall(layout).thickness;
    measure.porosity = 1.0 - layout.solid_area_fraction();
    measure.placed = true;
  } catch (const io::InputError& error) {
    measure.problem = error.problem();
  }
  return measure;
}

std::vector<double> constraint_values(const ConstraintKeys& keys, const DesignFile& design,
                                      const LayoutMeasure& measure) {
  const bool bounded_porosity = keys.porosity.size() == 2;
  if (!measure.placed) return std::vector<double>(bounded_porosity ? 3 : 1, 1.0);
  const double wall = wanted_wall(keys, design.design());
  std::vector<double> values{bounded((wall - measure.thinnest_wall) / wall)};
  if (bounded_porosity) {
    values.push_back(bounded((keys.porosity[0] - measure.porosity) / keys.porosity[1]));
    values.push_back(bounded((measure.porosity - keys.porosity[1]) / keys.porosity[1]));
  }
  return values;
}

std::vector<std::string> constraint_names(const ConstraintKeys& keys) {
  if (keys.porosity.size() == 2) return {"thinnest_wall", "lowest porosity", "highest porosity"};
  return {"thinnest_wall"};
}

std::vector<std::string> in_words(const ConstraintKeys& keys, const Design& design) {
  std::vector<std::string> lines{"thinnest wall: at least " +
                                 io::quantity(wanted_wall(keys, design), io::Dimension::length)};
  if (keys.porosity.size() == 2)
    lines.push_back("porosity: " + io::quantities(keys.porosity, io::Dimension::ratio, " to "));
  return lines;
}

double violation(std::span<const double> values) {
  double sum = 0.0;
  for (const double value : values)
    if (value > border) sum += value;
  return sum;
}

double violation_score(double violation) {
  return violation_scale * (1.0 + violation);
}

}  // namespace perfora::optimize
