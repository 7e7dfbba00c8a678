// What is here: the interface of a force backend: from positions to forces, damage and breaks of one step.
// What is not: integration, ledger, cell control (simulation.h). Backends: kernels_reference.cpp (the oracle),
// kernels_openmp.cpp.
#pragma once

#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include "solver/bond_network.h"
#include "solver/cell.h"
#include "solver/laws.h"
#include "solver/near_pairs.h"
#include "solver/options.h"
#include "solver/state.h"

namespace perfora::solver {

/// What a force evaluation reads and writes. discs.fx, fy, torque are overwritten; network damage and state are brought
/// up to date; ids of bonds that broke are appended to `broken` (room for all is reserved).
struct ForceStep {
  DiscState& discs;
  BondNetwork& network;
  NearPairs& near_pairs;
  const CellMatrix& cell;         ///< now
  const CellMatrix& cell_before;  ///< at the start of the drift
  VelocityGradient gradient;      ///< L of the drift
  double dt;
  std::vector<std::int32_t>& broken;
};

/// One way to compute forces. Chosen once a run; every backend is held against the reference by
/// tests/solver/kernel_fixture.
class ForceBackend {
 public:
  virtual ~ForceBackend() = default;
  /// Builds the backend's own layout from the network. Bonds that are `compacted` are left out; `broken` ones keep an
  /// empty slot, so that a restored run sums in the same order as the run it goes on from.
  virtual void load(const BondNetwork& network, const DiscState& discs) = 0;
  virtual StepSums forces(ForceStep& step) = 0;
  /// Instruction set it runs with, for the record.
  virtual std::string simd() const = 0;
};

std::unique_ptr<ForceBackend> make_reference_backend(const BondLaw& bond, const ContactLaw& contact);
/// Vectorised, `threads` OpenMP threads; the same bits for every number of threads.
std::unique_ptr<ForceBackend> make_openmp_backend(const BondLaw& bond, const ContactLaw& contact, int threads);

/// A bond at one end of a step, seen from disc i: displacements at positions `a` (of i) and `b` (of j) in the cell.
inline BondKinematics kinematics_of(const DiscRecord& a, const DiscRecord& b, const CellMatrix& cell, double e0x,
                                    double e0y, double l0) {
  double dx = b.x - a.x, dy = b.y - a.y;
  dx -= dx > 0.5 ? 1.0 : (dx < -0.5 ? -1.0 : 0.0);
  dy -= dy > 0.5 ? 1.0 : (dy < -0.5 ? -1.0 : 0.0);
  const double rx = cell.xx * dx + cell.xy * dy, ry = cell.yy * dy;
  return bond_kinematics(rx, ry, e0x, e0y, l0, a.c * b.c - a.s * b.s, a.s * b.c + a.c * b.s);
}

}  // namespace perfora::solver
