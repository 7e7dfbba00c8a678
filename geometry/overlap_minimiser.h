// What is here: soft discs in a periodic rectangle, pushed apart until the net forces of their overlaps vanish (FIRE),
// on Verlet lists. What is not: the search for the jammed state (jam.h), sizes and start (make_packing.cpp).
#pragma once

#include <cstdint>
#include <vector>

#include "geometry/thread_team.h"

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

/// Fast inertial relaxation engine (Bitzek et al. 2006, Guenole et al. 2020), masses proportional to the radii.
/// Every disc sums its own neighbours in a fixed order and reductions run over fixed chunks: the bits do not depend on
/// the number of threads.
class OverlapMinimiser {
 public:
  /// Each pair acts through its nearest periodic image only, so a disc must be smaller than half the cell.
  OverlapMinimiser(SoftDiscs discs, int threads);

  /// Minimises from the present positions with radii scale * radius. Cost: about 12 neighbours a disc and iteration.
  OverlapState minimise(double scale, const StopRule& stop);

  const SoftDiscs& discs() const { return discs_; }

 private:
  struct Sums {
    double force_squared = 0.0, speed_squared = 0.0, power = 0.0;
    double overlap = 0.0, virial = 0.0, distance_squared = 0.0;
    std::int64_t contacts = 0;
    double max_ratio = 0.0;
  };
  void wrap_positions();
  void build_lists(double skin);
  Sums compute_forces(bool measured);
  template <bool measured>
  Sums forces_of_chunk(std::size_t chunk);
  /// Moves all discs; returns the largest squared displacement since the lists were built.
  double move_discs(double keep, double steer, double step, bool stopped);
  OverlapState measure(const Sums& sums) const;

  /// What a pair needs of a disc, in half a cache line.
  struct Place {
    double x, y, radius, unused;
  };

  SoftDiscs discs_;
  std::size_t chunks_;
  ThreadTeam team_;
  std::vector<Place> places_;
  std::vector<double> mass_, inverse_mass_;
  std::vector<double> force_x_, force_y_, speed_x_, speed_y_, listed_x_, listed_y_;
  std::vector<std::vector<std::int32_t>> neighbours_;  ///< one array a chunk
  std::vector<std::int32_t> list_end_;                 ///< end of a disc's neighbours in its chunk's array
};

}  // namespace perfora::geometry
