// What is here: the score. What is not: who asks for it.
#include "optimize/search/objective.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "results/assurance.h"
#include "results/statistic.h"

namespace perfora::optimize {
namespace {

using results::Measure;
using results::Target;
using results::Term;

double square(double value) {
  return value * value;
}

/// What a measure counts that no replicate reached.
double worst_term(const Target& target) {
  return square(std::log(target.floor));
}

/// The term of one replicate for a measure of value x; `level` is the wished stress.
double term_of(const Measure& measure, double x, double level, const Target& target) {
  if (std::isnan(x)) return worst_term(target);
  const double relative = std::max(x / level, target.floor);
  switch (measure.term) {
    case Term::none:
      return 0.0;
    case Term::square:
      return square(x);
    case Term::logarithm:
      return square(std::log(std::max(x, target.floor)));
    case Term::logarithm_above:
      return square(std::max(0.0, std::log(relative)));
    case Term::logarithm_below:
      return square(std::min(0.0, std::log(relative)));
    case Term::shortfall:
      return square(1.0 - x);
  }
  return 0.0;
}

/// What a wish costs that a mean of x does not keep: as much as a measure that was not reached, and (ln(x/bound))^2
/// beyond the nearer bound; 0 within.
double cost_of(const results::Wish& wish, double x, const Target& target) {
  if (std::isnan(x)) return 2.0 * worst_term(target);
  if (x < wish.low) return worst_term(target) + square(std::log(std::max(x / wish.low, target.floor)));
  if (x > wish.high)
    return worst_term(target) + (wish.high > 0.0 ? square(std::log(x / wish.high)) : worst_term(target));
  return 0.0;
}

std::vector<double> values_of(const Measure& measure, const std::vector<const Evaluation*>& runs) {
  std::vector<double> values;
  for (const Evaluation* run : runs) values.push_back(results::value_of(measure, *run));
  return values;
}

double mean_of(const std::vector<double>& values) {
  if (!values.empty() && std::isinf(values.front())) return values.front();  // The wall of a block without holes.
  return results::statistic_of({}, values).mean;
}

/// Sets the terms of the objectives and gives their weighted sum.
double weigh_terms(const Target& target, const std::vector<const Evaluation*>& runs, Score& score) {
  double sum = 0.0;
  for (const Measure* measure : objectives(target)) {
    const double weight = target.weights[static_cast<std::size_t>(measure - results::measures().data())];
    double& mean = score.terms.emplace_back(0.0);
    for (const Evaluation* run : runs) {
      const double level = target.level(run->summary.plateau_start, run->summary.plateau_end);
      const double term = term_of(*measure, results::wished_value(*measure, *run), level, target);
      mean += term / static_cast<double>(runs.size());
      sum += weight * term / static_cast<double>(runs.size());
    }
  }
  return sum;
}

/// Adds what the wishes cost that the means do not keep.
void add_wishes(const Target& target, const std::vector<const Evaluation*>& runs, Score& score) {
  for (const results::Wish& wish : results::wishes(target)) {
    std::vector<double> values;
    for (const Evaluation* run : runs) values.push_back(results::wished_value(*wish.measure, *run));
    // Blocks without the measure count as the verdict counts them: they do not keep the wish.
    const auto without = static_cast<double>(
        std::count_if(values.begin(), values.end(), [](double value) { return std::isnan(value); }));
    const double share = without / static_cast<double>(values.size());
    const double mean = mean_of(values);
    double cost = share * cost_of(wish, std::nan(""), target);
    if (share < 1.0) cost += (1.0 - share) * cost_of(wish, mean, target);
    ++score.wishes;
    if (cost > 0.0) ++score.not_kept;
    score.of_wishes += target.weight_limits * cost;
  }
}

}  // namespace

std::vector<const Measure*> objectives(const Target& target) {
  const bool wanted = target.plateau_stress > 0.0 || target.has_curve();
  std::vector<const Measure*> weighed;
  for (std::size_t k = 0; k < results::measures().size(); ++k) {
    const Measure& measure = results::measures()[k];
    if (target.weights[k] > 0.0 && (wanted || std::string_view(measure.key) != "target_distance"))
      weighed.push_back(&measure);
  }
  return weighed;
}

bool usable(const Evaluation& evaluation) {
  const bool wherever = evaluation.summary.measured.starts_with("found");
  return evaluation.status == results::RunStatus::completed &&
         (wherever || std::isfinite(evaluation.summary.plateau_stress));
}

std::string wishes_text(const Score& score) {
  if (score.wishes == 0) return {};
  return fmt::format(", {} of {} wish{} kept", score.wishes - score.not_kept, score.wishes,
                     score.wishes == 1 ? "" : "es");
}

Score score_of(const Target& target, std::span<const Evaluation* const> replicates) {
  Score score;
  std::vector<const Evaluation*> runs;
  for (const Evaluation* evaluation : replicates) {
    ++score.replicates;
    if (usable(*evaluation))
      runs.push_back(evaluation);
    else if (score.failed++ == 0)
      score.reason = evaluation->reason.empty() ? "no plateau in the window" : evaluation->reason;
  }
  const auto statistic = [&](const char* key) {
    return results::statistic_of({}, values_of(*results::measure_called(key), runs));
  };
  const auto or_zero = [](double value) { return std::isfinite(value) ? value : 0.0; };
  const results::Statistic plateau = statistic("plateau_stress");
  score.plateau_mean = or_zero(plateau.mean);
  score.plateau_std = or_zero(plateau.standard_deviation);
  score.undulation_mean = or_zero(statistic("undulation").mean);
  score.first_peak_mean = or_zero(statistic("first_peak_stress").mean);
  for (const Measure* measure : results::recorded_measures(target))
    score.recorded.push_back(mean_of(values_of(*measure, runs)));
  score.valid = score.failed == 0 && score.replicates > 0;
  if (!score.valid) return score;
  add_wishes(target, runs, score);
  const double terms = weigh_terms(target, runs, score), value = terms + score.of_wishes;
  score.value = std::isfinite(value) ? std::min(value, largest_score) : largest_score;
  if (!(value <= largest_score)) score.of_wishes = std::isfinite(terms) ? std::max(0.0, score.value - terms) : 0.0;
  return score;
}

}  // namespace perfora::optimize
