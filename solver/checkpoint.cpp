// What is here: a checkpoint written and read (docs/user/formats.md). What is not: the state it holds (simulation.h).
#include "solver/checkpoint.h"

#include <array>

#include "io/error.h"
#include "io/hdf5.h"
#include "results/file_parts.h"
#include "results/formats.h"

namespace perfora::solver {
namespace {

/// Scalars of a simulation in one dataset, in this order; a new field goes to the end.
std::vector<double> pack(const Simulation::Progress& p) {
  return {static_cast<double>(p.steps),
          p.intact,
          p.broken_in_layout,
          p.ledger.external_work,
          p.ledger.damage,
          p.ledger.friction,
          p.ledger.viscous,
          p.ledger.cundall,
          p.virial.xx,
          p.virial.xy,
          p.virial.yx,
          p.virial.yy,
          p.row_sum.xx,
          p.row_sum.xy,
          p.row_sum.yx,
          p.row_sum.yy,
          p.row_weight,
          p.peak_stress,
          p.peak_strain,
          p.peak_frozen,
          p.largest_overlap,
          p.largest_asymmetry,
          p.bond_steps,
          p.cell.xx,
          p.cell.xy,
          p.cell.yy,
          p.travelled,
          p.peak_step,
          p.loading.segment,
          p.loading.step,
          p.loading.steps,
          p.loading.rate,
          p.loading.stress_sum,
          p.loading.mean_stress,
          p.loading.motion,
          p.loading.last_begin,
          p.loading.begin,
          p.loading.end,
          p.loading.segment_stress};
}

Simulation::Progress unpack(const std::vector<double>& v) {
  Simulation::Progress p;
  p.steps = static_cast<std::int64_t>(v.at(0));
  const std::array<double*, 38> fields = {&p.intact,
                                          &p.broken_in_layout,
                                          &p.ledger.external_work,
                                          &p.ledger.damage,
                                          &p.ledger.friction,
                                          &p.ledger.viscous,
                                          &p.ledger.cundall,
                                          &p.virial.xx,
                                          &p.virial.xy,
                                          &p.virial.yx,
                                          &p.virial.yy,
                                          &p.row_sum.xx,
                                          &p.row_sum.xy,
                                          &p.row_sum.yx,
                                          &p.row_sum.yy,
                                          &p.row_weight,
                                          &p.peak_stress,
                                          &p.peak_strain,
                                          &p.peak_frozen,
                                          &p.largest_overlap,
                                          &p.largest_asymmetry,
                                          &p.bond_steps,
                                          &p.cell.xx,
                                          &p.cell.xy,
                                          &p.cell.yy,
                                          &p.travelled,
                                          &p.peak_step,
                                          &p.loading.segment,
                                          &p.loading.step,
                                          &p.loading.steps,
                                          &p.loading.rate,
                                          &p.loading.stress_sum,
                                          &p.loading.mean_stress,
                                          &p.loading.motion,
                                          &p.loading.last_begin,
                                          &p.loading.begin,
                                          &p.loading.end,
                                          &p.loading.segment_stress};
  for (std::size_t k = 0; k < fields.size(); ++k) *fields[k] = v.at(k + 1);
  return p;
}

/// The state arrays of all discs, by name, for writing and reading alike.
template <class Discs, class Real, class Whole>
void each_field(Discs& d, const Real& real, const Whole& whole) {
  whole("sx", d.sx);
  whole("sy", d.sy);
  whole("turn", d.half_angle);
  real("vx", d.vx);
  real("vy", d.vy);
  real("omega", d.omega);
  real("fx", d.fx);
  real("fy", d.fy);
  real("torque", d.torque);
  real("radius", d.radius);
  real("mass", d.mass);
  real("inertia", d.inertia);
}

}  // namespace

void write_checkpoint(const std::filesystem::path& path, const Simulation& simulation, const RunProgress& progress) {
  const Simulation::Snapshot s = simulation.snapshot();
  io::Hdf5Writer file(path);
  file.attribute("/", "format", std::string(results::checkpoint_format));
  file.attribute("/", "strain", simulation.strain());
  file.attribute("/", "steps", simulation.steps());
  file.dataset("/progress", pack(s.progress));
  each_field(
      s.discs,
      [&](const char* name, const std::vector<double>& field) { file.dataset(std::string("/discs/") + name, field); },
      [&](const char* name, const std::vector<std::uint64_t>& field) {
        file.dataset(std::string("/discs/") + name, field);
      });
  file.dataset("/bonds/damage", s.damage);
  file.dataset("/bonds/state", s.bond_state);
  const NeighbourList::Snapshot& near = s.neighbour_list;
  file.dataset("/near/start", near.start);
  file.dataset("/near/neighbour", near.neighbour);
  file.dataset("/near/bonded", near.bonded);
  file.dataset("/near/active", near.active);
  file.dataset("/near/touch", near.contact_distance);
  file.dataset("/near/shear", near.shear);
  file.dataset("/near/viscous_force", near.viscous_force);
  file.dataset("/near/reference_x", near.reference_x);
  file.dataset("/near/reference_y", near.reference_y);
  file.dataset("/near/reference_cell",
               std::vector<double>{near.reference_cell.xx, near.reference_cell.xy, near.reference_cell.yy});
  file.attribute("/near", "rebuilds", near.rebuilds);
  results::write_events(file, "/events", s.events);
  if (!simulation.walls().empty()) {
    file.dataset("/walls/touch", s.walls.contact_distance);
    file.dataset("/walls/shear", s.walls.shear);
    file.dataset("/walls/viscous_force", s.walls.viscous_force);
    file.dataset("/walls/bedded", s.walls.has_face_stiffness);
    file.dataset("/walls/row", s.walls.row);
  }
  file.group("/history");
  results::write_history(file, "/history", progress.history);
  const PeakWatch& watch = progress.watch;
  file.dataset("/run",
               std::vector<double>{progress.kinetic_ratio, progress.seconds, watch.work, watch.strain, watch.largest,
                                   watch.largest_at, progress.peak_frame_stress, progress.peak_frame_strain});
  file.dataset("/frame_strains", progress.frame_strains);
  file.commit();
}

RunProgress read_checkpoint(const std::filesystem::path& path, Simulation& simulation) {
  const io::Hdf5Reader file(path);
  if (!file.has_attribute("/", "format") || file.attribute_text("/", "format") != results::checkpoint_format)
    throw io::InputError({path.string(), 0, "format"}, "this is not a checkpoint this program can read",
                         std::string("allowed is ") + results::checkpoint_format, "start the run anew with --force");
  Simulation::Snapshot s;
  s.progress = unpack(file.doubles("/progress"));
  each_field(
      s.discs,
      [&](const char* name, std::vector<double>& field) { field = file.doubles(std::string("/discs/") + name); },
      [&](const char* name, std::vector<std::uint64_t>& field) {
        field = file.uint64s(std::string("/discs/") + name);
      });
  s.damage = file.doubles("/bonds/damage");
  s.bond_state = file.uint8s("/bonds/state");
  if (s.discs.sx.size() != simulation.discs().sx.size() || s.damage.size() != simulation.network().damage.size())
    throw io::InputError({path.string(), 0, ""}, "the checkpoint holds another number of discs or bonds",
                         "a checkpoint goes with the design it was written for", "start the run anew with --force");
  if (s.discs.radius != simulation.discs().radius || s.discs.mass != simulation.discs().mass)
    throw io::InputError({path.string(), 0, ""}, "the checkpoint holds other discs",
                         "a checkpoint goes with the packing it was written for", "start the run anew with --force");
  NeighbourList::Snapshot& near = s.neighbour_list;
  near.start = file.int32s("/near/start");
  near.neighbour = file.int32s("/near/neighbour");
  near.bonded = file.int32s("/near/bonded");
  near.active = file.int32s("/near/active");
  near.contact_distance = file.doubles("/near/touch");
  near.shear = file.doubles("/near/shear");
  near.viscous_force = file.doubles("/near/viscous_force");
  near.reference_x = file.uint64s("/near/reference_x");
  near.reference_y = file.uint64s("/near/reference_y");
  const auto cell = file.doubles("/near/reference_cell");
  near.reference_cell = {cell.at(0), cell.at(1), cell.at(2)};
  near.rebuilds = file.attribute_int("/near", "rebuilds");
  s.events = results::read_events(file, "/events", static_cast<std::int32_t>(s.discs.sx.size()));
  if (!simulation.walls().empty()) {
    s.walls.contact_distance = file.doubles("/walls/touch");
    s.walls.shear = file.doubles("/walls/shear");
    s.walls.viscous_force = file.doubles("/walls/viscous_force");
    s.walls.has_face_stiffness = file.uint8s("/walls/bedded");
    s.walls.row = file.doubles("/walls/row");
  }
  RunProgress progress;
  progress.history = results::read_history(file, "/history");
  const auto run = file.doubles("/run");
  progress.kinetic_ratio = run.at(0);
  progress.seconds = run.at(1);
  progress.watch.work = run.at(2);
  progress.watch.strain = run.at(3);
  progress.watch.largest = run.at(4);
  progress.watch.largest_at = run.at(5);
  progress.peak_frame_stress = run.at(6);
  progress.peak_frame_strain = run.at(7);
  progress.frame_strains = file.doubles("/frame_strains");
  simulation.restore(std::move(s));
  return progress;
}

}  // namespace perfora::solver
