// What is here: a design packed, bonded and solved for its linear response; the JSON and the file of what was found.
#include "optimize/evaluate/elastic_response.h"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <limits>

#include "geometry/plane.h"
#include "io/error.h"
#include "results/elastic_file.h"
#include "results/formats.h"
#include "solver/simulation.h"

namespace perfora::optimize {

using nlohmann::json;

namespace {

using Clock = std::chrono::steady_clock;

double seconds_since(Clock::time_point start) {
  return std::chrono::duration<double>(Clock::now() - start).count();
}

void solve(const DesignFile& file, ElasticResponse& answer) {
  const solver::SolverOptions& options = file.design().solver;
  const geometry::Packing& clipped = answer.packed.clipped;
  const double mean_diameter = mean_diameter_of(file, answer.packed.periodic);
  answer.network = solver::make_bond_network(clipped, answer.packed.layout, options.material, options.noise,
                                             answer.seeds.noise, mean_diameter);
  if (answer.network.size() == 0)
    throw io::InputError({"", 0, "material.horizon"}, "no two discs are near enough to be bonded", "",
                         "raise the horizon or the solid fraction");
  answer.response = solver::elastic_response(answer.network, static_cast<std::int32_t>(clipped.size()), clipped.width,
                                             clipped.height, options.material);
  if (answer.response.status != solver::ElasticStatus::converged) {
    answer.status = results::RunStatus::failed;
    answer.reason = "the equilibrium was not reached";
    return;
  }
  // A block in pieces, or one that is held by single bonds, moves without any force: what is left is rounding.
  constexpr double nothing = 1e-6;
  const auto& stiffness = answer.response.stiffness;
  const auto& affine = answer.response.affine_stiffness;
  if (stiffness[0][0] < nothing * affine[0][0] && stiffness[1][1] < nothing * affine[1][1]) {
    answer.status = results::RunStatus::failed;
    answer.reason = "the bonds do not connect the block: raise material.horizon or packing.solid_fraction";
    return;
  }
  answer.first_yield =
      solver::first_yield(answer.network, answer.response, solver::make_bond_law(options.material, mean_diameter));
  answer.reason = "elastic response found";
}

json rows(const solver::PlaneStiffness& stiffness, bool reached) {
  json result = json::array();
  for (const auto& row : stiffness) {
    json values = json::array();
    for (const double value : row) values.push_back(reached ? json(value) : json(nullptr));
    result.push_back(values);
  }
  return result;
}

struct Named {
  const char* name;
  double value;
};

std::vector<Named> numbers_of(const ElasticResponse& answer) {
  const solver::PlaneModuli& m = answer.response.moduli;
  const solver::FirstYield& y = answer.first_yield;
  return {{"young_x", m.young_x},
          {"young_y", m.young_y},
          {"poisson_xy", m.poisson_xy},
          {"poisson_yx", m.poisson_yx},
          {"shear_modulus", m.shear_modulus},
          {"oedometric_modulus", answer.response.stiffness[1][1]},
          {"anisotropy", m.anisotropy},
          {"isotropic_young", m.isotropic_young},
          {"isotropic_poisson", m.isotropic_poisson},
          {"plane_strain_young", m.plane_strain_young},
          {"plane_strain_poisson", m.plane_strain_poisson},
          {"affine_share", answer.response.stiffness[1][1] / answer.response.affine_stiffness[1][1]},
          {"first_yield_strain", y.strain},
          {"first_yield_stress", y.stress},
          {"first_yield_lateral_stress", y.lateral_stress}};
}

/// Middle of a bond in the undeformed cell, m.
std::pair<double, double> place_of(const ElasticResponse& answer, std::int32_t bond) {
  const auto id = static_cast<std::size_t>(bond);
  const geometry::Packing& clipped = answer.packed.clipped;
  const auto i = static_cast<std::size_t>(answer.network.i[id]);
  const double half = 0.5 * answer.network.reference_length[id];
  return {geometry::wrapped(clipped.x[i] + half * answer.network.direction_x[id], clipped.width),
          geometry::wrapped(clipped.y[i] + half * answer.network.direction_y[id], clipped.height)};
}

const char* mode_name(results::BreakMode mode) {
  return mode == results::BreakMode::tension ? "tension" : "shear";
}

results::FirstBonds first_bonds_of(const ElasticResponse& answer) {
  results::FirstBonds first;
  for (const solver::YieldingBond& bond : answer.first_yield.first_bonds) {
    const auto [x, y] = place_of(answer, bond.bond);
    first.x.push_back(x);
    first.y.push_back(y);
    first.strain.push_back(bond.strain);
    first.pairs.push_back(answer.network.i[static_cast<std::size_t>(bond.bond)]);
    first.pairs.push_back(answer.network.j[static_cast<std::size_t>(bond.bond)]);
    first.mode.push_back(static_cast<std::int32_t>(bond.mode));
  }
  return first;
}

std::vector<double> flat(const solver::PlaneStiffness& stiffness) {
  std::vector<double> values;
  for (const auto& row : stiffness) values.insert(values.end(), row.begin(), row.end());
  return values;
}

}  // namespace

ElasticResponse elastic_response(const DesignFile& design, const EvaluateOptions& options, int replicate) {
  const auto start = Clock::now();
  ElasticResponse answer;
  answer.replicate = replicate;
  answer.seeds = design.design().seeds.effective(replicate);
  answer.packed = pack_design(design, options, replicate);
  answer.packing_seconds = seconds_since(start);
  const geometry::PackingQuality& quality = answer.packed.periodic.quality;
  if (!quality.reached || answer.packed.clipped.size() == 0) {
    answer.status = results::RunStatus::failed;
    answer.reason = quality.reached ? "no disc is left between the holes" : "packing not reached: " + quality.reason;
  } else {
    const auto packed = Clock::now();
    solve(design, answer);
    answer.solution_seconds = seconds_since(packed);
  }
  answer.performance.seconds = seconds_since(start);
  answer.performance.threads = options.threads;
  return answer;
}

json to_json(const ElasticResponse& answer) {
  const bool reached = answer.status == results::RunStatus::completed;
  json record = {{"schema", results::elastic_format},
                 {"status", results::status_name(answer.status)},
                 {"reason", answer.reason},
                 {"seeds", to_json(answer.seeds)},
                 {"results_version", results_version},
                 {"replicate", answer.replicate},
                 {"bonds", answer.response.bonds},
                 {"stiffness", rows(answer.response.stiffness, reached)},
                 {"affine_stiffness", rows(answer.response.affine_stiffness, reached)},
                 {"first_yield_bonds", static_cast<std::int64_t>(answer.first_yield.first_bonds.size())},
                 {"first_yield_place", nullptr},
                 {"first_yield_mode", nullptr},
                 {"iterations", answer.response.iterations},
                 {"residual", number(answer.response.residual)}};
  record.update(to_json(answer.packed.summary));
  for (const Named& entry : numbers_of(answer)) record[entry.name] = reached ? number(entry.value) : json(nullptr);
  if (!answer.first_yield.first_bonds.empty()) {
    const solver::YieldingBond& first = answer.first_yield.first_bonds.front();
    const auto [x, y] = place_of(answer, first.bond);
    record["first_yield_place"] = {x, y};
    record["first_yield_mode"] = mode_name(first.mode);
  }
  record["performance"] = to_json(answer.performance);
  record["performance"]["packing_seconds"] = answer.packing_seconds;
  record["performance"]["solution_seconds"] = answer.solution_seconds;
  return record;
}

void write_elastic_file(const std::filesystem::path& path, const DesignFile& design, const ElasticResponse& answer,
                        const json& summary, const std::string& command_line) {
  results::ElasticResult elastic;
  elastic.provenance = provenance_of(design, answer.seeds, command_line);
  elastic.clipped = answer.packed.clipped;
  elastic.layout = answer.packed.layout;
  elastic.stiffness = flat(answer.response.stiffness);
  elastic.affine_stiffness = flat(answer.response.affine_stiffness);
  std::copy(answer.response.displacement.begin(), answer.response.displacement.end(), elastic.displacement.begin());
  elastic.disc_strain = answer.first_yield.disc_strain;
  elastic.first_bonds = first_bonds_of(answer);
  elastic.summary = summary;
  results::write_elastic(path, elastic);
}

}  // namespace perfora::optimize
