// What is here: what a model says of a target at a design: expected score, expected improvement, the probability that
// the wishes hold. What is not: the model (response_model.h), the score, which is handed in.
#pragma once

#include <functional>
#include <optional>
#include <span>
#include <vector>

#include "optimize/model/response_model.h"

namespace perfora::model {

/// The score of a design from single blocks of it; the lower the better.
using Scorer = std::function<double(std::span<const results::Evaluation* const>)>;

struct Answer {
  double success = 1.0;      ///< probability that its runs end with a plateau; the rest is given that they do
  double score = 0.0;        ///< expected
  double score_error = 0.0;  ///< standard deviation of the score of the design's mean blocks
  double improvement = 0.0;  ///< expected amount by which its score lies below `best`, times success; 0 without a best
  double wishes = 1.0;       ///< probability that the means over blocks keep every wish, times success
  std::vector<double> each_wish;  ///< the same wish by wish (results::wishes()), given success
  std::vector<double> measures;   ///< expected means of results::recorded_measures(), NaN where not modelled
};

/// The posterior in `draws` quasi-random draws (fixed, the same for every design, so that answers are smooth over
/// designs): each a design's mean blocks with two single blocks of it that lie opposite about them, scored by the
/// functions that score simulations.
class TargetAnswers {
 public:
  static constexpr int usual_draws = 64;
  TargetAnswers(const results::Target& target, const ResponseModel& model, Scorer scorer, int draws = usual_draws);

  /// `one`: ResponseModel::inputs_of(); `packing`: porosity and thinnest wall of the design, which its layout tells.
  Answer at(const ResponseModel& model, const Inputs& one, const results::PackSummary& packing,
            std::optional<double> best = std::nullopt) const;

 private:
  struct Blocks;
  void fill(const ResponseModel& model, const Eigen::VectorXd& values, results::Evaluation& block) const;

  results::Target target_;
  Scorer scorer_;
  Eigen::MatrixXd draws_;  ///< rows: draws; columns: the design's mean, then the block about it
  std::vector<results::Wish> wishes_;
  std::vector<const results::Measure*> recorded_;
  Eigen::VectorXd window_;       ///< weights of the bins
  Eigen::VectorXd wished_logs_;  ///< ln(wished stress + floor) in the bins; empty: none is wished
};

}  // namespace perfora::model
