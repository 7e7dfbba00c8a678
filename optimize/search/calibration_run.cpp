// What is here: a calibration as a campaign. What is not: the search itself (calibration_search.cpp).
#include "optimize/search/calibration_run.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>

#include "io/files.h"
#include "io/progress.h"
#include "io/text.h"
#include "optimize/campaign/campaign.h"
#include "optimize/evaluate/calibrated_material.h"
#include "optimize/evaluate/elastic_fit.h"
#include "optimize/evaluate/material_tests_file.h"
#include "optimize/search/calibration_search.h"
#include "solver/elastic/elastic.h"

namespace perfora::optimize {
namespace {

using nlohmann::json;
using solver::MaterialTestKind;

/// What a point is tested for.
constexpr const char* tests_of_a_point[] = {"tension", "compression"};

/// The material found, for other designs.
constexpr const char* material_name = "calibrated.toml";

/// Names one test of one sample of a point.
std::string test_key(const std::string& point, const std::string& test, int replicate) {
  return fmt::format("{}/{}/{}", point, test, replicate);
}

std::string point_of(const std::string& test_key) {
  return test_key.substr(0, test_key.find('/'));
}

/// A number of a CSV, empty where it was not reached.
std::string or_empty(double value) {
  return std::isfinite(value) ? fmt::format("{:.8g}", value) : std::string();
}

class CalibrationRun final : public Campaign {
 public:
  CalibrationRun(const Calibration& calibration, const CalibrationOptions& options)
      : calibration_(calibration), options_(options), keys_(calibration.keys) {
    WorkOptions work;
    work.folder = options.folder;
    work.resume = options.resume;
    work.force = options.force;
    work.command_line = options.command_line;
    work.make_executor = options.make_executor;
    work.execution = keys_.execution;
    work.cancellation = options.cancellation;
    work.results_written = options.results_written;
    work.progress = [this](const WorkProgress& so_far) {
      const int most = most_points(calibration_) * tests_a_point();
      if (options_.progress)
        options_.progress(
            {static_cast<double>(so_far.known) / most, fmt::format("{} of at most {} tests", so_far.known, most)});
    };
    open(std::move(work));
  }

  CalibrationResult result() const {
    CalibrationResult made;
    made.status = status();
    made.reason = reason();
    made.found = search_.found;
    made.targets = targets_;
    made.not_met = search_.not_met;
    made.points = search_.points;
    made.confirmation = confirmation_;
    made.seconds = seconds();
    made.troubles = troubles();
    if (!confirmation_.runs.empty()) made.material_file = options_.folder / material_name;
    return made;
  }

  std::string kind() const override { return "calibration"; }
  std::vector<std::string> own_files() const override {
    return {"material.toml", material_name,     "result.json",      "reachable.csv",
            "reachable.png", "confirmation.h5", "confirmation.png", "report.html"};
  }
  json identity() const override {
    return {{"design", calibration_.start->schema().to_toml()}, {"replicates", keys_.replicates}};
  }
  void check_same(const json& head, const std::filesystem::path& journal) const override {
    const std::pair<const char*, bool> same[] = {
        {"design", same_configuration(head.value("design", ""), *calibration_.start)},
        {"replicates", head.value("replicates", json()) == json(keys_.replicates)}};
    for (const auto& [key, agrees] : same)
      if (!agrees)
        throw io::InputError({journal.string(), 0, key},
                             "the calibration of this folder began with another design or other samples", "",
                             "resume with the files it was started with, or name another folder with -o");
  }

  /// A point that was tested: the strengths of its samples by test.
  void read_event(const json& event, Answers& answers) const override {
    if (event.value("event", "") != "point") return;
    // Without reasons it is of a program that took a worker's death for a test without a strength: tested again.
    const bool trusted = event.contains("reasons");
    for (const char* test : tests_of_a_point) {
      const json strengths = event.value(test, json::array());
      for (int replicate = 0; replicate < static_cast<int>(strengths.size()); ++replicate) {
        Evaluation evaluation = failed_evaluation("", replicate);
        const json& strength = strengths.at(static_cast<std::size_t>(replicate));
        if (!strength.is_number() && !trusted) continue;
        if (strength.is_number()) evaluation.summary.first_peak_stress = strength.get<double>();
        answers.add(test_key(event.at("key"), test, replicate), std::move(evaluation));
      }
    }
  }

  std::vector<Asked> pending(const Answers& answers) override {
    if (!fitted_) fit_elasticity();
    if (!std::isfinite(basis_.young_modulus)) return {};
    search_ =
        search_strengths(calibration_, basis_, [&](const std::string& key) { return strengths_of(key, answers); });
    search_.not_met.insert(search_.not_met.begin(), not_met_.begin(), not_met_.end());
    std::vector<Asked> asked;
    for (const StrengthQuestion& question : search_.wanted) {
      questions_[question.key] = question;
      for (int replicate = 0; replicate < keys_.replicates; ++replicate)
        for (const char* test : tests_of_a_point) {
          const std::string key = test_key(question.key, test, replicate);
          if (strength_in(key, answers)) continue;
          asked.push_back({key, Request{question.sample, replicate, 0.0, ""}, key, std::filesystem::path()});
          asked.back().request.material_test = test;
        }
    }
    return asked;
  }

  /// One line a point, when its last test is there.
  json event_of(const Asked& asked, const Answer& answer, const Answers& answers) const override {
    const auto strength = [&](const std::string& key) -> std::optional<double> {
      if (key == asked.key) return answer.evaluation.summary.first_peak_stress;
      return strength_in(key, answers);
    };
    const std::optional<SampleStrengths> strengths = strengths_of(point_of(asked.key), strength);
    if (!strengths) return nullptr;
    const StrengthQuestion& question = questions_.at(point_of(asked.key));
    json event = {{"event", "point"},
                  {"key", question.key},
                  {"shear_ratio", question.shear_ratio},
                  {"rupture_delay", question.rupture_delay},
                  {"tension", json::array()},
                  {"compression", json::array()}};
    json reasons = json::object();  // of tests that gave no strength
    for (int replicate = 0; replicate < keys_.replicates; ++replicate)
      for (const char* test : tests_of_a_point) {
        const std::string key = test_key(question.key, test, replicate);
        const auto known = answers.of(key);
        const Evaluation* one = key == asked.key              ? &answer.evaluation
                                : known.first != known.second ? &known.first->second
                                                              : nullptr;
        if (one && !std::isfinite(one->summary.first_peak_stress)) reasons[key] = one->reason;
      }
    event["reasons"] = reasons;
    for (const double value : strengths->tension) event["tension"].push_back(number(value));
    for (const double value : strengths->compression) event["compression"].push_back(number(value));
    return event;
  }

  std::string on_answer(const Asked& asked, const Evaluation&) override {
    const std::string point = point_of(asked.key);
    const std::optional<SampleStrengths> strengths = strengths_of(point, answers());
    if (!strengths) return {};
    const double tension = results::statistic_of("tension", strengths->tension).mean;
    const double compression = results::statistic_of("compression", strengths->compression).mean;
    const StrengthQuestion& question = questions_.at(point);
    return fmt::format("zeta_max {}, delta_t0/delta_n0 {}: tension {}, compression {}, ratio {}",
                       io::number(question.rupture_delay), io::number(question.shear_ratio),
                       io::quantity(tension, io::Dimension::stress), io::quantity(compression, io::Dimension::stress),
                       io::number(compression / tension));
  }

  std::int64_t remaining() const override {
    return std::int64_t{most_points(calibration_)} * tests_a_point() - static_cast<std::int64_t>(answers().size());
  }

  CampaignEnd finished() override {
    using results::RunStatus;
    if (!std::isfinite(basis_.young_modulus))
      return {RunStatus::failed, "the elastic response of a sample did not converge"};
    write_material();
    if (search_.status == RunStatus::failed) return {search_.status, search_.reason};
    if (!confirm()) return stopped(nullptr);
    if (confirmation_.status == RunStatus::failed)
      return {RunStatus::failed, "a test of the material found gave no strength: " + confirmation_.reason};
    return {RunStatus::completed, search_.not_met.empty() ? "all wanted numbers were met" : search_.not_met.front()};
  }
  CampaignEnd stopped(const Evaluation*) override { return {results::RunStatus::stopped, "signal"}; }

  void write_results() override {
    write_material();
    io::write_file(options_.folder / "result.json", to_json(result()).dump(2) + "\n");
  }

 private:
  int tests_a_point() const { return static_cast<int>(std::size(tests_of_a_point)) * keys_.replicates; }

  static std::optional<double> strength_in(const std::string& key, const Answers& answers) {
    const auto [first, last] = answers.of(key);
    if (first == last) return std::nullopt;
    return first->second.summary.first_peak_stress;
  }

  /// The strengths of a point, where every test of it is known.
  std::optional<SampleStrengths> strengths_of(
      const std::string& point, const std::function<std::optional<double>(const std::string&)>& strength) const {
    SampleStrengths strengths;
    for (int replicate = 0; replicate < keys_.replicates; ++replicate)
      for (const auto& [test, values] :
           {std::pair{tests_of_a_point[0], &strengths.tension}, {tests_of_a_point[1], &strengths.compression}}) {
        const std::optional<double> found = strength(test_key(point, test, replicate));
        if (!found) return std::nullopt;
        values->push_back(*found);
      }
    return strengths;
  }
  std::optional<SampleStrengths> strengths_of(const std::string& point, const Answers& answers) const {
    return strengths_of(point, [&](const std::string& key) { return strength_in(key, answers); });
  }

  void fit_elasticity() {
    EvaluateOptions packing;
    packing.threads = options_.threads;
    packing.progress = options_.progress;
    const ElasticFit samples(material_sample(*calibration_.start), keys_.replicates, packing);
    const solver::MaterialOptions& material = calibration_.start->design().solver.material;
    double ratio = material.tangential_stiffness / material.normal_stiffness;
    double poisson = keys_.poisson_ratio, young = keys_.young_modulus;
    const bool plane_strain = keys_.reading == ElasticReading::plane_strain;
    if (plane_strain) poisson /= 1.0 - keys_.poisson_ratio;
    if (keys_.poisson_ratio > 0.0) {
      ratio = samples.stiffness_ratio_for(poisson);
      const auto as_meant = [&](double nu) { return plane_strain ? solver::plane_strain_poisson_ratio(nu) : nu; };
      if (ratio == ElasticFit::least_ratio || ratio == ElasticFit::largest_ratio)
        not_met_.push_back(fmt::format(
            "poisson_ratio: {:.4g} is out of reach of these bonds, which give {:.4f} to {:.4f} for k_t/k_n from {:.3g} "
            "to {:.3g}; the nearest end was taken, which changes the strengths, too",
            keys_.poisson_ratio, as_meant(samples.at(ElasticFit::largest_ratio).poisson),
            as_meant(samples.at(ElasticFit::least_ratio).poisson), ElasticFit::largest_ratio, ElasticFit::least_ratio));
    }
    const UnitElasticity unit = samples.at(ratio);
    const double in_space = solver::plane_strain_poisson_ratio(unit.poisson);
    if (plane_strain) young /= 1.0 - in_space * in_space;
    basis_.normal_stiffness = keys_.young_modulus > 0.0 ? young / unit.young : material.normal_stiffness;
    basis_.tangential_stiffness = ratio * basis_.normal_stiffness;
    basis_.young_modulus = unit.young * basis_.normal_stiffness;
    io::log_info(
        fmt::format("elastic: k_t/k_n = {:.5g}, k_n = {:.5g} N/m give E = {:.5g} Pa, nu = {:.4f} (two-dimensional)",
                    ratio, basis_.normal_stiffness, basis_.young_modulus, unit.poisson));
    basis_.mean_diameter = samples.mean_diameter();
    basis_.mean_bond_length = samples.mean_bond_length();
    fitted_ = true;
  }

  /// material.toml and reachable.csv, once thresholds are found.
  void write_material() const {
    if (!(search_.found.critical_normal_displacement > 0.0)) return;
    io::write_file(options_.folder / "material.toml", design_with(calibration_, search_.found).schema().to_toml());
    std::string csv = "zeta_max,shear_ratio,tensile_strength,compressive_strength,strength_ratio\n";
    for (const StrengthPoint& p : search_.points)
      csv += fmt::format("{:.6g},{:.6g},{},{},{}\n", p.rupture_delay, p.shear_ratio, or_empty(p.tensile.mean),
                         or_empty(p.compressive.mean), or_empty(p.ratio()));
    io::write_file(options_.folder / "reachable.csv", csv);
  }

  /// All tests with the parameters found, held against what was wanted. False: stopped.
  bool confirm() {
    DesignFile design = design_with(calibration_, search_.found);
    MaterialTestsOptions tests;
    tests.threads = options_.threads;
    tests.replicates = keys_.replicates;
    tests.cancellation = options_.cancellation;
    tests.progress = options_.progress;
    confirmation_ = test_material(design,
                                  {MaterialTestKind::tension, MaterialTestKind::compression, MaterialTestKind::shear,
                                   MaterialTestKind::oedometric},
                                  tests);
    if (confirmation_.status == results::RunStatus::stopped || options_.cancellation.requested()) return false;
    write_material_tests(options_.folder / "confirmation.h5", design, confirmation_, options_.command_line);
    const std::string suffix = keys_.reading == ElasticReading::plane_strain ? "_plane_strain" : "";
    compare("young_modulus", "young_modulus" + suffix, keys_.young_modulus);
    compare("poisson_ratio", "poisson_ratio" + suffix, keys_.poisson_ratio);
    compare("tensile_strength", "tensile_strength", keys_.tensile_strength);
    compare("compressive_strength", "compressive_strength", keys_.compressive_strength);
    write_calibrated(design);
    return true;
  }

  /// calibrated.toml, with what was wanted and reached.
  void write_calibrated(DesignFile& design) const {
    std::string remarks = "Calibrated material (perfora calibrate): reached, wanted\n";
    for (const CalibrationTarget& t : targets_)
      remarks += fmt::format("  {}: {}, {}\n", t.name, target_text(t.name, t.reached), target_text(t.name, t.wanted));
    for (const results::Statistic& s : confirmation_.statistics) {
      if (s.name == "fracture_energy")
        remarks += "  fracture energy: " + io::quantity(s.mean, io::Dimension::surface_energy) + "\n";
      if (s.name == "characteristic_length") design.design().solver.material.characteristic_length = length_of(s.mean);
    }
    io::write_file(options_.folder / material_name, calibrated_material(design, remarks));
  }

  /// At the reference diameter: it grows with the discs.
  double length_of(double measured) const {
    return io::rounded(measured * calibration_.start->design().solver.material.reference_mean_diameter /
                       confirmation_.mean_diameter);
  }

  static std::string target_text(const std::string& name, double value) {
    return io::quantity(value, name == "poisson_ratio" ? io::Dimension::none : io::Dimension::stress);
  }

  void compare(const std::string& name, const std::string& statistic, double wanted) {
    if (!(wanted > 0.0)) return;
    CalibrationTarget target{name, wanted, std::numeric_limits<double>::quiet_NaN(), false};
    for (const results::Statistic& s : confirmation_.statistics)
      if (s.name == statistic) target.reached = s.mean;
    target.met = std::fabs(target.reached / wanted - 1.0) <= keys_.tolerance;
    const bool told = std::any_of(search_.not_met.begin(), search_.not_met.end(),
                                  [&](const std::string& one) { return one.starts_with(name); });
    const auto text = [&](double value) { return target_text(name, value); };
    if (!target.met && !told)
      search_.not_met.push_back(
          fmt::format("{}: {} was reached where {} was wanted ({:+.1f} %); "
                      "more calibrate.replicates, a larger material_test.size or a wider tolerance may help",
                      name, text(target.reached), text(wanted), 100.0 * (target.reached / wanted - 1.0)));
    targets_.push_back(std::move(target));
  }

  const Calibration& calibration_;
  const CalibrationOptions& options_;
  const CalibrationKeys& keys_;
  CalibrationBasis basis_;
  bool fitted_ = false;
  std::vector<std::string> not_met_;  ///< of the elastic constants
  std::map<std::string, StrengthQuestion> questions_;
  StrengthSearch search_;
  std::vector<CalibrationTarget> targets_;
  MaterialTests confirmation_;
};

}  // namespace

CalibrationResult calibrate(const Calibration& calibration, const CalibrationOptions& options) {
  CalibrationRun run(calibration, options);
  run.run();
  return run.result();
}

int calibration_workers(const Calibration& calibration, int asked) {
  const int tests = static_cast<int>(std::size(tests_of_a_point)) * calibration.keys.replicates;
  return workers_for(asked, calibration.keys.execution.workers,
                     std::int64_t{tests} * std::max(1, chart_points(calibration)));
}

}  // namespace perfora::optimize
