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
#include "solver/neighbour_list.h"
#include "solver/options.h"
#include "solver/state.h"

namespace perfora::solver {

/// What a force evaluation reads and writes. discs.fx, fy, torque are overwritten; network damage and state are brought
/// up to date; ids of bonds that broke are appended to `broken` (room for all is reserved).
struct ForceStep {
  DiscState& discs;
  BondNetwork& network;
  NeighbourList& neighbour_list;
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
  /// Builds the backend's own layout from the network; `start` is the cell at the start of the run. Bonds that are
  /// `compacted` are left out; `broken` ones keep an empty slot, so that a restored run sums in the same order as the
  /// run it goes on from.
  virtual void load(const BondNetwork& network, const DiscState& discs, const CellMatrix& start) = 0;
  /// Near pairs have been listed anew or restored.
  virtual void set_neighbours(const NeighbourList& neighbour_list, const DiscState& discs) = 0;
  /// Brings the histories of the contacts in the near pairs up to date: to be called before anybody reads them.
  virtual void export_contact_history(NeighbourList& neighbour_list) const = 0;
  virtual StepSums forces(ForceStep& step) = 0;
  /// Of the steps to come; the same bits for every number. The reference backend has one.
  virtual void set_threads(int threads) = 0;
  /// Instruction set it runs with, for the record.
  virtual std::string simd() const = 0;
};

std::unique_ptr<ForceBackend> make_reference_backend(const BondLaw& bond, const ContactLaw& contact);
/// Vectorised, `threads` OpenMP threads; the same bits for every number of threads. `simd` must be one that this
/// machine has (usable_simd).
std::unique_ptr<ForceBackend> make_openmp_backend(const BondLaw& bond, const ContactLaw& contact, int threads,
                                                  SimdChoice simd = SimdChoice::automatic);
/// Instruction sets the bond kernels can use here, best first, without `automatic`.
std::vector<SimdChoice> usable_simd();

/// A bond's displacements at the end of the last drift, in the cell then. e0 from i to j, l0 in m.
inline BondKinematics kinematics_of(const DiscState& discs, std::int32_t i, std::int32_t j, const CellMatrix& cell,
                                    double e0x, double e0y, double l0) {
  const auto a = static_cast<std::size_t>(i), b = static_cast<std::size_t>(j);
  const double dx = reduced(discs.sx[b] - discs.sx[a]), dy = reduced(discs.sy[b] - discs.sy[a]);
  const CosineSine half = cosine_sine(discs.half_angle[a] + discs.half_angle[b]);
  return bond_kinematics(cell.xx * dx + cell.xy * dy, cell.yy * dy, e0x, e0y, l0, half.c, half.s);
}

/// The same at its start.
inline BondKinematics kinematics_before(const DiscState& discs, std::int32_t i, std::int32_t j, const CellMatrix& cell,
                                        double e0x, double e0y, double l0) {
  const auto a = static_cast<std::size_t>(i), b = static_cast<std::size_t>(j);
  const double dx = reduced(discs.sx_before[b] - discs.sx_before[a]),
               dy = reduced(discs.sy_before[b] - discs.sy_before[a]);
  const CosineSine half = cosine_sine(discs.half_angle_before[a] + discs.half_angle_before[b]);
  return bond_kinematics(cell.xx * dx + cell.xy * dy, cell.yy * dy, e0x, e0y, l0, half.c, half.s);
}

}  // namespace perfora::solver
