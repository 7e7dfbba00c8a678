// What is here: sweeps compared case by case. What is not: the coefficient (rank_correlation.h).
#include "optimize/campaign/sweep_comparison.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "io/error.h"
#include "io/text.h"
#include "optimize/campaign/case_choice.h"
#include "optimize/evaluate/evaluation.h"
#include "results/campaign_folder.h"
#include "results/map_record.h"

namespace perfora::optimize {
namespace {

using nlohmann::json;
namespace fs = std::filesystem;

constexpr double missing = std::numeric_limits<double>::quiet_NaN();

double median(std::vector<double> values) {
  if (values.empty()) return missing;
  std::sort(values.begin(), values.end());
  const std::size_t half = values.size() / 2;
  return values.size() % 2 ? values[half] : 0.5 * (values[half - 1] + values[half]);
}

const results::SweepCase* case_called(const SweepRecord& record, const std::string& label) {
  for (const results::SweepCase& one : record.cases)
    if (one.label == label) return &one;
  return nullptr;
}

CaseMean result_of(const results::SweepCase& one, const std::string& measure) {
  const auto found = one.results.find(measure);
  return found != one.results.end() ? found->second : CaseMean{missing, missing};
}

}  // namespace

SweepRecord read_completed_sweep(const fs::path& path) {
  const bool map = fs::is_directory(path) && fs::exists(path / "map.json");
  SweepRecord record = map ? results::as_sweep(results::read_map_record(path), path) : results::read_sweep_record(path);
  std::erase_if(record.cases, [](const results::SweepCase& one) { return one.completed < 1; });
  if (record.cases.empty())
    throw io::InputError({(record.folder / (map ? "map.json" : "result.json")).string(), 0, ""},
                         "no case of this sweep has completed yet", "",
                         "give the folder of a `perfora sweep` or a `perfora map`");
  return record;
}

Trust trust_in(const RankCorrelation& correlation) {
  if (correlation.count < fewest_cases) return Trust::too_few;
  return correlation.coefficient >= trusted_from ? Trust::trusted : Trust::not_trusted;
}

const char* trust_name(Trust trust) {
  switch (trust) {
    case Trust::trusted:
      return "trusted";
    case Trust::not_trusted:
      return "not trusted";
    case Trust::too_few:
      break;
  }
  return "too few cases";
}

double seconds_of_a_run(const fs::path& folder) {
  double sum = 0.0;
  int runs = 0;
  for (const json& event : results::journal_events(folder)) {
    if (event.at("event") != "evaluation" || event.value("taken_over", false)) continue;
    sum += event.value("seconds", 0.0);
    ++runs;
  }
  return runs > 0 ? sum / runs : 0.0;
}

std::vector<std::string> differences(const SweepRecord& reference, const SweepRecord& other) {
  std::vector<std::string> found;
  const auto window = [](const SweepRecord& record) {
    return io::quantities({record.plateau_window.front(), record.plateau_window.back()}, io::Dimension::ratio, " to ");
  };
  const bool known = reference.plateau_window.size() == 2 && other.plateau_window.size() == 2;
  if (known && reference.plateau_window != other.plateau_window)
    found.push_back(fmt::format("the plateau is taken from {} strain in {}, from {} in {}", window(reference),
                                reference.name, window(other), other.name));
  const auto reached = [](const SweepRecord& record) {
    std::vector<double> strains;
    for (const results::SweepCase& one : record.cases) strains.push_back(result_of(one, "final_strain").mean);
    return median(std::move(strains));
  };
  const auto percent = [](double strain) { return io::quantity(strain, io::Dimension::ratio); };
  constexpr double a_step = 1e-3;
  if (std::fabs(reached(reference) - reached(other)) > a_step)
    found.push_back(
        fmt::format("{} was compressed to {}, {} to {}: results that look at the whole curve are "
                    "not the same",
                    reference.name, percent(reached(reference)), other.name, percent(reached(other))));
  return found;
}

std::vector<ComparedMeasure> compare_sweeps(const SweepRecord& reference, const SweepRecord& other,
                                            const std::vector<std::string>& measures,
                                            const std::vector<std::string>& only) {
  std::vector<std::string> labels;
  for (const results::SweepCase& one : reference.cases)
    if (is_chosen(one.label, only) && case_called(other, one.label)) labels.push_back(one.label);
  if (labels.size() < 3)
    throw io::InputError(
        {other.name, 0, ""},
        fmt::format("only {} of its completed cases {} called like one of {}{}; a rank correlation needs three",
                    labels.size(), labels.size() == 1 ? "is" : "are", reference.name,
                    only.empty() ? "" : fmt::format(" with \"{}\" in the name", fmt::join(only, "\" or \""))),
        "",
        fmt::format("{} has {} cases, the first is \"{}\"; {} begins with \"{}\"", reference.name,
                    reference.cases.size(), reference.cases.front().label, other.name, other.cases.front().label));
  std::vector<ComparedMeasure> compared;
  for (const std::string& name : measures) {
    ComparedMeasure one{name, labels, {}, {}, {}, missing};
    std::vector<double> a, b, ratios;
    for (const std::string& label : labels) {
      one.reference.push_back(result_of(*case_called(reference, label), name));
      one.other.push_back(result_of(*case_called(other, label), name));
      a.push_back(one.reference.back().mean);
      b.push_back(one.other.back().mean);
      if (const double ratio = b.back() / a.back(); std::isfinite(ratio)) ratios.push_back(ratio);
    }
    one.correlation = rank_correlation(a, b);
    one.median_ratio = median(ratios);
    compared.push_back(std::move(one));
  }
  return compared;
}

json to_json(const SweepRecord& other, const std::vector<ComparedMeasure>& compared) {
  json measures = json::object();
  for (const ComparedMeasure& one : compared) {
    json cases = json::array();
    for (std::size_t k = 0; k < one.labels.size(); ++k)
      cases.push_back({{"label", one.labels[k]},
                       {"reference", number(one.reference[k].mean)},
                       {"sweep", number(one.other[k].mean)}});
    measures[one.measure] = {{"rank_correlation", number(one.correlation.coefficient)},
                             {"low_95", number(one.correlation.low)},
                             {"high_95", number(one.correlation.high)},
                             {"pairs", one.correlation.count},
                             {"median_ratio", number(one.median_ratio)},
                             {"cases", cases}};
    if (const Trust trust = trust_in(one.correlation); trust != Trust::too_few)
      measures[one.measure]["trust"] = trust_name(trust);
  }
  json record = {{"sweep", other.name}, {"measures", measures}};
  if (const double seconds = seconds_of_a_run(other.folder); seconds > 0.0) record["seconds_of_a_run"] = seconds;
  return record;
}

}  // namespace perfora::optimize
