// What is here: the loop of a material test and what is read from it. What is not: crack lengths (crack_length.cpp).
#include "solver/material_test.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "io/error.h"
#include "results/grade.h"
#include "solver/crack_length.h"
#include "solver/grade.h"

namespace perfora::solver {
namespace {

constexpr double nan = std::numeric_limits<double>::quiet_NaN();
constexpr int rows_to_yield = 100;      // history rows up to the estimated yield strain
constexpr double longest_test = 40.0;   // times the estimated yield strain: no peak until then is a result, too
constexpr double largest_strain = 0.3;  // of a test: beyond it nothing is a solid any more
constexpr double least_peak = 0.5;      // of the estimated yield strain: a maximum before it is a wave of the start
constexpr double undamaged = 1e-3;      // fraction of the work that damage has taken: up to there moduli are elastic
constexpr double slope_from = 0.05, slope_to = 0.4;  // of the strength: above the first waves, below the first damage
constexpr double separated = 0.05;                   // of the strength: a crack has crossed the sample
constexpr double longest_separation =
    4.0;                                // times the strain of the peak: a crack that has not crossed by then is bridged
constexpr double crack_link = 1.0;      // times <d>: broken bonds of one crack lie closer than discs do
constexpr double shortest_crack = 3.0;  // times r_H: shorter ones are single flaws, not cracks
/// The servo takes the lateral stress back this many times faster than a wave crosses the sample, so that it lags by
/// nu/(transits x this) of the strength (0.04 % at 25 transits).
constexpr double servo_speed = 20.0;

double poisson_of_voigt(const MaterialOptions& material) {
  return (material.normal_stiffness - material.tangential_stiffness) /
         (3.0 * material.normal_stiffness + material.tangential_stiffness);
}

bool axial(MaterialTestKind kind) {
  return kind == MaterialTestKind::tension || kind == MaterialTestKind::compression;
}

/// Tests whose stress falls to nothing once a crack has crossed the sample.
bool separates(MaterialTestKind kind) {
  return kind == MaterialTestKind::tension || kind == MaterialTestKind::shear;
}

/// Sign of the vertical strain that a test loads with, compression positive.
double direction_of(MaterialTestKind kind) {
  return kind == MaterialTestKind::tension ? -1.0 : 1.0;
}

Cell cell_of(MaterialTestKind kind, const geometry::Packing& sample, double rate, double servo_mobility) {
  Cell cell;
  cell.start = {sample.width, 0.0, sample.height};
  cell.servo_mobility = servo_mobility;
  if (kind == MaterialTestKind::shear) {
    cell.control = {CellControl::stress, CellControl::rate, CellControl::stress};
    cell.velocity.xy = rate * sample.height;
    return cell;
  }
  cell.control[2] = CellControl::rate;
  cell.velocity.yy = -direction_of(kind) * rate * sample.height;
  if (axial(kind)) cell.control[0] = CellControl::stress;
  return cell;
}

double strain_of(MaterialTestKind kind, const Simulation& s) {
  return kind == MaterialTestKind::shear ? s.cell().xy / s.cell().yy : direction_of(kind) * s.strain();
}

/// Stress along the test, positive as it loads. The shear stress of h_xy > 0 is negative in the compression-positive
/// convention.
double stress_of(MaterialTestKind kind, const Virial& stress) {
  return kind == MaterialTestKind::shear ? -0.5 * (stress.xy + stress.yx) : direction_of(kind) * stress.yy;
}

/// Least-squares slope of y over x for the rows first to last.
double slope(const std::vector<double>& x, const std::vector<double>& y, std::size_t first, std::size_t last) {
  const double n = static_cast<double>(last - first + 1);
  double mean_x = 0.0, mean_y = 0.0, xx = 0.0, xy = 0.0;
  for (std::size_t k = first; k <= last; ++k) {
    mean_x += x[k] / n;
    mean_y += y[k] / n;
  }
  for (std::size_t k = first; k <= last; ++k) {
    xx += (x[k] - mean_x) * (x[k] - mean_x);
    xy += (x[k] - mean_x) * (y[k] - mean_y);
  }
  return xx > 0.0 ? xy / xx : nan;
}

/// modulus and lateral_ratio from the rows between 5 % and 40 % of the largest stress, as far as damage has taken no
/// fraction of the work.
void read_moduli(MaterialTestResult& result, double largest_stress) {
  const results::MaterialCurve& curve = result.curve;
  std::size_t first = 0;
  while (first < curve.stress.size() && curve.stress[first] < slope_from * largest_stress) ++first;
  std::size_t last = first;
  while (last + 1 < curve.stress.size() && curve.stress[last + 1] < slope_to * largest_stress &&
         curve.damage[last + 1] <= undamaged * curve.work[last + 1])
    ++last;
  result.modulus = result.lateral_ratio = nan;
  constexpr std::size_t fewest_rows = 4;
  if (last < first + fewest_rows || last >= curve.stress.size()) return;
  result.modulus = slope(curve.strain, curve.stress, first, last);
  if (axial(result.kind))
    result.lateral_ratio = direction_of(result.kind) * slope(curve.strain, curve.lateral_strain, first, last);
  else if (result.kind == MaterialTestKind::oedometric)
    result.lateral_ratio = slope(curve.stress, curve.lateral_stress, first, last);
}

/// Everything a curve holds, for work that all columns share.
constexpr std::vector<double> results::MaterialCurve::*curve_columns[] = {
    &results::MaterialCurve::strain,         &results::MaterialCurve::stress,
    &results::MaterialCurve::lateral_strain, &results::MaterialCurve::lateral_stress,
    &results::MaterialCurve::damage,         &results::MaterialCurve::work,
    &results::MaterialCurve::cundall,        &results::MaterialCurve::broken_bonds};

/// Adds a row and returns what the ledger leaves over, J/m.
double add_row(MaterialTestKind kind, Simulation& s, double width, results::MaterialCurve& curve) {
  const Virial stress = s.row_stress();
  const Ledger energy = s.ledger();
  curve.strain.push_back(strain_of(kind, s));
  curve.stress.push_back(stress_of(kind, stress));
  curve.lateral_strain.push_back(s.cell().xx / width - 1.0);
  curve.lateral_stress.push_back(stress.xx);
  curve.damage.push_back(energy.damage);
  curve.work.push_back(energy.external_work);
  curve.cundall.push_back(energy.cundall);
  curve.broken_bonds.push_back(static_cast<double>(s.events().size()));
  s.reset_row();
  return std::fabs(energy.external_work - energy.sum());
}

struct Ready {
  SimulationInput input;
  std::vector<std::int32_t> original_bonds;
  double yield_strain = 0.0;
  std::int64_t steps_per_row = 0;
};

Ready make_ready(const MaterialTestRequest& request, MaterialTestResult& result) {
  const geometry::Packing& sample = *request.sample;
  const SolverOptions& options = request.options;
  const geometry::PerforationLayout solid{sample.width, sample.height, {}};
  Ready ready;
  SimulationInput& input = ready.input;
  input.clipped = &sample;
  input.options = options;
  input.network =
      make_bond_network(sample, solid, options.material, options.noise, request.noise_seed, request.mean_diameter);
  if (input.network.size() == 0)
    throw io::InputError({"", 0, "material.horizon"}, "no two discs are near enough to be bonded", "",
                         "raise the horizon or the solid fraction");
  ready.original_bonds = count_bonds_per_disc(input.network, sample.x.size());
  input.masses = make_masses(sample, input.network, options.material, options.dynamics);
  double lengths = 0.0, squares = 0.0;
  for (const double l : input.network.reference_length) {
    lengths += l;
    squares += l * l;
  }
  const double area = sample.width * sample.height;
  const double modulus = network_ratio * voigt_modulus(options.material, squares / area);
  const double transit = sample.height / std::sqrt(modulus * area / input.masses.total);
  ready.yield_strain = estimated_yield_strain(request.kind, options, request.mean_diameter,
                                              lengths / static_cast<double>(input.network.size()));
  result.rate = ready.yield_strain / (options.loading.transits * transit);
  const double critical = std::max(input.masses.critical_step,
                                   critical_step_by_power_iteration(input.network, input.masses, options.material,
                                                                    options.dynamics.cundall_damping));
  const double longest =
      std::min(options.dynamics.step_factor * critical,
               contact_critical_step(input.masses, sample.radius, options.material, options.dynamics.cundall_damping));
  const double row_time = ready.yield_strain / rows_to_yield / result.rate;
  ready.steps_per_row = std::max<std::int64_t>(1, static_cast<std::int64_t>(std::ceil(row_time / longest)));
  input.time_step = result.time_step = row_time / static_cast<double>(ready.steps_per_row);
  input.mean_diameter = request.mean_diameter;
  input.cell = cell_of(request.kind, sample, result.rate, servo_speed / (transit * modulus));
  return ready;
}

void read_results(const MaterialTestRequest& request, const Simulation& s, double residual, bool peaked,
                  MaterialTestResult& result) {
  const results::MaterialCurve& curve = result.curve;
  const auto peak = std::max_element(curve.stress.begin(), curve.stress.end());
  result.strength = peaked ? *peak : nan;
  result.peak_strain = peaked ? curve.strain[static_cast<std::size_t>(peak - curve.stress.begin())] : nan;
  read_moduli(result, *peak);
  result.steps = s.steps();
  result.events = s.events();
  result.broken_bonds = static_cast<std::int64_t>(result.events.size());
  result.broken_in_tension =
      std::count_if(result.events.begin(), result.events.end(),
                    [](const results::BreakEvent& e) { return e.mode == results::BreakMode::tension; });
  result.energy_residual = residual / *std::max_element(curve.work.begin(), curve.work.end());
  result.crack_length = result.fracture_energy = nan;
  if (request.kind != MaterialTestKind::tension || !peaked) return;
  result.crack_length = projected_crack_length(
      result.events, request.sample->width, request.sample->height, 0, crack_link * request.mean_diameter,
      shortest_crack * request.options.material.horizon * request.mean_diameter);
  if (result.crack_length > 0.0) result.fracture_energy = curve.damage.back() / result.crack_length;
}

}  // namespace

const char* material_test_name(MaterialTestKind kind) {
  switch (kind) {
    case MaterialTestKind::tension:
      return "tension";
    case MaterialTestKind::compression:
      return "compression";
    case MaterialTestKind::shear:
      return "shear";
    case MaterialTestKind::oedometric:
      return "oedometric";
  }
  return "";
}

double estimated_yield_strain(MaterialTestKind kind, const SolverOptions& options, double mean_diameter,
                              double mean_bond_length) {
  const BondLaw law = make_bond_law(options.material, mean_diameter);
  const double nu = poisson_of_voigt(options.material);
  // Strain tensor of a unit loading, extension positive.
  double xx = 0.0, yy = 0.0, xy = 0.0;
  if (kind == MaterialTestKind::shear) {
    xy = 0.5;
  } else {
    yy = -direction_of(kind);
    if (axial(kind)) xx = -nu * yy;
  }
  constexpr int directions = 180;
  double least = std::numeric_limits<double>::infinity();
  for (int k = 0; k < directions; ++k) {
    const double angle = std::numbers::pi * k / directions, c = std::cos(angle), s = std::sin(angle);
    const double normal = xx * c * c + 2.0 * xy * c * s + yy * s * s;
    const double shear = (yy - xx) * c * s + xy * (c * c - s * s);
    least = std::min(least, yield_load_factor(law, mean_bond_length * normal, mean_bond_length * shear, 1.0));
  }
  return least;
}

namespace {

/// A test at grade 1.
MaterialTestResult run_at_grade_one(const MaterialTestRequest& request) {
  MaterialTestResult result;
  result.kind = request.kind;
  Ready ready = make_ready(request, result);
  Simulation simulation(std::move(ready.input));
  const double past_peak = request.options.test.past_peak;
  const double longest = std::min(largest_strain, longest_test * ready.yield_strain);
  double strength = 0.0, peak_strain = 0.0, residual = 0.0;
  // Confined compression need not have a peak; the other tests without one have failed.
  bool peaked = false;
  result.reason = fmt::format("no peak up to strain {:.3g}", longest);
  result.status =
      request.kind == MaterialTestKind::oedometric ? results::RunStatus::completed : results::RunStatus::failed;
  const double width = request.sample->width;
  add_row(request.kind, simulation, width, result.curve);
  for (double strain = 0.0; strain < longest;) {
    for (std::int64_t k = 0; k < ready.steps_per_row; ++k) simulation.step();
    residual = std::max(residual, add_row(request.kind, simulation, width, result.curve));
    strain = result.curve.strain.back();
    const double stress = result.curve.stress.back();
    if (!std::isfinite(stress)) {
      for (const auto column : curve_columns) (result.curve.*column).pop_back();
      result.status = results::RunStatus::failed;
      result.reason = fmt::format("unstable step: stress is not a number at strain {:.3g}", strain);
      break;
    }
    if (stress > strength) {
      strength = stress;
      peak_strain = strain;
    }
    const double enough = separates(request.kind) ? longest_separation : past_peak;
    const bool in_two = separates(request.kind) && stress < separated * strength;
    if (strain > least_peak * ready.yield_strain && (in_two || strain >= enough * peak_strain)) {
      peaked = true;
      result.status = results::RunStatus::completed;
      result.reason = in_two ? "the sample is in two" : fmt::format("{:.3g} times the strain of the peak", enough);
      break;
    }
    if (request.cancellation.requested()) {
      result.status = results::RunStatus::stopped;
      result.reason = "signal";
      break;
    }
    if (request.progress) request.progress(strain / longest);
  }
  read_results(request, simulation, residual, peaked, result);
  result.frame = take_frame(simulation, ready.original_bonds);
  return result;
}

}  // namespace

MaterialTestResult run_material_test(const MaterialTestRequest& request) {
  MaterialTestRequest similar = request;
  similar.options = at_grade_one(request.options);
  MaterialTestResult result = run_at_grade_one(similar);
  const results::GradeChange change(request.options.material.grade);
  for (double* value : {&result.strength, &result.modulus, &result.fracture_energy}) *value *= change.stress;
  result.rate *= change.rate;
  result.time_step *= change.time;
  change.apply(result.curve);
  change.apply(result.frame);
  for (results::BreakEvent& event : result.events) change.apply(event);
  return result;
}

}  // namespace perfora::solver
