// What is here: Walls, rigid platens and side walls: their contact with discs, with its history, and the force on them.
// What is not: where they stand (specimen.h), the contact law (laws.h).
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "solver/kernels/kernels.h"
#include "solver/specimen.h"

namespace perfora::solver {

/// Contact of every disc with every wall, by the contact law; walls transmit compression and friction, no tension. The
/// block's faces keep a residual stiffness: a disc that lost bonds to the cut is held from its first distance on with
/// the stiffness of those bonds and, like them, without a dashpot, until it has once been farther off by the critical
/// stretch (and by its radius). From then on, and for all others, it is an ordinary contact at its radius. So the block
/// begins without any force, and its edge is about as stiff as its inside. The same bits for any number of threads.
class Walls {
 public:
  Walls() = default;
  /// `critical_stretch`: delta_n^0, m. Takes the first distances from `discs`.
  Walls(std::vector<WallPlace> places, const ContactLaw& contact, double critical_stretch, const DiscState& discs,
        const CellMatrix& cell);

  bool empty() const { return places_.empty(); }
  const std::vector<WallPlace>& places() const { return places_; }
  /// Adds the walls' forces to the discs, their virial (branch from the wall to the centre), dissipation and overlap to
  /// the sums. After the backend, at the same positions and velocities.
  void add_forces(ForceStep& step, int threads, StepSums& sums);
  /// Force of wall `w` on the discs at the last step, N/m.
  std::array<double, 2> force(std::size_t w) const { return force_[w]; }
  /// Energy of the walls' springs, J/m.
  double elastic_energy(const DiscState& discs, const CellMatrix& cell) const;

  /// Pressure on each wall: force along its normal over the block's nominal edge; adds the last step to the row, with
  /// this weight.
  void add_to_row(const CellMatrix& edges, double weight);
  void reset_row();
  /// Mean pressure since reset_row(), Pa, compression positive; the last step's where the row is empty.
  double row_pressure(std::size_t w) const;

  /// Everything that changes during a run; histories wall by wall, disc by disc.
  struct Snapshot {
    std::vector<double> contact_distance, shear, viscous_force;
    std::vector<std::uint8_t> has_face_stiffness;
    std::vector<double> row;  ///< pressures now, their sums in the row, their weights
  };
  Snapshot snapshot() const;
  void restore(const Snapshot& snapshot);

 private:
  struct Contact {
    double contact_distance =
        0.0;  ///< distance at which it touches: the radius, or the first distance of a disc cut or held by a face
    double face_normal_stiffness = 0.0, face_tangential_stiffness = 0.0;  ///< N/m; 0: none left
    ContactHistory history;
    bool has_face_stiffness() const { return face_normal_stiffness > 0.0; }
  };
  struct ChunkSums {
    StepSums sums;
    std::array<std::array<double, 2>, 4> force = {};
  };
  /// Distance of disc d's centre from wall w, m, negative behind it.
  double distance(std::size_t w, std::size_t d, const DiscState& discs, const CellMatrix& cell) const;
  ContactLaw law_of(const Contact& contact, std::size_t w) const;
  void wall_contact(ForceStep& step, std::size_t w, std::size_t d, ChunkSums& chunk);

  std::vector<WallPlace> places_;
  std::vector<std::uint64_t> fixed_;  ///< reduced coordinates in fixed point
  ContactLaw law_;
  double critical_stretch_ = 0.0;
  std::size_t discs_ = 0;
  std::vector<Contact> contact_;  ///< wall by wall
  std::vector<ChunkSums> chunk_sums_;
  std::array<std::array<double, 2>, 4> force_ = {};
  std::array<double, 4> pressure_ = {}, row_sum_ = {};
  double row_weight_ = 0.0;
};

}  // namespace perfora::solver
