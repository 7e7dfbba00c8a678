// What is here: the search of a calibration around its journal. What is not: keys and record (calibration.cpp).
#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <limits>
#include <map>
#include <optional>

#include "io/journal.h"
#include "io/progress.h"
#include "io/text.h"
#include "optimize/campaign/work_folder.h"
#include "optimize/evaluate/elastic_fit.h"
#include "optimize/evaluate/material_tests_file.h"
#include "optimize/search/calibration.h"
#include "optimize/search/study.h"
#include "solver/elastic/elastic.h"
#include "solver/mass.h"

namespace perfora::optimize {
namespace {

using nlohmann::json;
using solver::MaterialTestKind;

constexpr const char* own_files[] = {"journal.jsonl", "material.toml",   "result.json",     "reachable.csv",
                                     "reachable.png", "confirmation.h5", "confirmation.png"};
/// delta_t0/delta_n0 searched (docs/user/theory.md, "Calibration"); the ratio of strengths still grows at the upper
/// end.
constexpr double least_shear_ratio = 1.0, largest_shear_ratio = 32.0;
/// Other zeta_max to try, nearest to the design's first.
constexpr double rupture_delays[] = {1.0, 1.05, 1.1, 1.2, 1.35, 1.5, 2.0, 3.0};
/// The chart.
constexpr double chart_delays[] = {1.0, 1.1, 1.5, 2.0};
constexpr double chart_shear_ratios[] = {1.0, 2.0, 3.5, 6.0, 12.0, 32.0};
constexpr int chart_points = static_cast<int>(std::size(chart_delays) * std::size(chart_shear_ratios));

/// A number of a CSV, empty where it was not reached.
std::string or_empty(double value) {
  return std::isfinite(value) ? fmt::format("{:.8g}", value) : std::string();
}

class Search {
 public:
  Search(const Calibration& calibration, const CalibrationOptions& options)
      : calibration_(calibration),
        options_(options),
        keys_(calibration.keys),
        started_(std::chrono::steady_clock::now()) {
    prepare_work_folder(options.folder, own_files, "calibration", options.force, options.resume);
    journal_ = std::make_unique<io::Journal>(options.folder / "journal.jsonl");
    read_journal();
  }

  CalibrationResult run() {
    pack_samples();
    fit_elasticity();
    if (!std::isfinite(young_)) return failed("the elastic answer of a sample did not converge");
    bool whole = scale_thresholds() && fit_strengths();
    if (whole && keys_.chart) whole = make_chart();
    write_design();
    if (whole) whole = confirm();
    if (!whole) {
      result_.status = results::RunStatus::stopped;
      result_.reason = "signal";
    } else if (result_.status == results::RunStatus::completed) {
      result_.reason = result_.not_met.empty() ? "all wanted numbers were met" : result_.not_met.front();
    }
    result_.seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - started_).count();
    return std::move(result_);
  }

 private:
  void read_journal() {
    const json head = {{"event", "calibration"},
                       {"results_version", results_version},
                       {"design", calibration_.start->schema().to_toml()},
                       {"replicates", keys_.replicates}};
    if (journal_->events().empty()) {
      journal_->append(head.dump());
      return;
    }
    const json first = json::parse(journal_->events().front());
    for (const char* key : {"event", "results_version", "design", "replicates"})
      if (first.value(key, json()) != head.at(key))
        throw io::InputError({(options_.folder / "journal.jsonl").string(), 0, key},
                             "the calibration of this folder began with another design or other samples", "",
                             "resume with the files it was started with, or name another folder with -o");
    for (const std::string& text : journal_->events()) {
      const json event = json::parse(text);
      if (event.value("event", "") == "point") known_[event.at("key").get<std::string>()] = event;
    }
  }

  void pack_samples() {
    EvaluateOptions packing;
    packing.threads = options_.threads;
    packing.progress = options_.progress;
    samples_.emplace(material_sample(*calibration_.start), keys_.replicates, packing);
  }

  void fit_elasticity() {
    const solver::MaterialOptions& material = calibration_.start->design().solver.material;
    double ratio = material.tangential_stiffness / material.normal_stiffness;
    double poisson = keys_.poisson_ratio, young = keys_.young_modulus;
    const bool plane_strain = keys_.reading == ElasticReading::plane_strain;
    if (plane_strain) poisson /= 1.0 - keys_.poisson_ratio;
    if (keys_.poisson_ratio > 0.0) {
      ratio = samples_->stiffness_ratio_for(poisson);
      const auto as_meant = [&](double nu) { return plane_strain ? solver::plane_strain_poisson_ratio(nu) : nu; };
      if (ratio == ElasticFit::least_ratio || ratio == ElasticFit::largest_ratio)
        result_.not_met.push_back(fmt::format(
            "poisson_ratio: {:.4g} is out of reach of these bonds, which give {:.4f} to {:.4f} for k_t/k_n from {:.3g} "
            "to {:.3g}; the nearest end was taken, which changes the strengths, too",
            keys_.poisson_ratio, as_meant(samples_->at(ElasticFit::largest_ratio).poisson),
            as_meant(samples_->at(ElasticFit::least_ratio).poisson), ElasticFit::largest_ratio,
            ElasticFit::least_ratio));
    }
    const UnitElasticity unit = samples_->at(ratio);
    const double in_space = solver::plane_strain_poisson_ratio(unit.poisson);
    if (plane_strain) young /= 1.0 - in_space * in_space;
    result_.found.normal_stiffness = keys_.young_modulus > 0.0 ? young / unit.young : material.normal_stiffness;
    result_.found.tangential_stiffness = ratio * result_.found.normal_stiffness;
    young_ = unit.young * result_.found.normal_stiffness;
    io::log_info(
        fmt::format("elastic: k_t/k_n = {:.5g}, k_n = {:.5g} N/m give E = {:.5g} Pa, nu = {:.4f} (two-dimensional)",
                    ratio, result_.found.normal_stiffness, young_, unit.poisson));
  }

  /// delta_n0 that all points are tested with: E delta_n0/<l> = wanted tensile strength (an aligned bond of mean
  /// length), as stated for the reference diameter.
  double reference_stretch() const {
    const double factor =
        solver::threshold_factor(calibration_.start->design().solver.material, samples_->mean_diameter());
    return io::rounded(keys_.tensile_strength / young_ * samples_->mean_bond_length() / factor);
  }

  /// One point at reference_stretch(); its tensile strength says how far off that was. The ratio of strengths hangs a
  /// little on the strains reached, so the search is done at the right ones. False: stopped.
  bool scale_thresholds() {
    const solver::MaterialOptions& material = calibration_.start->design().solver.material;
    critical_normal_ = reference_stretch();
    const double ratio = material.critical_shear_displacement / material.critical_normal_stretch;
    const StrengthPoint* point =
        test(std::clamp(ratio, least_shear_ratio, largest_shear_ratio), material.rupture_delay, false);
    if (point == nullptr) return false;
    if (point->tensile.mean > 0.0)
      critical_normal_ = io::rounded(critical_normal_ * keys_.tensile_strength / point->tensile.mean);
    result_.points.clear();  // of other thresholds
    return true;
  }

  CalibrationResult failed(const std::string& reason) {
    result_.status = results::RunStatus::failed;
    result_.reason = reason;
    return std::move(result_);
  }

  DesignFile design_with(const BondParameters& p) const {
    DesignFile design = calibration_.start->clone();
    solver::MaterialOptions& material = design.design().solver.material;
    material.normal_stiffness = p.normal_stiffness;
    material.tangential_stiffness = p.tangential_stiffness;
    material.critical_normal_stretch = p.critical_normal_stretch;
    material.critical_shear_displacement = p.critical_shear_displacement;
    material.rupture_delay = p.rupture_delay;
    return design;
  }

  /// Tests a point, or takes it from the journal. Empty when the work was stopped.
  const StrengthPoint* test(double shear_ratio, double rupture_delay, bool of_chart) {
    shear_ratio = io::rounded(shear_ratio);
    for (StrengthPoint& known : result_.points)
      if (known.shear_ratio == shear_ratio && known.rupture_delay == rupture_delay) return &known;
    BondParameters p = result_.found;
    p.critical_normal_stretch = critical_normal_;
    p.critical_shear_displacement = shear_ratio * critical_normal_;
    p.rupture_delay = rupture_delay;
    const DesignFile design = design_with(p);
    const std::string key = fmt::format("{:08x}", io::crc32(design.schema().to_toml()));
    auto found = known_.find(key);
    if (found == known_.end()) {
      const MaterialTests tests = run_tests(design, {MaterialTestKind::tension, MaterialTestKind::compression});
      if (tests.status == results::RunStatus::stopped || options_.cancellation.requested()) return nullptr;
      json event = {{"event", "point"}, {"key", key}, {"shear_ratio", shear_ratio}, {"rupture_delay", rupture_delay}};
      for (const MaterialTestRun& run : tests.runs)
        event[solver::material_test_name(run.result.kind)].push_back(number(run.result.strength));
      journal_->append(event.dump());
      found = known_.emplace(key, event).first;
    }
    const auto strengths = [&](const char* name) {
      std::vector<double> values;
      for (const json& value : found->second.at(name))
        if (value.is_number()) values.push_back(value.get<double>());
      return results::statistic_of(name, values);
    };
    StrengthPoint point{shear_ratio, rupture_delay, strengths("tension"), strengths("compression"), of_chart};
    io::log_info(fmt::format("zeta_max {}, delta_t0/delta_n0 {}: tension {}, compression {}, ratio {}",
                             io::number(rupture_delay), io::number(shear_ratio),
                             io::quantity(point.tensile.mean, io::Dimension::stress),
                             io::quantity(point.compressive.mean, io::Dimension::stress), io::number(point.ratio())));
    result_.points.push_back(std::move(point));
    return &result_.points.back();
  }

  MaterialTests run_tests(const DesignFile& design, const std::vector<MaterialTestKind>& kinds) const {
    MaterialTestsOptions tests;
    tests.threads = options_.threads;
    tests.replicates = keys_.replicates;
    tests.cancellation = options_.cancellation;
    tests.progress = options_.progress;
    return test_material(design, kinds, tests);
  }

  /// The point whose ratio of strengths is the wanted one; the nearest where there is none. False: stopped.
  bool fit_strengths() {
    const solver::MaterialOptions& material = calibration_.start->design().solver.material;
    std::vector<double> delays = {material.rupture_delay};
    if (keys_.vary_rupture_delay && keys_.compressive_strength > 0.0) {
      for (const double delay : rupture_delays)
        if (delay != material.rupture_delay) delays.push_back(delay);
      std::stable_sort(delays.begin() + 1, delays.end(), [&](double a, double b) {
        return std::fabs(a - material.rupture_delay) < std::fabs(b - material.rupture_delay);
      });
    }
    if (!(keys_.compressive_strength > 0.0)) {
      const StrengthPoint* only =
          test(material.critical_shear_displacement / material.critical_normal_stretch, material.rupture_delay, false);
      if (only == nullptr) return false;
      if (only->tensile.count > 0) return take(*only);
      result_.status = results::RunStatus::failed;
      result_.reason = "no test gave a tensile strength";
      return true;
    }
    const double wanted = keys_.compressive_strength / keys_.tensile_strength;
    StrengthPoint nearest;
    double smallest = std::numeric_limits<double>::infinity(), least = smallest, largest = 0.0;
    for (const double delay : delays) {
      if (!search_ratio(wanted, delay)) return false;
      for (const StrengthPoint& point : result_.points) {
        if (point.of_chart || !std::isfinite(point.ratio())) continue;
        least = std::min(least, point.ratio());
        largest = std::max(largest, point.ratio());
        const double miss = std::fabs(std::log(point.ratio() / wanted));
        if (miss < smallest) {
          smallest = miss;
          nearest = point;
        }
      }
      if (smallest < keys_.tolerance) break;
    }
    if (smallest == std::numeric_limits<double>::infinity()) {
      result_.status = results::RunStatus::failed;
      result_.reason = "no test gave both strengths";
      return true;
    }
    if (wanted < least || wanted > largest)
      result_.not_met.push_back(fmt::format(
          "compressive_strength: a ratio of strengths of {:.3g} is out of reach; {:.3g} to {:.3g} were found for "
          "delta_t0/delta_n0 from {:.3g} to {:.3g} at zeta_max {}{}; another horizon, yield_exponent or noise shifts "
          "this range",
          wanted, least, largest, least_shear_ratio, largest_shear_ratio,
          delays.size() > 1 ? "1 to 3" : fmt::format("{:.3g}", delays.front()),
          keys_.vary_rupture_delay ? "" : " (vary_rupture_delay = true tries others)"));
    return take(nearest);
  }

  /// Secant with a bracket (Illinois) on log ratio over log delta_t0/delta_n0. Leaves its points in result_. False:
  /// stopped.
  bool search_ratio(double wanted, double delay) {
    double x[2] = {std::log(least_shear_ratio), std::log(largest_shear_ratio)}, f[2];
    for (int k = 0; k < 2; ++k) {
      // An end where a test has no peak is moved inwards.
      constexpr int most_moves = 3;
      for (int move = 0; move <= most_moves; ++move) {
        const StrengthPoint* point = test(std::exp(x[k]), delay, false);
        if (point == nullptr) return false;
        f[k] = std::log(point->ratio() / wanted);
        if (std::isfinite(f[k])) break;
        x[k] = 0.5 * (x[0] + x[1]);
      }
    }
    if (!(f[0] < 0.0 && f[1] > 0.0)) return true;  // no bracket: out of reach at this zeta_max
    int same_side = 0;
    for (int k = 2; k < keys_.maxeval; ++k) {
      double next = (x[0] * f[1] - x[1] * f[0]) / (f[1] - f[0]);
      constexpr double margin = 0.05;  // of the bracket: keeps a noisy secant away from its ends
      next = std::clamp(next, x[0] + margin * (x[1] - x[0]), x[1] - margin * (x[1] - x[0]));
      const StrengthPoint* point = test(std::exp(next), delay, false);
      if (point == nullptr) return false;
      const double miss = std::log(point->ratio() / wanted);
      if (!std::isfinite(miss) || std::fabs(miss) < 0.5 * keys_.tolerance) return true;
      const int side = miss < 0.0 ? 0 : 1;
      x[side] = next;
      f[side] = miss;
      same_side = side == 0 ? std::max(1, same_side + 1) : std::min(-1, same_side - 1);
      if (std::abs(same_side) >= 2) f[1 - side] *= 0.5;
    }
    return true;
  }

  /// delta_n0 by proportion: strengths grow with the thresholds as long as strains are small.
  bool take(const StrengthPoint& point) {
    result_.found.rupture_delay = point.rupture_delay;
    result_.found.critical_normal_stretch = io::rounded(critical_normal_ * keys_.tensile_strength / point.tensile.mean);
    result_.found.critical_shear_displacement = io::rounded(point.shear_ratio * result_.found.critical_normal_stretch);
    return true;
  }

  bool make_chart() {
    for (const double delay : chart_delays)
      for (const double ratio : chart_shear_ratios)
        if (test(ratio, delay, true) == nullptr) return false;
    return true;
  }

  void write_design() const {
    if (!(result_.found.critical_normal_stretch > 0.0)) return;
    io::write_file(options_.folder / "material.toml", design_with(result_.found).schema().to_toml());
    std::string csv = "zeta_max,shear_ratio,tensile_strength,compressive_strength,strength_ratio\n";
    for (const StrengthPoint& p : result_.points)
      csv += fmt::format("{:.6g},{:.6g},{},{},{}\n", p.rupture_delay, p.shear_ratio, or_empty(p.tensile.mean),
                         or_empty(p.compressive.mean), or_empty(p.ratio()));
    io::write_file(options_.folder / "reachable.csv", csv);
  }

  /// All tests with the parameters found, held against what was wanted. False: stopped.
  bool confirm() {
    if (result_.status == results::RunStatus::failed) return true;
    const DesignFile design = design_with(result_.found);
    result_.confirmation = run_tests(design, {MaterialTestKind::tension, MaterialTestKind::compression,
                                              MaterialTestKind::shear, MaterialTestKind::oedometric});
    if (result_.confirmation.status == results::RunStatus::stopped || options_.cancellation.requested()) return false;
    write_material_tests(options_.folder / "confirmation.h5", design, result_.confirmation, options_.command_line);
    const std::string suffix = keys_.reading == ElasticReading::plane_strain ? "_plane_strain" : "";
    compare("young_modulus", "young_modulus" + suffix, keys_.young_modulus);
    compare("poisson_ratio", "poisson_ratio" + suffix, keys_.poisson_ratio);
    compare("tensile_strength", "tensile_strength", keys_.tensile_strength);
    compare("compressive_strength", "compressive_strength", keys_.compressive_strength);
    if (result_.confirmation.status == results::RunStatus::failed) {
      result_.status = results::RunStatus::failed;
      result_.reason = "a test of the material found gave no strength: " + result_.confirmation.reason;
    }
    return true;
  }

  void compare(const std::string& name, const std::string& statistic, double wanted) {
    if (!(wanted > 0.0)) return;
    CalibrationTarget target{name, wanted, std::numeric_limits<double>::quiet_NaN(), false};
    for (const results::Statistic& s : result_.confirmation.statistics)
      if (s.name == statistic) target.reached = s.mean;
    target.met = std::fabs(target.reached / wanted - 1.0) <= keys_.tolerance;
    const bool told = std::any_of(result_.not_met.begin(), result_.not_met.end(),
                                  [&](const std::string& one) { return one.starts_with(name); });
    const auto text = [&](double value) {
      return io::quantity(value, name == "poisson_ratio" ? io::Dimension::none : io::Dimension::stress);
    };
    if (!target.met && !told)
      result_.not_met.push_back(
          fmt::format("{}: {} was reached where {} was wanted ({:+.1f} %); "
                      "more calibrate.replicates, a larger test.size or a wider tolerance may help",
                      name, text(target.reached), text(wanted), 100.0 * (target.reached / wanted - 1.0)));
    result_.targets.push_back(std::move(target));
  }

  const Calibration& calibration_;
  const CalibrationOptions& options_;
  const CalibrationKeys& keys_;
  std::chrono::steady_clock::time_point started_;
  std::unique_ptr<io::Journal> journal_;
  std::map<std::string, json> known_;
  std::optional<ElasticFit> samples_;
  double young_ = 0.0, critical_normal_ = 0.0;
  CalibrationResult result_;
};

}  // namespace

int most_points(const Calibration& calibration) {
  const CalibrationKeys& keys = calibration.keys;
  if (!(keys.compressive_strength > 0.0)) return keys.chart ? 1 + chart_points : 1;
  const int delays = keys.vary_rupture_delay ? 1 + static_cast<int>(std::size(rupture_delays)) : 1;
  return keys.maxeval * delays + (keys.chart ? chart_points : 0);
}

CalibrationResult calibrate(const Calibration& calibration, const CalibrationOptions& options) {
  CalibrationResult result = Search(calibration, options).run();
  io::write_file(options.folder / "result.json", to_json(result).dump(2) + "\n");
  return result;
}

}  // namespace perfora::optimize
