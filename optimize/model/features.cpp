// What is here: traits that vary, scaled. What is not: models.
#include "optimize/model/features.h"

#include <algorithm>

#include "optimize/model/descriptors.h"

namespace perfora::model {
namespace {

/// A trait whose range is below this (of its largest size) is the same in all designs but for rounding.
constexpr double least_range = 1e-6;

}  // namespace

Traits traits_of(const optimize::Design& design, std::span<const double> point) {
  Descriptors described = describe_design(design);
  Traits traits{described.family, std::move(described.values)};
  traits.values.insert(traits.values.end(), point.begin(), point.end());
  return traits;
}

Features::Features(std::span<const Traits> known) {
  for (std::size_t k = 0; k < known.front().values.size(); ++k) {
    double low = known.front().values[k], high = low;
    for (const Traits& traits : known) {
      low = std::min(low, traits.values[k]);
      high = std::max(high, traits.values[k]);
    }
    if (!(high - low > least_range * std::max({1.0, std::abs(low), std::abs(high)}))) continue;
    taken_.push_back(k);
    low_.push_back(low);
    range_.push_back(high - low);
  }
}

std::vector<std::string> Features::names(std::span<const std::string> variables) const {
  std::vector<std::string> all;
  const std::size_t described = descriptor_list().size();
  for (const std::size_t k : taken_)
    all.push_back(k < described ? descriptor_list()[k].name : variables[k - described]);
  return all;
}

Inputs Features::inputs_of(const Traits& traits, int fidelity) const {
  Inputs one{Eigen::MatrixXd(1, count()), {traits.family}, {fidelity}};
  for (std::size_t k = 0; k < taken_.size(); ++k)
    one.points(0, static_cast<Eigen::Index>(k)) = (traits.values[taken_[k]] - low_[k]) / range_[k];
  return one;
}

}  // namespace perfora::model
