// What is here: when a run has passed its first peak. What is not: the peak's stress and strain, which are tracked at
// every step (simulation.h).
#pragma once

namespace perfora::solver {

/// Looks at the mean stress over pieces of strain, the same for every run whatever it writes. Plain numbers, so that a
/// checkpoint holds them.
struct PeakWatch {
  double work = 0.0, strain = 0.0;   ///< of the present piece so far: stress times strain, Pa; strain
  double largest = 0.0;              ///< largest mean of a piece, Pa
  double largest_at = 0.0;           ///< engineering strain at its end
  double last = 0.0, last_at = 0.0;  ///< mean of the last piece, Pa, and the strain at its end

  /// Pieces are at least this long in strain.
  static constexpr double piece = 5e-4;

  /// A segment of the path is over, `width` long in strain, at the engineering strain `at`, with the mean stress (Pa).
  /// True where it ended a piece.
  bool ends_piece(double stress, double width, double at);
  /// After a piece: whether the stress has fallen so far below the largest that the first peak is behind.
  /// `estimated_strain`: of the first peak; a fall from a maximum far beyond it is a serration of the rubble.
  bool passed(double estimated_strain) const;
};

}  // namespace perfora::solver
