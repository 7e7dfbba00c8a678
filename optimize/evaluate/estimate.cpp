// What is here: what a design costs, by counts and closed forms. What is not: measured numbers of a run
// (solver::estimate_run counts bonds of a real
// packing).
#include "optimize/evaluate/estimate.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "geometry/clip.h"
#include "geometry/size_law.h"
#include "geometry/wall.h"
#include "io/error.h"
#include "io/text.h"
#include "optimize/evaluate/estimate_stepping.h"
#include "results/grade.h"
#include "solver/grade.h"
#include "solver/mass.h"
#include "solver/noise.h"
#include "solver/run_setup.h"

namespace perfora::optimize {

namespace {

/// Around a disc of a dense packing so many discs are missing within a few diameters: its own place, less the crowding
/// of its neighbours.
constexpr double missing_discs = 0.6;

/// Integral of the shared area of all holes over displacements up to `radius`: 2 pi int h shared(h) dh (Simpson's
/// rule).
double shared_hole_area(const geometry::PerforationLayout& layout, double radius) {
  constexpr int intervals = 64;  // the integrand is smooth up to h = a hole's width: error far below a per mille
  const double step = radius / intervals;
  double total = 0.0;
  for (int k = 0; k <= intervals; ++k) {
    const double h = k * step;
    double area = 0.0, of_one = 0.0;
    const geometry::Perforation* last = nullptr;
    for (const geometry::Perforation& hole : layout.perforations) {
      if (last == nullptr || !(hole.shape == last->shape)) of_one = hole.shared_area(h);
      area += of_one;
      last = &hole;
    }
    const double weight = k == 0 || k == intervals ? 1.0 : (k % 2 == 1 ? 4.0 : 2.0);
    total += weight * 2.0 * std::numbers::pi * h * area;
  }
  return total * step / 3.0;
}

/// The periodic packing in numbers.
struct Discs {
  std::int64_t count = 0;
  double mean_diameter = 0.0;
  std::int64_t left = 0;          ///< by the perforations
  std::vector<double> diameters;  ///< a sample
};

/// An imported packing may have its openings already: what the perforations take is counted there.
Discs periodic_discs(const Design& design, const geometry::PerforationLayout& layout) {
  const double width = design.layout.cell_width(), height = design.layout.cell_height();
  const geometry::PackingOptions& options = design.packing;
  if (!options.file.empty()) {
    const geometry::Packing packing = geometry::import_packing(options, width, height);
    Discs discs{packing.size(), packing.mean_diameter(), 0, {}};
    discs.left = geometry::clip_packing(packing, layout, options.clip).size();
    for (const double radius : packing.radius) discs.diameters.push_back(2.0 * radius);
    return discs;
  }
  Discs discs{geometry::expected_discs(options, width, height), options.mean_diameter, 0, {}};
  discs.left = std::llround(static_cast<double>(discs.count) * layout.solid_area_fraction());
  const geometry::SizeLaw law{
      geometry::size_law_exponent(options.mean_diameter, options.maximum_diameter, options.size_ratio),
      options.size_ratio};
  constexpr int sizes = 500;
  for (int k = 0; k < sizes; ++k) discs.diameters.push_back(options.maximum_diameter * law.quantile((k + 0.5) / sizes));
  return discs;
}

/// Steps along the path that the solver takes.
void estimate_steps(const Design& design, const geometry::PerforationLayout& layout, const Discs& discs,
                    DesignEstimate& estimate) {
  const double density = static_cast<double>(discs.count) / (layout.width * layout.height);
  const SteppingEstimate stepping = estimate_stepping(
      design.solver, layout, {density, discs.mean_diameter, estimate.bonds_per_disc, discs.diameters});
  const solver::LoadingPlan plan =
      solver::plan_loading(stepping.loading, design.solver.loading, solver::loaded_block(layout), stepping.time_step);
  estimate.time_step = plan.time_step;
  estimate.steps =
      solver::expected_steps(plan, stepping.loading, stepping.loading.bulk_density / design.solver.material.density);
  estimate.rate = design.solver.loading.until / (static_cast<double>(estimate.steps) * estimate.time_step);
}

double frame_count(const solver::SolverOptions& options) {
  const double until = options.loading.until;
  if (!options.output.frame_strains.empty()) return static_cast<double>(options.output.frame_strains.size());
  if (options.output.frames == solver::FrameChoice::few) return 2.0 + until * solver::few_frames_a_strain;
  if (options.output.frames == solver::FrameChoice::all) return 2.0 + until * solver::all_frames_a_strain;
  return 0.0;
}

/// Bytes and seconds from rough figures a bond, a disc, a row, a frame.
void estimate_resources(const Design& design, int threads, DesignEstimate& estimate) {
  constexpr double program_bytes = 3.0e7, bytes_per_bond = 220.0, bytes_per_disc = 1200.0;
  constexpr double nanoseconds_per_bond_step = 4.5;  // AVX-512, one thread; per bond of the intact block
  constexpr double file_bytes_per_bond = 30.0, file_bytes_per_disc = 200.0, file_bytes_per_row = 150.0;
  constexpr double frame_bytes_per_bond = 6.0, frame_bytes_per_disc = 30.0;
  const double discs = static_cast<double>(estimate.discs), bonds = static_cast<double>(estimate.bonds);
  const double rows = design.solver.loading.until / design.solver.output.history_interval;
  estimate.memory_bytes = program_bytes + bytes_per_bond * bonds + bytes_per_disc * discs;
  estimate.seconds = 1e-9 * nanoseconds_per_bond_step * static_cast<double>(estimate.steps) * bonds / threads;
  estimate.disk_bytes = file_bytes_per_bond * bonds + file_bytes_per_disc * discs + file_bytes_per_row * rows +
                        frame_count(design.solver) * (frame_bytes_per_bond * bonds + frame_bytes_per_disc * discs);
}

}  // namespace

std::vector<std::string> cost_warnings(const DesignEstimate& estimate) {
  constexpr double year = 365.0 * 86400.0;
  if (!(estimate.seconds > year)) return {};
  return {fmt::format(
      "a run takes some {} steps of {}, more than a year: take larger discs, a smaller cell, a larger "
      "dynamics.step_factor or a faster rate",
      io::count(static_cast<double>(estimate.steps)), io::quantity(estimate.time_step, io::Dimension::time))};
}

std::string memory_problem(const DesignFile& file, const DesignEstimate& estimate, double allowed) {
  if (!(estimate.memory_bytes > allowed)) return {};
  const auto text = [](double bytes) { return io::quantity(bytes, io::Dimension::memory); };
  // Bonds and discs go with the inverse square of the diameter.
  const double fitting = file.design().packing.mean_diameter * std::sqrt(estimate.memory_bytes / allowed);
  return fmt::format("a run of {} discs takes about {} of memory, and {} are allowed; {} would fit",
                     io::count(static_cast<double>(estimate.discs)), text(estimate.memory_bytes), text(allowed),
                     file.design().packing.file.empty()
                         ? fmt::format("packing.mean_diameter = \"{}\" or more, or a smaller cell,",
                                       io::quantity(fitting, io::Dimension::length))
                         : std::string("a packing of fewer discs"));
}

std::string memory_problem(const DesignFile& file, double allowed) {
  return memory_problem(file, estimate_design(file, 1), allowed);
}

std::vector<std::string> check_cost(const DesignFile& design, int threads, double memory) {
  const DesignEstimate estimate = estimate_design(design, threads);
  if (const std::string problem = memory_problem(design, estimate, memory); !problem.empty())
    throw io::InputError({design.path().string(), 0, ""}, problem, "",
                         "--memory SIZE (`memory` in the library) allows more at your own risk");
  return cost_warnings(estimate);
}

double characteristic_length(const solver::MaterialOptions& material, double mean_diameter) {
  if (material.characteristic_length > 0.0)
    return material.characteristic_length * mean_diameter / material.reference_mean_diameter;
  constexpr double at_three = 13.0, usual_horizon = 3.0, exponent = 1.4;
  return at_three * mean_diameter * std::pow(material.horizon / usual_horizon, exponent);
}

double expected_bonds_per_disc(const geometry::PerforationLayout& layout, double density, double radius) {
  const double solid = layout.solid_area_fraction();
  const double cell = layout.width * layout.height;
  if (solid <= 0.0) return 0.0;
  const double circle = std::numbers::pi * radius * radius;
  // Shared area of the solid and the solid moved by h: cell - 2 holes + holes shared with the moved holes.
  const double pairs = circle * cell * (2.0 * solid - 1.0) + shared_hole_area(layout, radius);
  const double fraction = pairs / (circle * cell * solid);  // of a full circle that lies in the solid, seen from a disc
  return std::max(0.0, (density * circle - missing_discs) * fraction);
}

double bonds_cut_by_edges(const geometry::PerforationLayout& layout, const solver::BoundaryOptions& boundary,
                          double density, double radius) {
  double level = boundary.top_bottom == solver::TopBottom::periodic ? 0.0 : layout.width;
  double upright = boundary.sides == solver::Sides::periodic ? 0.0 : layout.height;
  for (const geometry::Perforation& hole : layout.perforations) {
    // What the image nearest to an edge cuts out of it.
    if (level > 0.0) level -= hole.level_chord(-std::remainder(hole.y, layout.height));
    if (upright > 0.0) upright -= hole.upright_chord(-std::remainder(hole.x, layout.width));
  }
  return 2.0 / 3.0 * density * density * radius * radius * radius * (std::max(0.0, level) + std::max(0.0, upright));
}

DesignEstimate estimate_design(const DesignFile& file, int threads) {
  Design design = file.design();
  design.solver = solver::at_grade_one(design.solver);
  DesignEstimate estimate;
  const auto layout = geometry::make_layout(design.layout, design.seeds.effective(0).layout, &file.schema());
  const Discs discs = periodic_discs(design, layout);
  const double cell = layout.width * layout.height;
  const double solid = layout.solid_area_fraction();
  estimate.perforations = static_cast<std::int64_t>(layout.perforations.size());
  estimate.thinnest_wall = geometry::thinnest_wall(layout);
  estimate.porosity = 1.0 - solid;
  estimate.horizon_radius = design.solver.material.horizon * discs.mean_diameter;
  estimate.characteristic_length = characteristic_length(design.solver.material, discs.mean_diameter);
  estimate.discs = discs.left;
  const bool made = design.packing.file.empty();
  const double density =
      made ? static_cast<double>(discs.count) / cell : static_cast<double>(discs.left) / (cell * solid);
  const double cut = bonds_cut_by_edges(layout, design.solver.boundary, density, estimate.horizon_radius);
  estimate.bonds_per_disc = std::max(0.0, expected_bonds_per_disc(layout, density, estimate.horizon_radius) -
                                              2.0 * cut / std::max(1.0, static_cast<double>(estimate.discs)));
  estimate.bonds = std::llround(0.5 * estimate.bonds_per_disc * static_cast<double>(estimate.discs));
  estimate_steps(design, layout, discs, estimate);
  estimate_resources(design, threads, estimate);
  const results::GradeChange grade(file.design().solver.material.grade);
  estimate.time_step *= grade.time;
  estimate.rate *= grade.rate;
  return estimate;
}

}  // namespace perfora::optimize
