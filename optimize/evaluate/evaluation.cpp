// What is here: the way of one design: layout, packing, clipping, compression. What is not: JSON (results/json.cpp),
// requests (request.cpp), P.h5 (pack_file.cpp).
#include "optimize/evaluate/evaluation.h"

#include <fmt/format.h>

#include <cmath>

#include "geometry/clip.h"
#include "geometry/packing_file.h"
#include "geometry/wall.h"
#include "io/hdf5.h"
#include "io/text.h"
#include "optimize/evaluate/estimate.h"
#include "optimize/evaluate/packing_cache.h"
#include "results/file_parts.h"
#include "results/formats.h"
#include "results/verdict.h"
#include "solver/bond_network.h"
#include "solver/run_folder.h"

namespace perfora::optimize {

namespace {

geometry::Packing packing_from_file(const std::filesystem::path& path, const geometry::PackingKey& wanted) {
  const io::Hdf5Reader file(path);
  geometry::Packing packing = geometry::read_packing(file, "/packing");
  geometry::require_same_key(wanted, packing.key, path);
  return packing;
}

/// The packing a design asks for: imported, from `packing_file`, from memory, or made now.
std::shared_ptr<const geometry::Packing> periodic_packing(const Design& design, const EvaluateOptions& options,
                                                          std::uint64_t seed) {
  const double width = design.layout.cell_width(), height = design.layout.cell_height();
  if (!design.packing.file.empty()) {
    auto imported = std::make_shared<const geometry::Packing>(geometry::import_packing(design.packing, width, height));
    if (options.packing_file.empty()) return imported;
    return std::make_shared<const geometry::Packing>(packing_from_file(options.packing_file, imported->key));
  }
  const geometry::PackingKey key = geometry::packing_key(design.packing, width, height, seed);
  if (!options.packing_file.empty())
    return std::make_shared<const geometry::Packing>(packing_from_file(options.packing_file, key));
  return cached_packing(key, [&] {
    return geometry::make_packing(
        design.packing, width, height, seed, options.threads,
        [&](double fraction, const std::string& text) {
          if (options.progress) options.progress({fraction, text});
        },
        options.cancellation);
  });
}

results::PackSummary summarise(const geometry::PerforationLayout& layout, const geometry::Packing& periodic,
                               const geometry::Packing& clipped) {
  results::PackSummary summary;
  summary.discs = clipped.size();
  summary.perforations = static_cast<std::int64_t>(layout.perforations.size());
  summary.mean_diameter = periodic.mean_diameter();
  summary.solid_fraction = periodic.quality.solid_fraction;
  summary.porosity = 1.0 - layout.solid_area_fraction();
  summary.thinnest_wall = geometry::thinnest_wall(layout);
  summary.thinnest_wall_discretised = geometry::thinnest_wall_discretised(clipped, layout);
  summary.max_overlap_ratio = periodic.quality.max_overlap_ratio;
  summary.coordination_number = periodic.quality.coordination_number;
  summary.rattler_fraction = periodic.quality.rattler_fraction;
  return summary;
}

/// Layout, packings, summary without bonds.
PackedDesign pack_without_bonds(const DesignFile& file, const EvaluateOptions& options, const Seeds::Effective& seeds) {
  const Design& design = file.design();
  PackedDesign packed;
  packed.layout = geometry::make_layout(design.layout, seeds.layout, &file.schema());
  packed.periodic = *periodic_packing(design, options, seeds.packing);
  packed.clipped = geometry::clip_packing(packed.periodic, packed.layout, design.packing.clip);
  packed.summary = summarise(packed.layout, packed.periodic, packed.clipped);
  if (!packed.layout.perforations.empty())
    packed.summary.wall_ratio = packed.summary.thinnest_wall.thickness /
                                characteristic_length(design.solver.material, mean_diameter_of(file, packed.periodic));
  return packed;
}

/// Nothing measured.
Evaluation unfinished_evaluation(results::RunStatus status, const std::string& reason, int replicate,
                                 const Seeds::Effective& seeds) {
  Evaluation evaluation;
  evaluation.status = evaluation.summary.status = status;
  evaluation.reason = evaluation.summary.reason = reason;
  evaluation.replicate = replicate;
  evaluation.seeds = seeds;
  return evaluation;
}

/// The results of a run as an evaluation; curve and all.
Evaluation evaluation_of(const solver::Response& response, const results::PackSummary& pack,
                         const Seeds::Effective& seeds, int replicate, double grade) {
  Evaluation evaluation;
  evaluation.grade = grade;
  evaluation.replicate = replicate;
  evaluation.seeds = seeds;
  evaluation.status = response.summary.status;
  evaluation.reason = response.summary.reason;
  evaluation.pack = pack;
  evaluation.pack.bonds_per_disc = response.bonds_per_disc;
  evaluation.summary = response.summary;
  evaluation.performance = response.performance;
  return evaluation;
}

solver::RunRequest run_request(const DesignFile& file, const PackedDesign& packed, const EvaluateOptions& options,
                               const Seeds::Effective& seeds) {
  solver::RunRequest request;
  request.clipped = &packed.clipped;
  request.layout = &packed.layout;
  request.periodic = &packed.periodic;
  request.options = file.design().solver;
  request.measuring = file.design().measuring_frame();
  request.noise_seed = seeds.noise;
  request.threads = options.threads;
  request.mean_diameter = mean_diameter_of(file, packed.periodic);
  request.run_file = options.run_file;
  request.resume = options.resume;
  request.wall_time_limit = options.wall_time_limit;
  request.cancellation = options.cancellation;
  request.progress = options.progress;
  request.provenance = provenance_of(file, seeds, options.command_line);
  request.comparable = comparable_configuration;
  return request;
}

}  // namespace

double mean_diameter_of(const DesignFile& design, const geometry::Packing& periodic) {
  return design.design().packing.file.empty() ? design.design().packing.mean_diameter : periodic.mean_diameter();
}

results::Provenance provenance_of(const DesignFile& design, const Seeds::Effective& seeds,
                                  const std::string& command_line) {
  results::Provenance made = results::provenance_of_this_program();
  made.title = design.title();
  made.command_line = command_line;
  made.seeds = to_json(seeds).dump();
  made.config = design.schema().to_toml();
  return made;
}

PackedDesign pack_design(const DesignFile& design, const EvaluateOptions& options, int replicate) {
  const Seeds::Effective seeds = design.design().seeds.effective(replicate);
  PackedDesign packed = pack_without_bonds(design, options, seeds);
  if (packed.periodic.quality.reached && packed.clipped.size() > 0) {
    const std::int64_t bonds =
        solver::count_bonds(packed.clipped, packed.layout, design.design().solver.material.horizon,
                            mean_diameter_of(design, packed.periodic));
    packed.summary.bonds_per_disc = 2.0 * static_cast<double>(bonds) / static_cast<double>(packed.clipped.size());
  }
  return packed;
}

Evaluation failed_evaluation(const std::string& reason, int replicate, const Seeds::Effective& seeds) {
  return unfinished_evaluation(results::RunStatus::failed, reason, replicate, seeds);
}

std::vector<std::string> validity_warnings(const Evaluation& evaluation, const solver::LoadingOptions& loading) {
  const results::Summary& s = evaluation.summary;
  std::vector<std::string> warnings;
  if (s.max_overlap_in_run > results::small_overlap)
    warnings.push_back(
        fmt::format("the largest overlap reached {} of <d>, beyond {}: the rubble is pressed together more than "
                    "discs can bear; take the stress of the last strains as a lower bound",
                    io::quantity(s.max_overlap_in_run, io::Dimension::ratio),
                    io::quantity(results::small_overlap, io::Dimension::ratio)));
  if (s.energy_residual > results::small_energy_residual)
    warnings.push_back(fmt::format(
        "the energies do not add up to the work by {} of it, beyond {}: the step is too long or the block is loaded "
        "too fast; lower dynamics.step_factor, or loading.rate where it is set",
        io::quantity(s.energy_residual, io::Dimension::ratio),
        io::quantity(results::small_energy_residual, io::Dimension::ratio)));
  if (s.kinetic_ratio_at_peak > results::small_kinetic_ratio)
    warnings.push_back(fmt::format(
        "kinetic energy was {} of the elastic one at the first peak: not quasi-static; raise loading.transits",
        io::quantity(s.kinetic_ratio_at_peak, io::Dimension::ratio)));
  if (s.transits_before_peak < loading.transits)
    warnings.push_back(
        loading.rate == 0.0
            ? fmt::format("{:.3g} wave transits before the first peak, fewer than the {:g} requested: the block is "
                          "stiffer or weaker than estimated; raise loading.transits",
                          s.transits_before_peak, loading.transits)
            : fmt::format("{:.3g} wave transits before the first peak, fewer than the {:g} of loading.transits: not "
                          "quasi-static; lower loading.rate",
                          s.transits_before_peak, loading.transits));
  // The rate follows the stress of the last 0.5 % of strain, not the mean of the window.
  constexpr double many_times = 2.0;
  if (s.impact_ratio > many_times * loading.impact_ratio)
    warnings.push_back(fmt::format(
        "the impact stress is {} of the plateau stress, more than the {} of loading.impact_ratio: the plateau is "
        "carried by the rate, not quasi-static; {}",
        io::quantity(s.impact_ratio, io::Dimension::ratio), io::quantity(loading.impact_ratio, io::Dimension::ratio),
        loading.rate > 0.0                                    ? "lower loading.rate"
        : loading.control == solver::LoadingControl::constant ? "raise loading.transits, or let the rate be adaptive"
                                                              : "the block carries too little to be followed"));
  constexpr double smoothing = 0.005;  // an onset at the end of the run is none
  if (std::isfinite(s.plateau_stress) && s.densification_onset < std::min(s.plateau_end, s.final_strain - smoothing))
    warnings.push_back(fmt::format(
        "the plateau is measured to {} of strain, behind the onset of densification at {}: its mean holds rubble that "
        "is pressed together; end the window (target.window, measures.plateau_end) there",
        io::quantity(s.plateau_end, io::Dimension::ratio), io::quantity(s.densification_onset, io::Dimension::ratio)));
  return warnings;
}

nlohmann::json evaluation_record(const DesignFile& design, const Evaluation& evaluation) {
  nlohmann::json record = to_json(evaluation, false);
  const results::Target& target = design.design().target;
  const Evaluation* const one = &evaluation;
  if (!results::wishes(target).empty()) record["verdict"] = results::to_json(results::verdict_on(target, {&one, 1}));
  std::vector<std::string> warnings;
  try {
    warnings = design.validate();
  } catch (const io::InputError&) {  // a file was changed while the run went on: the run is worth what it was
  }
  for (std::string& told : validity_warnings(evaluation, design.design().solver.loading))
    warnings.push_back(std::move(told));
  record["warnings"] = warnings;
  return record;
}

void require_packing_file(const DesignFile& design, const std::filesystem::path& packing_file, int replicate) {
  EvaluateOptions options;
  options.packing_file = packing_file;
  static_cast<void>(periodic_packing(design.design(), options, design.design().seeds.effective(replicate).packing));
}

std::optional<Evaluation> finished_evaluation(const DesignFile& design, const std::filesystem::path& run_file,
                                              int replicate) {
  if (!std::filesystem::exists(run_file)) return std::nullopt;
  const io::Hdf5Reader file(run_file);
  if (!file.has("/summary") || !file.has("/config")) return std::nullopt;
  const nlohmann::json record = nlohmann::json::parse(file.text("/summary"), nullptr, false);
  if (!record.is_object() || record.value("schema", std::string()) != results::evaluation_schema) return std::nullopt;
  Evaluation evaluation;
  try {
    evaluation = results::evaluation_from_json(record);
  } catch (const nlohmann::json::exception& error) {
    throw io::InputError({run_file.string(), 0, ""},
                         fmt::format("its /summary is not one that this program wrote: {}", error.what()), "",
                         "start anew with --force, or name another output");
  }
  if (evaluation.status == results::RunStatus::stopped) return std::nullopt;
  if (!same_configuration(file.text("/config"), design) || evaluation.replicate != replicate ||
      evaluation.seeds != design.design().seeds.effective(replicate) ||
      record.value("results_version", 0) != results_version)
    throw io::InputError(
        {run_file.string(), 0, ""}, "holds a finished run of another design, strain, seed or program version", "",
        "resume with the design and flags it was made with, start anew with --force, or name another output");
  evaluation.curve = results::read_history(file, "/history");
  return evaluation;
}

Evaluation evaluate_design(const DesignFile& design, const EvaluateOptions& options, int replicate) {
  const io::Cancellation::Attention attention = options.cancellation.attend();
  if (options.resume && !options.run_file.empty())
    if (auto finished = finished_evaluation(design, options.run_file, replicate)) {
      solver::RunFolder(options.run_file).remove();  // left by a kill after the run file was written
      return std::move(*finished);
    }
  const Seeds::Effective seeds = design.design().seeds.effective(replicate);
  PackedDesign packed;
  try {
    packed = pack_without_bonds(design, options, seeds);
  } catch (const io::Cancelled&) {
    return unfinished_evaluation(results::RunStatus::stopped, "signal", replicate, seeds);
  }
  if (!packed.periodic.quality.reached || packed.clipped.size() == 0) {
    Evaluation failed =
        failed_evaluation(packed.periodic.quality.reached ? "no disc is left between the holes"
                                                          : "packing not reached: " + packed.periodic.quality.reason,
                          replicate, seeds);
    failed.pack = packed.summary;
    failed.performance.threads = options.threads;
    return failed;
  }
  const double grade = design.design().solver.material.grade;
  solver::RunRequest request = run_request(design, packed, options, seeds);
  request.summary = [&](const solver::Response& response) {
    return evaluation_record(design, evaluation_of(response, packed.summary, seeds, replicate, grade));
  };
  solver::Response response = solver::run_compression(request);
  Evaluation evaluation = evaluation_of(response, packed.summary, seeds, replicate, grade);
  evaluation.curve = std::move(response.history);
  return evaluation;
}

}  // namespace perfora::optimize
