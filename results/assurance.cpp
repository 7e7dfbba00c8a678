// What is here: probabilities and predictions for single blocks. What is not: verdicts.
#include "results/assurance.h"

#include <fmt/format.h>

#include <algorithm>
#include <boost/math/distributions/beta.hpp>
#include <boost/math/distributions/students_t.hpp>
#include <cmath>

#include "io/text.h"
#include "results/json.h"
#include "results/statistic.h"

namespace perfora::results {

using nlohmann::json;

double wished_value(const Measure& measure, const Evaluation& evaluation) {
  const double value = value_of(measure, evaluation);
  const Summary& summary = evaluation.summary;
  const bool end_of_plateau = std::string_view(measure.key) == "densification_strain";
  return std::isnan(value) && end_of_plateau && std::isfinite(summary.plateau_stress) ? summary.final_strain : value;
}

Interval binomial_interval(int count, int trials) {
  constexpr double tail = 0.5 * (1.0 - confidence);
  const double k = count, n = trials;
  Interval interval{0.0, 1.0};
  if (trials < 1) return interval;
  if (count > 0) interval.low = boost::math::quantile(boost::math::beta_distribution<>(k, n - k + 1.0), tail);
  if (count < trials)
    interval.high = boost::math::quantile(boost::math::beta_distribution<>(k + 1.0, n - k), 1.0 - tail);
  return interval;
}

Interval prediction_interval(const std::vector<double>& values) {
  const bool positive = std::all_of(values.begin(), values.end(), [](double value) { return value > 0.0; });
  std::vector<double> on = values;
  if (positive)
    for (double& value : on) value = std::log(value);
  const Statistic of = statistic_of({}, on);
  const double n = of.count;
  const double t = boost::math::quantile(boost::math::students_t(n - 1.0), 0.5 * (1.0 + confidence));
  const double half = t * of.standard_deviation * std::sqrt(1.0 + 1.0 / n);
  Interval interval{of.mean - half, of.mean + half};
  if (positive) interval = {std::exp(interval.low), std::exp(interval.high)};
  return interval;
}

Assurance assurance_of(const Target& target, std::span<const Evaluation* const> blocks) {
  Assurance found;
  const std::vector<Wish> all = wishes(target);
  for (const Evaluation* block : blocks) {
    ++found.blocks;
    const bool keeps =
        block->status == RunStatus::completed && std::all_of(all.begin(), all.end(), [&](const Wish& wish) {
          const double value = wished_value(*wish.measure, *block);
          return wish.low <= value && value <= wish.high;
        });
    found.keeping += keeps;
  }
  found.probability = binomial_interval(found.keeping, found.blocks);
  for (const Wish& wish : all) {
    std::vector<double> values;
    for (const Evaluation* block : blocks)
      if (const double value = wished_value(*wish.measure, *block);
          block->status == RunStatus::completed && std::isfinite(value))
        values.push_back(value);
    if (values.size() >= 2 && !wish.measure->of_packing())
      found.next.push_back({wish.measure, static_cast<int>(values.size()), prediction_interval(values)});
  }
  return found;
}

std::string in_words(const Assurance& assurance) {
  std::string text = fmt::format(
      "{} of {} single blocks keep every wish (95 %: {} of all blocks)", assurance.keeping, assurance.blocks,
      io::quantities({assurance.probability.low, assurance.probability.high}, io::Dimension::ratio, " to "));
  for (std::size_t k = 0; k < assurance.next.size(); ++k) {
    const Assurance::Next& one = assurance.next[k];
    text += fmt::format("{}{} {}", k == 0 ? "; the next block, 95 %: " : ", ", name_of(*one.measure),
                        io::quantities({one.interval.low, one.interval.high}, one.measure->dimension, " to "));
    if (one.count < assurance.blocks) text += fmt::format(" (where it has one, as {} of these)", one.count);
  }
  return text;
}

json to_json(const Assurance& assurance) {
  json next = json::array();
  for (const Assurance::Next& one : assurance.next)
    next.push_back({{"measure", one.measure->key},
                    {"blocks", one.count},
                    {"low", number(one.interval.low)},
                    {"high", number(one.interval.high)}});
  return {{"blocks", assurance.blocks},
          {"keeping", assurance.keeping},
          {"probability", {assurance.probability.low, assurance.probability.high}},
          {"confidence", confidence},
          {"next_block", next},
          {"text", in_words(assurance)}};
}

}  // namespace perfora::results
