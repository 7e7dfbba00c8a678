// What is here: which discs Cundall's damping holds back, and how much. What is not: the damped kick (integrator.h).
#pragma once

#include <cstdint>
#include <vector>

#include "solver/bond_network.h"
#include "solver/options.h"

namespace perfora::solver {

/// Coefficients of Cundall's local damping by disc, kept up to date with the breaks. They follow from the network
/// alone, so a restored run has the same.
class CundallDamping {
 public:
  CundallDamping() = default;
  CundallDamping(const DynamicsOptions& dynamics, const BondNetwork& network, std::size_t discs);

  const double* coefficients() const { return coefficients_.data(); }  ///< c of forces, by disc
  double of_force(std::size_t disc) const { return coefficients_[disc]; }
  double rotation_ratio() const { return rotation_ratio_; }  ///< c of torques over c of forces
  /// The bond between these discs is gone.
  void bond_broke(std::int32_t i, std::int32_t j);

 private:
  void free_when_alone(std::int32_t disc);
  std::vector<double> coefficients_;
  std::vector<std::int32_t> bonds_;  ///< intact ones, by disc; empty where they do not matter
  double rotation_ratio_ = 1.0;
};

}  // namespace perfora::solver
