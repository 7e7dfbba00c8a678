// What is here: the one list of the members that decide the path of a run, struct by struct: whoever writes, reads or
// tests a checkpoint visits them. What is not: files (checkpoint.cpp), the check of what was read
// (checkpoint_checks.h).
#pragma once

#include <string_view>

#include "results/history.h"
#include "solver/checkpoint.h"
#include "solver/simulation.h"

namespace perfora::solver {

/// Calls visit(name, member) for each member, with the names as they stand in a comma-separated list.
template <class Visit, class... Members>
void visit_named(Visit& visit, std::string_view names, Members&... members) {
  const auto next = [&names] {
    names.remove_prefix(names.find_first_not_of(", "));
    const std::string_view name = names.substr(0, names.find(','));
    names.remove_prefix(name.size());
    return name;
  };
  (visit(next(), members), ...);
}

/// Visits all members of `value`. One that is added to the struct and not to the list does not compile.
#define PERFORA_VISIT_ALL(visit, value, ...)       \
  do {                                             \
    auto& [__VA_ARGS__] = value;                   \
    visit_named(visit, #__VA_ARGS__, __VA_ARGS__); \
  } while (false)

template <class Visit>
void visit_members(Visit& visit, CellMatrix& cell) {
  PERFORA_VISIT_ALL(visit, cell, xx, xy, yy);
}

template <class Visit>
void visit_members(Visit& visit, Virial& virial) {
  PERFORA_VISIT_ALL(visit, virial, xx, xy, yx, yy);
}

template <class Visit>
void visit_members(Visit& visit, Ledger& ledger) {
  PERFORA_VISIT_ALL(visit, ledger, external_work, damage, friction, viscous, cundall, elastic_bonds, elastic_contacts,
                    kinetic);
}

template <class Visit>
void visit_members(Visit& visit, LoadingState& loading) {
  PERFORA_VISIT_ALL(visit, loading, segment, last_begin, begin, end, step, steps, rate, stress_sum, segment_stress,
                    mean_stress, motion);
}

template <class Visit>
void visit_members(Visit& visit, Simulation::Progress& progress) {
  PERFORA_VISIT_ALL(visit, progress, steps, intact, broken_in_layout, ledger, virial, row_sum, row_weight, peak_stress,
                    peak_strain, peak_frozen, largest_overlap, largest_asymmetry, bond_steps, cell, travelled,
                    peak_step, loading);
}

/// What the next step makes anew is left out: the state before the drift, records and motions, and the shift of
/// positions, which follows from the cell at the start.
template <class Visit>
void visit_members(Visit& visit, DiscState& discs) {
  [[maybe_unused]] auto& [sx, sy, half_angle, sx_before, sy_before, half_angle_before, vx, vy, omega, fx, fy, torque,
                          radius, mass, inertia, record, motion, position_shift] = discs;
  visit_named(visit, "sx, sy, half_angle, vx, vy, omega, fx, fy, torque, radius, mass, inertia", sx, sy, half_angle, vx,
              vy, omega, fx, fy, torque, radius, mass, inertia);
}

template <class Visit>
void visit_members(Visit& visit, NeighbourList::Snapshot& list) {
  PERFORA_VISIT_ALL(visit, list, start, neighbour, bonded, active, contact_distance, shear, viscous_force, reference_x,
                    reference_y, reference_cell, rebuilds);
}

template <class Visit>
void visit_members(Visit& visit, Walls::Snapshot& walls) {
  PERFORA_VISIT_ALL(visit, walls, contact_distance, shear, viscous_force, has_face_stiffness, row);
}

template <class Visit>
void visit_members(Visit& visit, Simulation::Snapshot& snapshot) {
  PERFORA_VISIT_ALL(visit, snapshot, progress, discs, damage, bond_state, neighbour_list, walls, events);
}

template <class Visit>
void visit_members(Visit& visit, results::History& history) {
  for (const results::History::Column& column : results::History::columns())
    visit(std::string_view(column.name), history.*column.values);
}

template <class Visit>
void visit_members(Visit& visit, PeakWatch& watch) {
  PERFORA_VISIT_ALL(visit, watch, work, strain, largest, largest_at, last, last_at);
}

template <class Visit>
void visit_members(Visit& visit, RunProgress& run) {
  PERFORA_VISIT_ALL(visit, run, history, centred_rows, frame_strains, frame_steps, watch, peak_frame_stress,
                    peak_frame_strain, peak_frame_step, kinetic_ratio, seconds);
}

template <class Visit>
void visit_members(Visit& visit, Checkpoint& checkpoint) {
  PERFORA_VISIT_ALL(visit, checkpoint, number, configuration, simulation, run);
}

}  // namespace perfora::solver
