// What is here: Simulation, the time loop of discs in the cell: kick, drift, forces, ledger. What is not: files,
// measures, stopping (run.h).
#pragma once

#include <cstdint>
#include <memory>
#include <vector>

#include "geometry/packing.h"
#include "results/break_event.h"
#include "solver/cell.h"
#include "solver/damping.h"
#include "solver/integrator.h"
#include "solver/kernels/kernels.h"
#include "solver/loading_rate.h"
#include "solver/mass.h"
#include "solver/options.h"
#include "solver/walls.h"

namespace perfora::solver {

/// Energies, J per metre of depth. Work and dissipation since the start, each summed from its own force; the rest as
/// they are now.
struct Ledger {
  double external_work = 0.0, damage = 0.0, friction = 0.0, viscous = 0.0, cundall = 0.0;
  double elastic_bonds = 0.0, elastic_contacts = 0.0, kinetic = 0.0;
  double sum() const { return damage + friction + viscous + cundall + elastic_bonds + elastic_contacts + kinetic; }
};

/// Everything a run starts from.
struct SimulationInput {
  const geometry::Packing* clipped = nullptr;
  BondNetwork network;
  SolverOptions options;
  MassProperties masses;
  Cell cell;
  BlockFrame block;              ///< by default the block is the cell
  std::vector<WallPlace> walls;  ///< platens and side walls
  double time_step = 0.0;        ///< s
  double mean_diameter = 0.0;    ///< m, sets the Verlet skin
  LoadingPlan loading;           ///< moves the height where it has segments; else the cell moves by itself
  int threads = 1;
};

/// State and step. One call of step() moves from t to t + dt; it writes no files and throws nothing, and allocates
/// only in the rare steps that rebuild the neighbour list or compact the bonds. The same
/// bits for any number of threads.
class Simulation {
 public:
  explicit Simulation(SimulationInput input);

  void step();
  /// Threads of the steps to come, at least 1; no bit depends on their number.
  void set_threads(int threads);

  std::int64_t steps() const { return progress_.steps; }
  double time() const { return static_cast<double>(progress_.steps) * time_step_; }
  double time_step() const { return time_step_; }
  double strain() const { return engineering_strain(cell_.start, now_); }
  const CellMatrix& cell() const { return now_; }
  const Cell& cell_motion() const { return cell_; }
  /// Edges of the block now: the cell's, or the nominal ones between platens and sides, m.
  CellMatrix block() const { return block_.edges(now_); }
  const Walls& walls() const { return walls_; }
  /// Stress at this step: sum F_j,a r_b, walls included, over the area of the block, Pa, compression positive.
  Virial stress() const;
  /// Mean stress over the strain (over time where no path drives the cell) since the last call of reset_row(), Pa.
  Virial row_stress() const;
  void reset_row();
  /// All energies now; the kinetic one and the last half kick's damping use the velocity at the full step.
  Ledger ledger() const;
  std::int64_t contacts() const;  ///< pairs of discs that touch

  /// Largest |sigma_yy| history: tracked every step until freeze_peak().
  double peak_stress() const { return progress_.peak_stress; }
  double peak_strain() const { return progress_.peak_strain; }
  double peak_time() const { return progress_.peak_step * time_step_; }
  /// Where the run is on its strain path; `steps` = 0 between two segments.
  const LoadingState& loading() const { return progress_.loading; }
  /// Kinetic energy of the fluctuating velocity at the half step, less that of the drift of all discs together (which
  /// loads nothing), J per metre of depth.
  double kinetic_energy_at_half_step() const;
  bool peak_frozen() const { return progress_.peak_frozen != 0.0; }
  void freeze_peak() { progress_.peak_frozen = 1.0; }
  double largest_overlap() const { return progress_.largest_overlap; }
  double largest_asymmetry() const { return progress_.largest_asymmetry; }
  double bond_steps() const { return progress_.bond_steps; }  ///< sum over steps of intact bonds

  const BondNetwork& network() const { return network_; }
  const DiscState& discs() const { return discs_; }
  DiscState& discs() { return discs_; }  ///< for tests that set velocities and angles before the first step
  const NeighbourList& neighbour_list() const {
    backend_->export_contact_history(neighbour_list_);
    return neighbour_list_;
  }
  const std::vector<results::BreakEvent>& events() const { return events_; }
  std::int64_t intact_bonds() const { return static_cast<std::int64_t>(progress_.intact); }
  std::string simd() const { return backend_->simd(); }
  /// Position of a disc from the block's lower left corner, m; wrapped where the block is periodic.
  std::pair<double, double> position(std::int32_t disc) const;
  /// Call after changing discs() from outside.
  void refresh_records();

  /// Scalars of the run that are not in any array; plain doubles, so that a checkpoint is one dataset.
  struct Progress {
    std::int64_t steps = 0;
    double intact = 0.0;
    double broken_in_layout = 0.0;
    Ledger ledger;  ///< work and dissipation only
    Virial virial, row_sum;
    double row_weight = 0.0;
    double peak_stress = 0.0, peak_strain = 0.0, peak_frozen = 0.0;
    double largest_overlap = 0.0, largest_asymmetry = 0.0;
    double bond_steps = 0.0;
    CellMatrix cell;         ///< H
    double travelled = 0.0;  ///< no disc has moved farther than this since the near pairs were listed, m
    double peak_step = 0.0;  ///< steps at the peak
    LoadingState loading;
  };

  /// For checkpoint.cpp: everything that changes during a run.
  struct Snapshot {
    Progress progress;
    DiscState discs;
    std::vector<double> damage;
    std::vector<std::uint8_t> bond_state;
    NeighbourList::Snapshot neighbour_list;
    Walls::Snapshot walls;
    std::vector<results::BreakEvent> events;
  };
  Snapshot snapshot() const;
  /// Goes on exactly where the snapshot was taken: the same bits as the run that never stopped.
  void restore(Snapshot snapshot);

 private:
  /// Between two centres now, m.
  double distance(std::int32_t i, std::int32_t j) const;
  void move_cell();
  void move_discs();
  void keep_near_pairs();
  void account(const StepSums& sums, const CellMatrix& before);
  void record_breaks();
  void compact_when_due();

  SolverOptions options_;
  Cell cell_;
  LoadingPlan loading_;
  BlockFrame block_;
  CellMatrix now_, before_;
  double time_step_;
  int threads_;
  BondLaw bond_law_;
  ContactLaw contact_law_;
  DiscState discs_;
  std::vector<double> inverse_mass_, inverse_inertia_;
  CundallDamping damping_;
  BondNetwork network_;
  mutable NeighbourList neighbour_list_;  // contact histories come from the backend when somebody asks
  Walls walls_;
  std::unique_ptr<ForceBackend> backend_;
  std::vector<std::int32_t> broken_;
  std::vector<results::BreakEvent> events_;
  std::vector<KickSums> chunk_sums_;
  Progress progress_;
};

}  // namespace perfora::solver
