// What is here: see estimate.h. What is not: measured numbers of a run (solver::estimate_run counts bonds of a real
// packing).
#include "optimize/estimate.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace perfora::optimize {

namespace {

/// Area shared by two discs of diameter d whose centres are h apart.
double lens_area(double diameter, double h) {
  const double radius = 0.5 * diameter;
  if (h >= diameter) return 0.0;
  return 2.0 * radius * radius * std::acos(h / diameter) - 0.5 * h * std::sqrt(diameter * diameter - h * h);
}

/// Integral of the shared area of all holes over displacements up to `radius`: 2 pi int h lens(h) dh (Simpson's rule).
double shared_hole_area(const geometry::PerforationLayout& layout, double radius) {
  constexpr int intervals = 64;  // the integrand is smooth up to h = d: error far below a per mille
  const double step = radius / intervals;
  double total = 0.0;
  for (int k = 0; k <= intervals; ++k) {
    const double h = k * step;
    double area = 0.0;
    for (const geometry::Perforation& hole : layout.perforations) area += lens_area(hole.diameter, h);
    const double weight = k == 0 || k == intervals ? 1.0 : (k % 2 == 1 ? 4.0 : 2.0);
    total += weight * 2.0 * std::numbers::pi * h * area;
  }
  return total * step / 3.0;
}

/// The periodic packing in numbers.
struct Discs {
  std::int64_t count = 0;
  double mean_diameter = 0.0;
  double solid_fraction = 0.0;
};

/// What compaction reaches for the default size law, where the design leaves the fraction to it.
constexpr double jamming_fraction = 0.85;

double expected_fraction(const geometry::PackingOptions& packing) {
  return packing.solid_fraction > 0.0 ? packing.solid_fraction : jamming_fraction;
}

Discs periodic_discs(const Design& design) {
  const double width = design.layout.width, height = design.layout.height;
  if (!design.packing.file.empty()) {
    const geometry::Packing packing = geometry::import_packing(design.packing.file, width, height);
    return {packing.size(), packing.mean_diameter(), packing.quality.solid_fraction};
  }
  return {geometry::expected_discs(design.packing, width, height), design.packing.mean_diameter,
          expected_fraction(design.packing)};
}

/// Step and rate as the solver takes them (model.md, "Motion"), from mean values.
void estimate_stepping(const Design& design, const geometry::PerforationLayout& layout, const Discs& discs,
                       DesignEstimate& estimate) {
  const solver::MaterialOptions& material = design.solver.material;
  const double cell = layout.width * layout.height;
  const double density = static_cast<double>(discs.count) / cell;
  const double stiffness = material.normal_stiffness, shear = material.tangential_stiffness;
  const double disc_stiffness = 0.5 * estimate.bonds_per_disc * (stiffness + shear) + 6.0 * stiffness;
  const double disc_mass = material.density * discs.solid_fraction / density;
  // Uniform step: translation and rotation of every disc share one frequency.
  const double omega = std::sqrt(4.0 * disc_stiffness / disc_mass);
  estimate.time_step =
      design.solver.dynamics.step_factor * 2.0 / (omega * std::sqrt(1.0 + design.solver.dynamics.cundall_damping));
  // Block of springs: C11 by Voigt's bound, S = sum l^2/area with <l^2> = r_H^2/2, times the share of solid.
  const double radius = estimate.horizon_radius;
  const double bond_density = 0.5 * density * estimate.bonds_per_disc * layout.solid_area_fraction();
  const double modulus = 0.125 * bond_density * 0.5 * radius * radius * (3.0 * stiffness + shear);
  const double bulk = material.density * discs.solid_fraction * layout.solid_area_fraction();
  const double transit = layout.height / std::sqrt(modulus / bulk);
  constexpr double first_peak_strain = 0.01;
  estimate.rate = design.solver.loading.rate > 0.0 ? design.solver.loading.rate
                                                   : first_peak_strain / (design.solver.loading.transits * transit);
  estimate.steps = std::llround(design.solver.loading.until / (estimate.rate * estimate.time_step));
}

/// Bytes and seconds from rough figures a bond, a disc, a frame.
void estimate_resources(const Design& design, int threads, DesignEstimate& estimate) {
  constexpr double bytes_per_bond = 250.0, bytes_per_disc = 600.0, bytes_of_program = 3.0e7;
  constexpr double nanoseconds_per_bond_step = 10.0;  // one thread
  constexpr double file_bytes_per_disc = 20.0, file_bytes_per_bond = 6.0;
  const double discs = static_cast<double>(estimate.discs), bonds = static_cast<double>(estimate.bonds);
  estimate.memory_bytes = bytes_of_program + bytes_per_bond * bonds + bytes_per_disc * discs;
  estimate.seconds = 1e-9 * nanoseconds_per_bond_step * static_cast<double>(estimate.steps) * bonds / threads;
  const solver::OutputOptions& output = design.solver.output;
  double frames = 0.0;
  if (!output.frame_strains.empty())
    frames = static_cast<double>(output.frame_strains.size());
  else if (output.frames == solver::FrameChoice::few)
    frames = 3.0 + design.solver.loading.until / 0.1;
  else if (output.frames == solver::FrameChoice::all)
    frames = 2.0 + design.solver.loading.until / 0.01;
  estimate.disk_bytes = (frames + 3.0) * (file_bytes_per_disc * discs + file_bytes_per_bond * bonds);
}

}  // namespace

double expected_bonds_per_disc(const geometry::PerforationLayout& layout, double density, double radius) {
  const double solid = layout.solid_area_fraction();
  const double cell = layout.width * layout.height;
  if (solid <= 0.0) return 0.0;
  const double circle = std::numbers::pi * radius * radius;
  // Shared area of the solid and the solid moved by h: cell - 2 holes + holes shared with the moved holes.
  const double pairs = circle * cell * (2.0 * solid - 1.0) + shared_hole_area(layout, radius);
  // Around a disc of a jammed packing about 0.6 discs are missing within a few diameters (its own place, less the
  // crowding of neighbours).
  constexpr double missing = 0.6;
  const double share = pairs / (circle * cell * solid);  // of a full circle that lies in the solid, seen from a disc
  return std::max(0.0, (density * circle - missing) * share);
}

DesignEstimate estimate_design(const DesignFile& file, int threads) {
  const Design& design = file.design();
  DesignEstimate estimate;
  const auto layout = geometry::make_layout(design.layout, design.seeds.effective(0).layout, &file.schema());
  const Discs discs = periodic_discs(design);
  const double cell = layout.width * layout.height;
  const double solid = layout.solid_area_fraction();
  estimate.perforations = static_cast<std::int64_t>(layout.perforations.size());
  estimate.thinnest_wall = geometry::thinnest_wall(layout);
  estimate.porosity = 1.0 - solid;
  estimate.horizon_radius = design.solver.material.horizon * discs.mean_diameter;
  estimate.discs = std::llround(static_cast<double>(discs.count) * solid);
  estimate.bonds_per_disc =
      expected_bonds_per_disc(layout, static_cast<double>(discs.count) / cell, estimate.horizon_radius);
  estimate.bonds = std::llround(0.5 * estimate.bonds_per_disc * static_cast<double>(estimate.discs));
  estimate_stepping(design, layout, discs, estimate);
  estimate_resources(design, threads, estimate);
  return estimate;
}

}  // namespace perfora::optimize
