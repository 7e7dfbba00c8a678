// What is here: the elastic half of a calibration: k_t/k_n for a wanted Poisson ratio from the elastic responses of the
// samples. What is not: strengths (calibration_search.cpp).
#pragma once

#include <vector>

#include "optimize/evaluate/evaluation.h"
#include "solver/bond_network.h"

namespace perfora::optimize {

/// E/k_n and nu of the samples' mean, two-dimensional.
struct UnitElasticity {
  double young = 0.0, poisson = 0.0;
};

/// Solid samples of a material, bonded, whose elastic constants are computed for many stiffness ratios.
class ElasticFit {
 public:
  /// Packs `replicates` samples of `sample` (material_sample). Throws io::InputError when a packing is not reached or
  /// nothing is bonded.
  ElasticFit(const DesignFile& sample, int replicates, const EvaluateOptions& packing);

  /// k_t/k_n from here to there: below, shear springs are gone and discs turn freely; above, nu is far below zero.
  static constexpr double least_ratio = 1e-3, largest_ratio = 5.0;

  /// One linear solution a sample; NaN where one did not converge.
  UnitElasticity at(double stiffness_ratio) const;
  /// k_t/k_n for a two-dimensional nu, by a bracketed root in logarithms (TOMS 748): nu falls as the ratio grows.
  /// Beyond what can be reached: the nearer end of the range.
  double stiffness_ratio_for(double poisson) const;

  double mean_diameter() const { return mean_diameter_; }        ///< m
  double mean_bond_length() const { return mean_bond_length_; }  ///< m

 private:
  struct Sample {
    solver::BondNetwork network;
    std::int32_t discs;
    double width, height;
  };
  std::vector<Sample> samples_;
  double mean_diameter_ = 0.0, mean_bond_length_ = 0.0;
};

/// Voigt's k_t/k_n for a two-dimensional Poisson ratio: (1 - 3 nu)/(1 + nu).
double voigt_stiffness_ratio(double poisson_ratio);

}  // namespace perfora::optimize
