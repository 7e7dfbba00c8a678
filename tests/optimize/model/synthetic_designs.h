// What is here: designs whose response is a formula of two numbers, measured as runs are. What is not: tests.
#pragma once

#include <deque>
#include <vector>

#include "optimize/model/quasi_random.h"
#include "optimize/model/response_model.h"
#include "results/measures.h"
#include "tests/optimize/model/model_support.h"

namespace perfora::model {

inline constexpr double wished_stress = 2e5;

/// ln(plateau / wished stress) of a design (x, y), of which the wish is met on a line; |.| <= 1.
inline double level_of(double x, double y) {
  return 0.8 * std::sin(2.5 * x) - 0.6 * y;
}
/// First peak over plateau: from 1.5 to 4.5, falling with y.
inline double peak_ratio_of(double y) {
  return 4.5 - 3.0 * y;
}

/// A curve that rises to a peak at 1 % strain, falls to a plateau at 3 % and stays there to 40 %.
inline results::Evaluation evaluation_of(double level, double ratio, const results::MeasuringFrame& frame) {
  results::Evaluation made;
  made.status = results::RunStatus::completed;
  const double plateau = wished_stress * std::exp(level), peak = ratio * plateau;
  for (int k = 0; k <= 400; ++k) {
    const double strain = 0.001 * k;
    for (const auto& column : results::History::columns()) (made.curve.*column.values).push_back(0.0);
    made.curve.strain_yy.back() = strain;
    made.curve.stress_yy.back() = strain < 0.01   ? peak * strain / 0.01
                                  : strain < 0.03 ? peak + (plateau - peak) * (strain - 0.01) / 0.02
                                                  : plateau;
    made.curve.time.back() = strain;
  }
  made.summary.first_peak_stress = peak;
  made.summary.first_peak_strain = 0.01;
  made.summary.impact_stress_per_rate = 0.0;
  made.summary.final_strain = 0.4;
  results::measure_curve(made.curve, frame, made.summary);
  return made;
}

inline results::Target synthetic_target() {
  results::Target target;
  target.plateau_stress = wished_stress;
  target.weight_limits = 0.0;  // without the steps at the bounds of wishes, so that a formula gives the expected score
  target.limits[static_cast<std::size_t>(results::measure_called("cap_ratio") - results::measures().data())] = {3.0};
  return target;
}

inline results::MeasuringFrame synthetic_frame(const results::Target& target) {
  results::MeasureOptions options;
  options.plateau_start = 0.10;
  options.plateau_end = 0.30;
  return results::measuring_frame(target, options, 2.5e-3);
}

/// `count` designs on scrambled Sobol points with `replicates` blocks, of which the level scatters by `noise`.
struct SyntheticDesigns {
  SyntheticDesigns(int count, int replicates, double noise) {
    const results::MeasuringFrame frame = synthetic_frame(synthetic_target());
    for (const auto& point : sobol_points(count, 2, 12)) {
      KnownDesign& design = known.emplace_back();
      design.traits = traits(point[0], point[1]);
      design.design = static_cast<int>(known.size());
      for (int r = 0; r < replicates; ++r) {
        const double off = noise * scatter(replicates * design.design + r);
        runs.push_back(evaluation_of(level_of(point[0], point[1]) + off, peak_ratio_of(point[1]), frame));
        design.replicates.push_back(&runs.back());
      }
    }
  }
  static Traits traits(double x, double y) { return {0, {x, y}}; }

  std::deque<results::Evaluation> runs;
  std::vector<KnownDesign> known;
};

}  // namespace perfora::model
