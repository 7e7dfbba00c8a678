// What is here: samples, replicates side by side, statistics. What is not: record and file (material_tests_file.cpp).
#include "optimize/evaluate/material_tests.h"

#include <fmt/format.h>

#include <algorithm>
#include <atomic>
#include <chrono>
#include <cmath>
#include <exception>
#include <limits>
#include <mutex>
#include <thread>

#include "io/memory.h"
#include "io/text.h"
#include "optimize/evaluate/evaluation.h"
#include "solver/elastic/elastic.h"

namespace perfora::optimize {
namespace {

using solver::MaterialTestKind;
using solver::MaterialTestResult;

constexpr double nan = std::numeric_limits<double>::quiet_NaN();
/// A sample narrower than this many discs, or than this many horizons, has no bulk to speak of.
constexpr double fewest_across_a_sample = 10.0, fewest_horizons_across = 4.0;

/// Calls work(k) for k < count on up to `threads` threads; the first exception is thrown again here.
void side_by_side(std::size_t count, int threads, const std::function<void(std::size_t)>& work) {
  std::atomic<std::size_t> next{0};
  std::exception_ptr failure;
  std::mutex mutex;
  const auto run = [&] {
    for (std::size_t k = next++; k < count; k = next++) {
      try {
        work(k);
      } catch (...) {
        const std::lock_guard lock(mutex);
        if (!failure) failure = std::current_exception();
        next = count;
      }
    }
  };
  std::vector<std::jthread> others;
  for (int t = 1; t < std::min<int>(threads, static_cast<int>(count)); ++t) others.emplace_back(run);
  run();
  for (std::jthread& thread : others) thread.join();
  if (failure) std::rethrow_exception(failure);
}

/// The results of one replicate by kind.
struct ByKind {
  const MaterialTestResult* of[4] = {};
  double value(MaterialTestKind kind, double MaterialTestResult::*field) const {
    const MaterialTestResult* result = of[static_cast<std::size_t>(kind)];
    return result == nullptr ? nan : result->*field;
  }
};

/// The tension test's value; the compression test's where there was none.
double first_of(double tension, double compression) {
  return std::isfinite(tension) ? tension : compression;
}

std::vector<results::Statistic> statistics_of(const std::vector<MaterialTestRun>& runs, int replicates) {
  std::vector<ByKind> samples(static_cast<std::size_t>(replicates));
  for (const MaterialTestRun& run : runs)
    samples[static_cast<std::size_t>(run.replicate)].of[static_cast<std::size_t>(run.result.kind)] = &run.result;
  using Kind = MaterialTestKind;
  using Result = MaterialTestResult;
  const auto young = [](const ByKind& s) {
    return first_of(s.value(Kind::tension, &Result::modulus), s.value(Kind::compression, &Result::modulus));
  };
  const auto poisson = [](const ByKind& s) {
    return first_of(s.value(Kind::tension, &Result::lateral_ratio), s.value(Kind::compression, &Result::lateral_ratio));
  };
  const std::vector<std::pair<const char*, std::function<double(const ByKind&)>>> list = {
      {"young_modulus", young},
      {"poisson_ratio", poisson},
      {"young_modulus_plane_strain",
       [&](const ByKind& s) { return solver::plane_strain_young_modulus(young(s), poisson(s)); }},
      {"poisson_ratio_plane_strain", [&](const ByKind& s) { return solver::plane_strain_poisson_ratio(poisson(s)); }},
      {"shear_modulus", [](const ByKind& s) { return s.value(Kind::shear, &Result::modulus); }},
      {"oedometric_modulus", [](const ByKind& s) { return s.value(Kind::oedometric, &Result::modulus); }},
      {"tensile_strength", [](const ByKind& s) { return s.value(Kind::tension, &Result::strength); }},
      {"compressive_strength", [](const ByKind& s) { return s.value(Kind::compression, &Result::strength); }},
      {"shear_strength", [](const ByKind& s) { return s.value(Kind::shear, &Result::strength); }},
      {"oedometric_strength", [](const ByKind& s) { return s.value(Kind::oedometric, &Result::strength); }},
      {"strength_ratio",
       [](const ByKind& s) {
         return s.value(Kind::compression, &Result::strength) / s.value(Kind::tension, &Result::strength);
       }},
      {"fracture_energy", [](const ByKind& s) { return s.value(Kind::tension, &Result::fracture_energy); }},
      {"characteristic_length",
       [&](const ByKind& s) {
         const double strength = s.value(Kind::tension, &Result::strength);
         return young(s) * s.value(Kind::tension, &Result::fracture_energy) / (strength * strength);
       }},
  };
  std::vector<results::Statistic> statistics;
  for (const auto& [name, value] : list) {
    std::vector<double> values;
    for (const ByKind& sample : samples) values.push_back(value(sample));
    results::Statistic statistic = results::statistic_of(name, values);
    if (statistic.count > 0) statistics.push_back(std::move(statistic));
  }
  return statistics;
}

/// One test of a packed sample.
MaterialTestResult run_one(const DesignFile& sample, const PackedDesign& packed, MaterialTestKind kind, int replicate,
                           const io::Cancellation& cancellation, std::function<void(double)> progress) {
  solver::MaterialTestRequest request;
  request.sample = &packed.clipped;
  request.options = sample.design().solver;
  request.kind = kind;
  request.noise_seed = sample.design().seeds.effective(replicate).noise;
  request.mean_diameter = mean_diameter_of(sample, packed.periodic);
  request.cancellation = cancellation;
  request.progress = std::move(progress);
  return solver::run_material_test(request);
}

/// stopped before failed before completed, with the first reason.
void sum_up(MaterialTests& tests) {
  for (const results::RunStatus status : {results::RunStatus::stopped, results::RunStatus::failed})
    for (const MaterialTestRun& run : tests.runs)
      if (run.result.status == status) {
        tests.status = status;
        tests.reason = fmt::format("{}: {}", solver::material_test_name(run.result.kind), run.result.reason);
        return;
      }
  tests.reason = fmt::format("{} {} run", tests.runs.size(), tests.runs.size() == 1 ? "test" : "tests");
}

}  // namespace

DesignFile material_sample(const DesignFile& design) {
  DesignFile sample = design.clone();
  Design& options = sample.design();
  options.layout.family = geometry::LayoutFamily::none;
  // Keys of a compression that a test does not look at must not get in its way.
  options.solver.boundary = {};
  options.measures = {};
  options.target = {};
  options.solver.output = {};
  options.solver.loading.until = options.measures.plateau_end;
  if (!options.packing.file.empty()) return sample;
  const double size = options.solver.test.size;
  const double least = std::max(fewest_across_a_sample, fewest_horizons_across * options.solver.material.horizon) *
                       options.packing.mean_diameter;
  const auto length = [](double metres) { return io::quantity(metres, io::Dimension::length); };
  if (size < least)
    throw io::InputError(design.schema().origin("material_test.size"),
                         fmt::format("a sample of {} is too small for discs of {} and their horizon", length(size),
                                     length(options.packing.mean_diameter)),
                         "at least " + length(least), "raise material_test.size or take smaller discs");
  options.layout.width = options.layout.height = size;
  options.layout.scale = 1.0;
  return sample;
}

std::vector<MaterialTestKind> wanted_tests(const DesignFile& design) {
  const solver::TestOptions& test = design.design().solver.test;
  std::vector<MaterialTestKind> kinds;
  if (test.tension) kinds.push_back(MaterialTestKind::tension);
  if (test.compression) kinds.push_back(MaterialTestKind::compression);
  if (test.shear) kinds.push_back(MaterialTestKind::shear);
  if (test.oedometric) kinds.push_back(MaterialTestKind::oedometric);
  if (kinds.empty())
    throw io::InputError(design.schema().origin("material_test.tension"), "no test is requested",
                         "tension, compression, shear and oedometric of [material_test] are true or false",
                         "set at least one of them to true");
  return kinds;
}

MaterialTests test_material(const DesignFile& design, const std::vector<MaterialTestKind>& kinds,
                            const MaterialTestsOptions& options) {
  const auto start = std::chrono::steady_clock::now();
  const DesignFile sample = material_sample(design);
  MaterialTests tests;
  tests.seeds = sample.design().seeds.effective(0);
  std::vector<PackedDesign> packed(static_cast<std::size_t>(options.replicates));
  EvaluateOptions packing;
  packing.threads = options.threads;
  packing.cancellation = options.cancellation;
  for (int r = 0; r < options.replicates; ++r) {
    if (options.progress) options.progress({0.0, fmt::format("packing sample {} of {}", r + 1, options.replicates)});
    try {
      packed[static_cast<std::size_t>(r)] = pack_design(sample, packing, r);
    } catch (const io::Cancelled&) {
      tests.status = results::RunStatus::stopped;
      tests.reason = "signal";
      return tests;
    }
    const geometry::Packing& periodic = packed[static_cast<std::size_t>(r)].periodic;
    if (!periodic.quality.reached) {
      tests.status = results::RunStatus::failed;
      tests.reason = "packing not reached: " + periodic.quality.reason;
      return tests;
    }
  }
  tests.sample = packed.front().clipped;
  tests.discs = packed.front().summary.discs;
  tests.bonds = std::llround(0.5 * packed.front().summary.bonds_per_disc * static_cast<double>(tests.discs));
  tests.mean_diameter = mean_diameter_of(sample, packed.front().periodic);
  for (int r = 0; r < options.replicates; ++r)
    for (const MaterialTestKind kind : kinds) tests.runs.push_back({r, {}}), tests.runs.back().result.kind = kind;

  std::mutex mutex;
  std::vector<double> done(tests.runs.size(), 0.0);
  const auto say = [&](std::size_t k, double fraction) {
    const std::lock_guard lock(mutex);
    done[k] = fraction;
    double sum = 0.0;
    for (const double part : done) sum += part;
    if (options.progress)
      options.progress({sum / static_cast<double>(done.size()),
                        fmt::format("{}", solver::material_test_name(tests.runs[k].result.kind))});
  };
  side_by_side(tests.runs.size(), options.threads, [&](std::size_t k) {
    MaterialTestRun& run = tests.runs[k];
    run.result = run_one(sample, packed[static_cast<std::size_t>(run.replicate)], run.result.kind, run.replicate,
                         options.cancellation, [&, k](double fraction) { say(k, fraction); });
    say(k, 1.0);
    const std::lock_guard lock(mutex);
    if (options.finished) options.finished(run.result, run.replicate);
  });
  tests.statistics = statistics_of(tests.runs, options.replicates);
  sum_up(tests);
  tests.performance.seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  tests.performance.threads = options.threads;
  tests.performance.peak_memory = io::peak_memory_bytes();
  return tests;
}

Evaluation evaluate_material_test(const DesignFile& design, MaterialTestKind kind, int replicate, int threads,
                                  const io::Cancellation& cancellation) {
  const auto start = std::chrono::steady_clock::now();
  const DesignFile sample = material_sample(design);
  const Seeds::Effective seeds = sample.design().seeds.effective(replicate);
  EvaluateOptions packing;
  packing.threads = threads;
  packing.cancellation = cancellation;
  PackedDesign packed;
  try {
    packed = pack_design(sample, packing, replicate);
  } catch (const io::Cancelled&) {
    Evaluation stopped = failed_evaluation("signal", replicate, seeds);
    stopped.status = stopped.summary.status = results::RunStatus::stopped;
    return stopped;
  }
  if (!packed.periodic.quality.reached)
    return failed_evaluation("packing not reached: " + packed.periodic.quality.reason, replicate, seeds);
  const MaterialTestResult result = run_one(sample, packed, kind, replicate, cancellation, {});
  Evaluation evaluation = failed_evaluation(result.reason, replicate, seeds);  // nothing else is reached
  evaluation.status = evaluation.summary.status = result.status;
  evaluation.grade = design.design().solver.material.grade;
  evaluation.pack = packed.summary;
  evaluation.summary.first_peak_stress = result.strength;
  evaluation.summary.first_peak_strain = result.peak_strain;
  evaluation.summary.steps = result.steps;
  evaluation.summary.broken_bonds = result.broken_bonds;
  evaluation.summary.broken_in_tension = result.broken_in_tension;
  evaluation.performance.seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  evaluation.performance.threads = 1;
  evaluation.performance.peak_memory = io::peak_memory_bytes();
  return evaluation;
}

MaterialTestKind material_test_called(const std::string& name) {
  for (const auto kind : {MaterialTestKind::tension, MaterialTestKind::compression, MaterialTestKind::shear,
                          MaterialTestKind::oedometric})
    if (name == solver::material_test_name(kind)) return kind;
  throw io::InputError({"material_test", 0, ""}, "there is no test \"" + name + "\"",
                       "tension, compression, shear, oedometric");
}

}  // namespace perfora::optimize
