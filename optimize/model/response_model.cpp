// What is here: learning the responses of a target. What is not: a process (gaussian_process.cpp), answers.
#include "optimize/model/response_model.h"
#include "optimize/model/average.h"

#include <fmt/format.h>

#include <algorithm>
#include <boost/math/distributions/binomial.hpp>
#include <cmath>
#include <set>

namespace perfora::model {
namespace {

using Eigen::MatrixXd;
using Eigen::VectorXd;

/// Half width of a 95 % interval of a normal number, in deviations.
constexpr double of_normal = 1.959963985;
/// A class needs this many designs to be told apart.
constexpr int fewest_of_class = 4;

Spread spread_of(const std::vector<double>& values) {
  Spread spread{static_cast<int>(values.size()), 0.0};
  if (values.size() < 2) return spread;
  const double mean = mean_of(values);
  for (const double value : values) spread.variance += (value - mean) * (value - mean);
  spread.variance /= static_cast<double>(values.size() - 1);
  return spread;
}

/// A measure that is above zero throughout varies by factors; strains and counts by differences.
Scale scale_of(const results::Measure& measure, const std::vector<std::vector<double>>& values) {
  if (measure.term == results::Term::shortfall || measure.dimension == io::Dimension::count) return Scale::plain;
  for (const auto& replicates : values)
    for (const double value : replicates)
      if (!(value > 0.0)) return Scale::plain;
  return Scale::logarithm;
}

}  // namespace

bool is_usable(const results::Evaluation& evaluation) {
  const bool wherever = evaluation.summary.measured.starts_with("found");
  return evaluation.status == results::RunStatus::completed && !evaluation.curve.strain_yy.empty() &&
         (wherever || std::isfinite(evaluation.summary.plateau_stress));
}

double Response::scatter(const Inputs& one) const {
  return std::sqrt(process.hyperparameters().noise * noise.relative(one));
}

bool Coverage::trusted() const {
  if (count == 0 || share() < 0.85) return false;
  if (share() <= 0.98) return true;
  const boost::math::binomial outside(count, 0.02);
  return boost::math::cdf(outside, count - inside) >= 0.05;
}

/// Rows that can be learnt from: the designs' usable runs.
struct ResponseModel::Table {
  std::vector<const KnownDesign*> designs;
  std::vector<std::vector<const results::Evaluation*>> runs;  ///< usable ones, a row
  Inputs inputs;
  std::vector<std::vector<VectorXd>> binned;  ///< a row, a run
  const Minimiser* minimiser = nullptr;
};

ResponseModel::ResponseModel(std::span<const KnownDesign> known, const results::Target& target,
                             const results::MeasuringFrame& frame, const Minimiser& minimiser)
    : frame_(frame) {
  if (known.empty()) return;
  std::vector<Traits> traits;
  for (const KnownDesign& one : known) traits.push_back(one.traits);
  features_ = Features(traits);
  find_classes(known);
  Table table;
  table.minimiser = &minimiser;
  std::set<int> numbers;
  for (const KnownDesign& one : known) {
    std::vector<const results::Evaluation*> runs;
    for (const results::Evaluation* run : one.replicates)
      if (is_usable(*run)) runs.push_back(run);
    if (runs.empty()) continue;
    numbers.insert(one.design);
    table.designs.push_back(&one);
    table.runs.push_back(std::move(runs));
    table.inputs.append(inputs_of(one.traits, one.fidelity));
  }
  learnt_ = static_cast<int>(numbers.size());
  if (learnt_ < fewest_designs) return;
  learn_curves(table);
  learn_roughness(table, target);
  learn_measures(table, target);
}

void ResponseModel::find_classes(std::span<const KnownDesign> known) {
  Inputs all, broken;
  std::vector<bool> good, fronts;
  for (const KnownDesign& one : known) {
    const Inputs inputs = features_.inputs_of(one.traits, one.fidelity);
    int usable = 0;
    std::vector<double> drops;
    for (const results::Evaluation* run : one.replicates) {
      if (!is_usable(*run)) continue;
      ++usable;
      if (std::isfinite(run->summary.stress_drop_ratio)) drops.push_back(run->summary.stress_drop_ratio);
    }
    if (one.replicates.empty()) continue;
    all.append(inputs);
    good.push_back(usable == static_cast<int>(one.replicates.size()));
    if (drops.empty()) continue;
    broken.append(inputs);
    fronts.push_back(mean_of(drops) >= front_drop_ratio);
  }
  if (!good.empty()) success_.emplace(all, good);
  const auto members = std::count(fronts.begin(), fronts.end(), true);
  if (members >= fewest_of_class && static_cast<std::ptrdiff_t>(fronts.size()) - members >= fewest_of_class)
    front_.emplace(broken, fronts);
}

Inputs ResponseModel::inputs_of(const Traits& traits, int fidelity) const {
  Inputs one = features_.inputs_of(traits, fidelity);
  if (!front_) return one;
  const double front = front_->probability(one);
  one.points.conservativeResize(1, one.points.cols() + 1);
  one.points(0, one.points.cols() - 1) = front;
  return one;
}

double ResponseModel::success(const Inputs& one) const {
  if (!success_) return 1.0;
  Inputs plain = one;
  plain.points.conservativeResize(1, features_.count());
  return success_->probability(plain);
}

std::optional<double> ResponseModel::front(const Inputs& one) const {
  if (!front_) return std::nullopt;
  return one.points(0, one.points.cols() - 1);
}

void ResponseModel::add_response(Table& table, const std::string& name, const results::Measure* measure, Scale scale,
                                 const std::vector<std::vector<double>>& values) {
  Observations seen;
  std::vector<Spread> spreads;
  std::vector<double> means;
  for (std::size_t k = 0; k < values.size(); ++k) {
    if (values[k].empty()) continue;
    seen.inputs.append(table.inputs.row(static_cast<int>(k)));
    seen.design.push_back(table.designs[k]->design);
    means.push_back(mean_of(values[k]));
    spreads.push_back(spread_of(values[k]));
  }
  if (static_cast<int>(means.size()) < fewest_designs) return;
  NoiseModel noise(seen.inputs, spreads, *table.minimiser);
  const auto n = static_cast<Eigen::Index>(means.size());
  seen.values = Eigen::Map<const VectorXd>(means.data(), n);
  seen.relative_noise.resize(n);
  for (Eigen::Index k = 0; k < n; ++k)
    seen.relative_noise(k) =
        noise.relative(seen.inputs.row(static_cast<int>(k))) / spreads[static_cast<std::size_t>(k)].count;
  GaussianProcess process = fitted(seen, {*table.minimiser, noise.pooled(), noise.freedom(), false});
  for (const LeftOut& out : process.left_out()) {
    ++coverage_.count;
    if (std::abs(out.value - out.mean) <= of_normal * std::sqrt(out.variance)) ++coverage_.inside;
  }
  responses_.push_back({name, measure, scale, std::move(process), std::move(noise)});
}

void ResponseModel::learn_curves(Table& table) {
  std::vector<const results::History*> curves;
  double end = 1.0;
  for (const auto& runs : table.runs)
    for (const results::Evaluation* run : runs) {
      curves.push_back(&run->curve);
      end = std::min(end, run->curve.strain_yy.back());
    }
  curves_ = CurveBasis(end, curves);
  MatrixXd means(static_cast<Eigen::Index>(table.runs.size()), curves_.bins());
  for (std::size_t k = 0; k < table.runs.size(); ++k) {
    VectorXd sum = VectorXd::Zero(curves_.bins());
    std::vector<VectorXd> binned;
    for (const results::Evaluation* run : table.runs[k]) {
      binned.push_back(curves_.binned(run->curve));
      sum += binned.back();
    }
    means.row(static_cast<Eigen::Index>(k)) = sum.transpose() / static_cast<double>(binned.size());
    table.binned.push_back(std::move(binned));
  }
  curves_.find_components(means);
  for (int j = 0; j < curves_.components(); ++j) {
    std::vector<std::vector<double>> values;
    for (const auto& runs : table.binned) {
      values.emplace_back();
      for (const VectorXd& one : runs) values.back().push_back(curves_.scores(one)(j));
    }
    add_response(table, fmt::format("curve {}", j + 1), nullptr, Scale::plain, values);
  }
}

/// Of a run: what its distance to the target has beyond that of its curve as the components hold it. The rest of the
/// curve's own unevenness, and of the components' fit.
void ResponseModel::learn_roughness(Table& table, const results::Target& target) {
  const bool wanted = target.plateau_stress > 0.0 || target.has_curve();
  if (!wanted || frame_.options.plateau != results::PlateauPlace::window) return;
  const VectorXd window = curves_.window(frame_.options.plateau_start, frame_.options.plateau_end);
  std::vector<std::vector<double>> values;
  for (std::size_t k = 0; k < table.runs.size(); ++k) {
    values.emplace_back();
    for (std::size_t r = 0; r < table.runs[k].size(); ++r) {
      const double distance = table.runs[k][r]->summary.target_distance;
      if (!std::isfinite(distance)) continue;
      const VectorXd smooth = curves_.curve(curves_.scores(table.binned[k][r]));
      double held = 0.0;
      for (int j = 0; j < curves_.bins(); ++j) {
        const double wished = target.stress_at(
            0.5 * (curves_.edges()[static_cast<std::size_t>(j)] + curves_.edges()[static_cast<std::size_t>(j) + 1]));
        if (window(j) > 0.0) held += window(j) * std::pow(smooth(j) - std::log(wished + curves_.floor()), 2);
      }
      values.back().push_back(distance * distance - held);
    }
  }
  const std::size_t before = responses_.size();
  add_response(table, "roughness", nullptr, Scale::plain, values);
  if (responses_.size() > before) roughness_ = before;
}

void ResponseModel::learn_measures(Table& table, const results::Target& target) {
  const bool windowed = frame_.options.plateau == results::PlateauPlace::window;
  for (const results::Measure* measure : results::recorded_measures(target)) {
    const std::string_view key = measure->key;
    if (measure->of_packing()) continue;                                              // Known from the layout.
    if (windowed && (key == "plateau_stress" || key == "target_distance")) continue;  // From the curve.
    std::vector<std::vector<double>> values;
    for (const auto& runs : table.runs) {
      values.emplace_back();
      for (const results::Evaluation* run : runs) {
        const double value = results::value_of(*measure, *run);
        if (std::isfinite(value)) values.back().push_back(value);
      }
    }
    const Scale scale = scale_of(*measure, values);
    if (scale == Scale::logarithm)
      for (auto& replicates : values)
        for (double& value : replicates) value = std::log(value);
    add_response(table, std::string(key), measure, scale, values);
  }
}

std::string ResponseModel::in_words() const {
  if (!made())
    return fmt::format("{} designs are too few for a model, which needs {} with a curve", learnt_, fewest_designs);
  return fmt::format("leave-one-design-out coverage of the model's 95 % intervals: {:.3g} % ({} of {}, {} designs)",
                     100.0 * coverage_.share(), coverage_.inside, coverage_.count, learnt_);
}

ResponseModel::Curve ResponseModel::curve(const Inputs& one) const {
  VectorXd scores(components());
  VectorXd variance(components());
  for (int j = 0; j < components(); ++j) {
    const Expected expected = responses_[static_cast<std::size_t>(j)].process.at(one);
    scores(j) = expected.mean;
    variance(j) = expected.variance;
  }
  const VectorXd mean = curves_.curve(scores);
  Curve found;
  for (int k = 0; k < curves_.bins(); ++k) {
    const auto at = static_cast<std::size_t>(k);
    double sum = 0.0;
    for (int j = 0; j < components(); ++j) {
      VectorXd unit = VectorXd::Unit(components(), j);
      const double weight = curves_.curve(unit)(k) - curves_.curve(VectorXd::Zero(components()))(k);
      sum += weight * weight * variance(j);
    }
    const auto stress = [&](double logarithm) { return std::max(0.0, std::exp(logarithm) - curves_.floor()); };
    found.strain.push_back(0.5 * (curves_.edges()[at] + curves_.edges()[at + 1]));
    found.stress.push_back(stress(mean(k)));
    found.low.push_back(stress(mean(k) - of_normal * std::sqrt(sum)));
    found.high.push_back(stress(mean(k) + of_normal * std::sqrt(sum)));
  }
  return found;
}

ResponseModel ResponseModel::told(const Inputs& one) const {
  ResponseModel longer = *this;
  for (Response& response : longer.responses_) {
    const double mean = response.process.at(one).mean;
    response.process = response.process.told(one, mean, response.noise.relative(one));
  }
  return longer;
}

}  // namespace perfora::model
