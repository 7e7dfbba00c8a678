// What is here: designs as inputs of a model: descriptors and coordinates, those that vary, scaled. What is not: the
// descriptors (descriptors.h).
#pragma once

#include <span>
#include <string>
#include <vector>

#include "optimize/evaluate/design.h"
#include "optimize/model/kernel.h"

namespace perfora::model {

/// One design as it is known before scaling.
struct Traits {
  int family = 0;
  std::vector<double> values;  ///< descriptors, then the coordinates of its point in the unit cube of the study
};
/// Throws io::InputError where the design cannot be laid.
Traits traits_of(const optimize::Design& design, std::span<const double> point);

/// Which traits vary over the designs that a model learns from, and how they are scaled to [0, 1] there.
class Features {
 public:
  Features() = default;
  /// All of equal length; at least one.
  explicit Features(std::span<const Traits> known);
  int count() const { return static_cast<int>(taken_.size()); }
  /// Places in Traits::values of the inputs, in order.
  const std::vector<std::size_t>& taken() const { return taken_; }
  /// Names of the inputs; `variables` are those of the study.
  std::vector<std::string> names(std::span<const std::string> variables) const;
  /// One row.
  Inputs inputs_of(const Traits& traits, int fidelity) const;

 private:
  std::vector<std::size_t> taken_;
  std::vector<double> low_, range_;
};

}  // namespace perfora::model
