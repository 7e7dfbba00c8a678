// What is here: the score. What is not: who asks for it.
#include "optimize/search/objective.h"

#include <algorithm>
#include <cmath>

namespace perfora::optimize {
namespace {

struct Moments {
  double mean = 0.0, std = 0.0;
};

Moments moments(const std::vector<double>& values) {
  Moments result;
  if (values.empty()) return result;
  const double n = static_cast<double>(values.size());
  for (const double value : values) result.mean += value / n;
  if (values.size() < 2) return result;
  double squares = 0.0;
  for (const double value : values) squares += (value - result.mean) * (value - result.mean);
  result.std = std::sqrt(squares / (n - 1.0));
  return result;
}

double square(double value) {
  return value * value;
}

double weighted(double weight, double value) {
  return weight > 0.0 ? weight * square(value) : 0.0;
}

}  // namespace

void describe(io::Schema& schema, TargetKeys& keys) {
  auto section = schema.section("target", "What the search is after, and what its score adds up.");
  section.real("plateau_stress", keys.plateau_stress, io::Dimension::stress, io::Range::non_negative(),
               "Wanted mean stress over the window");
  section.real_list("window", keys.window, io::Dimension::ratio, io::Range::between(0.0, 1.0),
                    "Start and end of the window in engineering strain");
  section.real("weight_std", keys.weight_std, io::Dimension::none, io::Range::non_negative(),
               "Weight of the spread between replicates, (std/target)^2");
  section.real("weight_undulation", keys.weight_undulation, io::Dimension::none, io::Range::non_negative(),
               "Weight of the undulation within the window, squared");
  section.real("weight_peak", keys.weight_peak, io::Dimension::none, io::Range::non_negative(),
               "Weight of a first peak above the target, ((peak - target)/target)^2");
}

bool usable(const Evaluation& evaluation) {
  return evaluation.status == results::RunStatus::completed && std::isfinite(evaluation.summary.plateau_stress);
}

Score score_of(const TargetKeys& target, std::span<const Evaluation* const> replicates) {
  Score score;
  std::vector<double> plateaus, undulations, peaks;
  for (const Evaluation* evaluation : replicates) {
    ++score.replicates;
    if (!usable(*evaluation)) {
      if (score.failed++ == 0)
        score.reason = evaluation->reason.empty() ? "no plateau in the window" : evaluation->reason;
      continue;
    }
    plateaus.push_back(evaluation->summary.plateau_stress);
    if (std::isfinite(evaluation->summary.undulation)) undulations.push_back(evaluation->summary.undulation);
    if (std::isfinite(evaluation->summary.first_peak_stress)) peaks.push_back(evaluation->summary.first_peak_stress);
  }
  const Moments plateau = moments(plateaus);
  score.plateau_mean = plateau.mean;
  score.plateau_std = plateau.std;
  score.undulation_mean = moments(undulations).mean;
  score.first_peak_mean = moments(peaks).mean;
  score.valid = score.failed == 0 && score.replicates > 0;
  if (!score.valid) return score;
  const double aim = target.plateau_stress;
  const double value = square((plateau.mean - aim) / aim) + weighted(target.weight_std, plateau.std / aim) +
                       weighted(target.weight_undulation, score.undulation_mean) +
                       weighted(target.weight_peak, std::max(0.0, score.first_peak_mean - aim) / aim);
  score.value = std::isfinite(value) ? std::min(value, largest_score) : largest_score;
  return score;
}

}  // namespace perfora::optimize
