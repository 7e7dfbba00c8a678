// What is here: `perfora correlate`: do cheap sweeps rank the same cases as an expensive one does? What is not: the
// comparison (optimize/campaign/sweep_comparison.h), drawing (report/).
#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "app/commands.h"
#include "app/common.h"
#include "io/error.h"
#include "io/lock.h"
#include "io/text.h"
#include "optimize/campaign/sweep.h"
#include "optimize/campaign/sweep_comparison.h"
#include "report/plot_correlation.h"

namespace perfora::app {

namespace {

using optimize::ComparedMeasure;
using optimize::SweepRecord;

struct CorrelateFlags {
  CommonFlags common;
  std::string reference, measures = "first_peak_stress, plateau_stress, undulation", output;
  std::vector<std::string> sweeps, only;
};

struct Comparison {
  SweepRecord sweep;
  std::vector<ComparedMeasure> measures;
};

std::string interval_text(const optimize::RankCorrelation& correlation) {
  if (!std::isfinite(correlation.coefficient)) return "not defined";
  if (!std::isfinite(correlation.low)) return fmt::format("{:.2f} (no interval)", correlation.coefficient);
  return fmt::format("{:.2f} ({:.2f} to {:.2f})", correlation.coefficient, correlation.low, correlation.high);
}

/// "fidelity-cell, 1 replicate a case"
std::string with_replicates(const SweepRecord& sweep) {
  int fewest = sweep.cases.front().completed, most = fewest;
  for (const results::SweepCase& one : sweep.cases) {
    fewest = std::min(fewest, one.completed);
    most = std::max(most, one.completed);
  }
  const std::string count = fewest == most ? fmt::format("{}", most) : fmt::format("{} to {}", fewest, most);
  return fmt::format("{}, {} replicate{} a case", sweep.name, count, most == 1 ? "" : "s");
}

/// What a run costs in either; empty where one has no journal.
std::string cost_text(const SweepRecord& sweep, const SweepRecord& reference) {
  const double cheap = optimize::seconds_of_a_run(sweep.folder);
  const double expensive = optimize::seconds_of_a_run(reference.folder);
  if (!(cheap > 0.0) || !(expensive > 0.0)) return {};
  return fmt::format("  a run took {} here and {} there: {} times as long\n", io::duration(cheap),
                     io::duration(expensive), io::number(expensive / cheap));
}

std::string table_text(const SweepRecord& reference, const std::vector<Comparison>& comparisons) {
  std::string text;
  bool enough = false;
  for (const Comparison& one : comparisons) {
    const std::string ratio = one.sweep.name + " / " + reference.name;
    text += fmt::format("{}, against\n{}\n  {:<28}{:<30}{:>6}   {}\n", with_replicates(one.sweep),
                        with_replicates(reference), "result", "rank correlation (95 %)", "cases", "median of " + ratio);
    for (const ComparedMeasure& measure : one.measures) {
      const optimize::Trust trust = optimize::trust_in(measure.correlation);
      const bool told = trust != optimize::Trust::too_few;
      enough = enough || told;
      text += fmt::format("  {:<28}{:<30}{:>6}   {}{}\n", measure.measure, interval_text(measure.correlation),
                          measure.correlation.count, io::number(measure.median_ratio),
                          told ? std::string(", ") + optimize::trust_name(trust) : std::string());
    }
    text += cost_text(one.sweep, reference);
  }
  text += "Rank correlation is Spearman's; its interval is that of drawing other cases.\n";
  if (enough)
    text += fmt::format("A result is trusted where it is {} or more on {} cases or more.\n", optimize::trusted_from,
                        optimize::fewest_cases);
  return text;
}

report::CorrelationPicture picture_of(const SweepRecord& reference, const std::vector<Comparison>& comparisons) {
  report::CorrelationPicture picture;
  picture.title = comparisons.size() == 1 ? comparisons.front().sweep.name + " against " + reference.name
                                          : "Sweeps against " + reference.name;
  picture.subtitle =
      "A point a case: mean over its replicates, 95 % interval where there are several; on the dashed line "
      "both agree in size, on any rising curve in rank";
  picture.reference = with_replicates(reference);
  for (const Comparison& one : comparisons) {
    auto& row = picture.rows.emplace_back();
    row.sweep = with_replicates(one.sweep);
    for (const ComparedMeasure& measure : one.measures) {
      auto& panel = row.panels.emplace_back();
      panel.measure = measure.measure;
      panel.caption =
          fmt::format("rank correlation {}, {} cases", interval_text(measure.correlation), measure.correlation.count);
      for (std::size_t k = 0; k < measure.labels.size(); ++k)
        panel.points.push_back({measure.labels[k], measure.other[k].mean, measure.other[k].half_interval,
                                measure.reference[k].mean, measure.reference[k].half_interval});
    }
  }
  return picture;
}

int correlate(const CorrelateFlags& flags) {
  const auto measures = optimize::measures_in(flags.measures, {"--measures", 0, ""});
  if (measures.empty())
    throw io::InputError({"--measures", 0, ""}, "no result is named", "names such as plateau_stress", "");
  io::OutputLock lock;
  if (!flags.output.empty()) lock = io::claim_new_output(flags.output, flags.common.force);
  const SweepRecord reference = optimize::read_completed_sweep(flags.reference);
  std::vector<Comparison> comparisons;
  nlohmann::json entries = nlohmann::json::array();
  for (const std::string& path : flags.sweeps) {
    Comparison one{optimize::read_completed_sweep(path), {}};
    log_warnings(optimize::differences(reference, one.sweep));
    one.measures = optimize::compare_sweeps(reference, one.sweep, measures, flags.only);
    entries.push_back(optimize::to_json(one.sweep, one.measures));
    comparisons.push_back(std::move(one));
  }
  if (!flags.output.empty()) report::plot_correlation(picture_of(reference, comparisons), flags.output);
  if (flags.common.json)
    print_json({{"schema", "perfora.correlate/1"},
                {"status", "completed"},
                {"reason", ""},
                {"reference", reference.name},
                {"only", flags.only},
                {"sweeps", entries}});
  else
    print_text(table_text(reference, comparisons));
  if (!flags.output.empty()) io::log_info("written: " + flags.output);
  return exit_ok;
}

}  // namespace

void add_correlate(CLI::App& program, int& exit_code) {
  auto flags = std::make_shared<CorrelateFlags>();
  CLI::App* command = program.add_subcommand(
      "correlate", "Say whether cheap sweeps rank the cases that they share with an expensive one as that one does");
  command->add_option("REFERENCE", flags->reference, "Folder of the sweep or map to trust (the expensive one)")
      ->required();
  command
      ->add_option("SWEEPS", flags->sweeps,
                   "Folders of the sweeps or maps compared with it; cases meet by their labels")
      ->required();
  command
      ->add_option("--measures", flags->measures,
                   "Results to compare, by their names in the head of cases.csv, with commas")
      ->type_name("NAMES")
      ->capture_default_str();
  add_only_flag(*command, flags->only);
  command->add_option("-o,--output", flags->output, "Picture: .png, .svg or .pdf (default: none)");
  add_common_flags(*command, flags->common, Uses::files_only);
  command->callback([flags, &exit_code] {
    flags->common.apply();
    exit_code = correlate(*flags);
  });
}

}  // namespace perfora::app
