// What is here: soft discs in a periodic rectangle, pushed apart until the net forces of their overlaps vanish.
// What is not: lists and force loops (pair_lists.h, pair_forces.h), the search for the jammed state (jam.h), sizes and
// start (make_packing.cpp).
#pragma once

#include <cstdint>
#include <vector>

#include "geometry/pair_forces.h"
#include "geometry/pair_lists.h"
#include "io/cancellation.h"

namespace perfora::geometry {

/// Discs in a periodic rectangle in a unit of length of the order of their diameter; radii are multiplied by a common
/// scale.
struct SoftDiscs {
  double width = 0.0;
  double height = 0.0;
  std::vector<double> x, y, radius;
};

/// What a minimisation ended with. Energy is the sum of overlap^2/2 over pairs.
struct OverlapState {
  double pressure = 0.0;           ///< sum over pairs of overlap times distance, over twice the area
  double stiffness = 0.0;          ///< d pressure / d ln(scale) if all pairs moved affinely: an upper bound
  double mean_overlap = 0.0;       ///< over pairs that overlap
  double max_overlap_ratio = 0.0;  ///< largest overlap over the smaller (scaled) diameter of its pair
  double residual = 0.0;           ///< root mean square net force over the mean contact force
  std::int64_t iterations = 0;
  bool converged = false;
};

/// When a minimisation stops.
struct StopRule {
  double residual = 1e-2;           ///< see OverlapState::residual
  double negligible_overlap = 0.0;  ///< largest overlap ratio at which the discs count as not touching
  std::int64_t maximum_iterations = 20000;
};

/// Nesterov's accelerated descent, started anew where it goes uphill (O'Donoghue and Candes 2015), with masses
/// proportional to the radii. Sums run over fixed chunks: the bits do not depend on the number of threads.
class OverlapMinimiser {
 public:
  /// Once `cancellation` is requested, minimise() throws io::Cancelled.
  OverlapMinimiser(SoftDiscs discs, int threads, io::Cancellation cancellation = {});

  /// Minimises from the present positions with radii scale * radius. Cost: about three pairs a disc and iteration.
  OverlapState minimise(double scale, const StopRule& stop);

  const SoftDiscs& discs() const { return discs_; }

 private:
  ChunkDiscs chunk(std::size_t k);
  void renew_lists(double scale, double skin);
  void take_over_moves();
  ForceSums sum_forces(double scale);
  double move(const Motion& motion);
  OverlapState measure(double scale, const ForceSums& forces, const StopRule& stop, std::int64_t iteration);

  SoftDiscs discs_;
  int threads_;
  io::Cancellation cancellation_;
  std::int64_t chunks_;
  double largest_radius_ = 0.0;
  PairLists lists_;
  double push_;  ///< displacement over force and mass
  double searched_scale_ = 0.0, searched_margin_ = 0.0;
  std::vector<Place> places_;             ///< at the last search for pairs
  std::vector<Float2> moved_, selected_;  ///< displacements since then: now, at the last selection of near pairs
  std::vector<Float2> speed_, force_, inverse_mass_;
  std::vector<float> radius_;
  std::vector<ForceSums> force_sums_;  ///< one a chunk, as the next two
  std::vector<OverlapSums> overlap_sums_;
  std::vector<double> farthest_;
};

}  // namespace perfora::geometry
