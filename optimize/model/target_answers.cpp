// What is here: draws of the posterior as blocks, and their scores. What is not: the posterior (gaussian_process.cpp).
#include "optimize/model/target_answers.h"

#include <algorithm>
#include <cmath>

#include "optimize/model/quasi_random.h"

namespace perfora::model {
namespace {

using Eigen::VectorXd;

constexpr std::uint64_t seed_of_draws = 20;  ///< any number: the draws are the same in every study

bool is_kept(const results::Wish& wish, double value) {
  return value >= wish.low && value <= wish.high;
}

}  // namespace

TargetAnswers::TargetAnswers(const results::Target& target, const ResponseModel& model, Scorer scorer, int draws)
    : target_(target),
      scorer_(std::move(scorer)),
      draws_(normal_matrix(draws, 2 * static_cast<int>(model.responses().size()), seed_of_draws)),
      wishes_(results::wishes(target)),
      recorded_(results::recorded_measures(target)) {
  const results::MeasuringFrame& frame = model.frame();
  if (frame.options.plateau != results::PlateauPlace::window) return;
  const CurveBasis& curves = model.curves();
  window_ = curves.window(frame.options.plateau_start, frame.options.plateau_end);
  if (!(target.plateau_stress > 0.0) && !target.has_curve()) return;
  wished_logs_.resize(curves.bins());
  for (int k = 0; k < curves.bins(); ++k) {
    const auto at = static_cast<std::size_t>(k);
    wished_logs_(k) = std::log(target.stress_at(0.5 * (curves.edges()[at] + curves.edges()[at + 1])) + curves.floor());
  }
}

/// Sets the measures of a block whose responses have these values.
void TargetAnswers::fill(const ResponseModel& model, const VectorXd& values, results::Evaluation& block) const {
  results::Summary& summary = block.summary;
  if (window_.size() > 0) {
    const VectorXd logs = model.curves().curve(values.head(model.components()));
    double stress = 0.0, square = 0.0;
    for (Eigen::Index k = 0; k < logs.size(); ++k) {
      if (!(window_(k) > 0.0)) continue;
      stress += window_(k) * std::max(0.0, std::exp(logs(k)) - model.curves().floor());
      if (wished_logs_.size() > 0) square += window_(k) * (logs(k) - wished_logs_(k)) * (logs(k) - wished_logs_(k));
    }
    summary.plateau_stress = stress;
    if (const auto rough = model.roughness()) square += values(static_cast<Eigen::Index>(*rough));
    if (wished_logs_.size() > 0) summary.target_distance = std::sqrt(std::max(0.0, square));
  }
  for (std::size_t k = 0; k < model.responses().size(); ++k) {
    const Response& response = model.responses()[k];
    if (!response.measure) continue;
    const double value = values(static_cast<Eigen::Index>(k));
    const double measured = response.scale == Scale::logarithm ? std::exp(value) : value;
    if (const auto* member = std::get_if<double results::Summary::*>(&response.measure->member))
      summary.*(*member) = measured;
    else if (const auto* whole = std::get_if<std::int64_t results::Summary::*>(&response.measure->member))
      summary.*(*whole) = static_cast<std::int64_t>(std::llround(std::max(0.0, measured)));
  }
}

/// Two blocks of one design.
struct TargetAnswers::Blocks {
  results::Evaluation first, second;
};

Answer TargetAnswers::at(const ResponseModel& model, const Inputs& one, const results::PackSummary& packing,
                         std::optional<double> best) const {
  const auto count = static_cast<Eigen::Index>(model.responses().size());
  VectorXd mean(count), error(count), scatter(count);
  for (Eigen::Index k = 0; k < count; ++k) {
    const Response& response = model.responses()[static_cast<std::size_t>(k)];
    const Expected expected = response.process.at(one);
    mean(k) = expected.mean;
    error(k) = std::sqrt(expected.variance);
    scatter(k) = response.scatter(one);
  }
  Blocks blocks;
  blocks.first.pack = packing;
  blocks.first.summary.measured = model.frame().text();
  blocks.first.summary.plateau_start = model.frame().options.plateau_start;
  blocks.first.summary.plateau_end = model.frame().options.plateau_end;
  blocks.second = blocks.first;
  const std::array<const results::Evaluation*, 2> both{&blocks.first, &blocks.second};
  Answer answer;
  answer.success = model.success(one);
  answer.each_wish.assign(wishes_.size(), 0.0);
  answer.measures.assign(recorded_.size(), 0.0);
  double squares = 0.0, all_kept = 0.0;
  const auto draws = static_cast<double>(draws_.rows());
  for (Eigen::Index d = 0; d < draws_.rows(); ++d) {
    const VectorXd centre = mean + error.cwiseProduct(draws_.row(d).head(count).transpose());
    const VectorXd off = scatter.cwiseProduct(draws_.row(d).tail(count).transpose());
    fill(model, centre + off, blocks.first);
    fill(model, centre - off, blocks.second);
    const double score = scorer_(both);
    answer.score += score / draws;
    squares += score * score / draws;
    if (best) answer.improvement += std::max(0.0, *best - score) / draws;
    const auto mean_of = [&](const results::Measure& measure) {
      return 0.5 * (results::value_of(measure, blocks.first) + results::value_of(measure, blocks.second));
    };
    bool kept = true;
    for (std::size_t k = 0; k < wishes_.size(); ++k) {
      const bool this_one = is_kept(wishes_[k], mean_of(*wishes_[k].measure));
      answer.each_wish[k] += this_one ? 1.0 / draws : 0.0;
      kept = kept && this_one;
    }
    all_kept += kept ? 1.0 / draws : 0.0;
    for (std::size_t k = 0; k < recorded_.size(); ++k) answer.measures[k] += mean_of(*recorded_[k]) / draws;
  }
  answer.score_error = std::sqrt(std::max(0.0, squares - answer.score * answer.score));
  answer.improvement *= answer.success;
  answer.wishes = answer.success * all_kept;
  return answer;
}

}  // namespace perfora::model
