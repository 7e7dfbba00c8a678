// What is here: HDF5 and folder work of a run (docs/formats.md).
#include "solver/run_files.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <sstream>

#include "geometry/packing_file.h"
#include "io/hdf5.h"
#include "io/journal.h"

namespace perfora::solver {
namespace {

constexpr const char* checkpoint_format = "perfora.checkpoint/4";

/// The configuration without the strain to run to: a stopped run may be resumed to another end.
std::string without_until(const std::string& config) {
  std::istringstream in(config);
  std::string out, line;
  while (std::getline(in, line))
    if (line.rfind("until", 0) != 0) out += line + "\n";
  return out;
}

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
          p.loading.motion};
}

Simulation::Progress unpack(const std::vector<double>& v) {
  Simulation::Progress p;
  p.steps = static_cast<std::int64_t>(v.at(0));
  const std::array<double*, 34> fields = {&p.intact,
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
                                          &p.loading.motion};
  for (std::size_t k = 0; k < fields.size(); ++k) *fields[k] = v.at(k + 1);
  return p;
}

}  // namespace

void write_events(io::Hdf5Writer& file, const std::string& group, const std::vector<BreakEvent>& events) {
  std::vector<double> time, strain, x, y, energy;
  std::vector<std::int32_t> bond, i, j;
  std::vector<std::uint8_t> mode;
  for (const BreakEvent& e : events) {
    time.push_back(e.time);
    strain.push_back(e.strain);
    x.push_back(e.x);
    y.push_back(e.y);
    energy.push_back(e.energy);
    bond.push_back(e.bond);
    i.push_back(e.i);
    j.push_back(e.j);
    mode.push_back(static_cast<std::uint8_t>(e.mode));
  }
  file.group(group);
  file.dataset(group + "/time", time, 0, "s");
  file.dataset(group + "/strain", strain);
  file.dataset(group + "/i", i);
  file.dataset(group + "/j", j);
  file.dataset(group + "/x", x, 0, "m");
  file.dataset(group + "/y", y, 0, "m");
  file.dataset(group + "/mode", mode);
  file.dataset(group + "/energy", energy, 0, "J/m");
  file.dataset(group + "/bond", bond);
}

namespace {

std::vector<BreakEvent> read_events(const io::Hdf5Reader& file, const std::string& group) {
  const auto time = file.doubles(group + "/time"), strain = file.doubles(group + "/strain"),
             x = file.doubles(group + "/x"), y = file.doubles(group + "/y"), energy = file.doubles(group + "/energy");
  const auto bond = file.int32s(group + "/bond"), i = file.int32s(group + "/i"), j = file.int32s(group + "/j");
  const auto mode = file.uint8s(group + "/mode");
  std::vector<BreakEvent> events(time.size());
  for (std::size_t k = 0; k < events.size(); ++k)
    events[k] = {time[k], strain[k], bond[k], i[k], j[k], x[k], y[k], static_cast<BreakMode>(mode[k]), energy[k]};
  return events;
}

void write_history(io::Hdf5Writer& file, const std::string& group, const History& history) {
  for (const History::Column& column : History::columns()) {
    if (column.optional && (history.*column.values).empty()) continue;
    file.dataset(group + "/" + column.name, history.*column.values, 0, column.units);
    if (*column.units == '\0') file.attribute(group + "/" + column.name, "units", std::string("1"));
  }
}

std::vector<std::int32_t> pairs_of(const BondNetwork& network) {
  std::vector<std::int32_t> pairs;
  for (std::size_t b = 0; b < network.i.size(); ++b) {
    pairs.push_back(network.i[b]);
    pairs.push_back(network.j[b]);
  }
  return pairs;
}

/// The state arrays of all discs, by name, for writing and reading alike.
template <class Discs, class Real, class Whole>
void each_field(Discs& d, const Real& real, const Whole& whole) {
  whole("sx", d.sx);
  whole("sy", d.sy);
  whole("turn", d.turn);
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

RunFolder::RunFolder(const std::filesystem::path& run_file) : folder_(run_file) {
  folder_.replace_extension(".part");
}

void RunFolder::start_afresh(const std::string& config) {
  std::filesystem::remove(checkpoint_file());  // first: a folder without it is never taken for a run to go on with
  std::filesystem::remove_all(folder_);
  std::filesystem::create_directories(folder_ / "frames");
  io::write_file(folder_ / "config.toml", config);
}

bool RunFolder::can_resume(const std::string& config) const {
  if (!std::filesystem::exists(checkpoint_file())) return false;
  const std::string found = io::read_file(folder_ / "config.toml");
  if (without_until(found) != without_until(config))
    throw io::InputError(
        {(folder_ / "config.toml").string(), 0, ""}, "the unfinished run there has another configuration",
        "--resume goes on with the same design, seeds and program", "use the same design, or start anew with --force");
  return true;
}

std::filesystem::path RunFolder::frame_file(int number) const {
  return folder_ / "frames" / fmt::format("{:05d}.h5", number);
}

void RunFolder::remove() const {
  std::filesystem::remove_all(folder_);
}

void write_frame_group(io::Hdf5Writer& file, const std::string& group, const FrameData& frame) {
  file.dataset(group + "/discs/position", frame.position, 2, "m");
  file.dataset(group + "/discs/angle", frame.angle, 0, "rad");
  file.dataset(group + "/discs/fragment", frame.fragment);
  file.dataset(group + "/discs/damage", frame.lost);
  file.dataset(group + "/bonds/pairs", frame.bond_pairs, 2);
  file.dataset(group + "/bonds/damage", frame.bond_damage);
  file.attribute(group, "strain", frame.strain);
  file.attribute(group, "time", frame.time);
  file.attribute(group, "h_xx", frame.cell.xx);
  file.attribute(group, "h_xy", frame.cell.xy);
  file.attribute(group, "h_yy", frame.cell.yy);
}

void write_frame(const std::filesystem::path& path, const FrameData& frame) {
  io::Hdf5Writer file(path);
  write_frame_group(file, "/frame", frame);
  file.commit();
}

void write_checkpoint(const std::filesystem::path& path, const Simulation& simulation, const RunProgress& progress) {
  const Simulation::Snapshot s = simulation.snapshot();
  io::Hdf5Writer file(path);
  file.attribute("/", "format", std::string(checkpoint_format));
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
  const NearPairs::Snapshot& near = s.near_pairs;
  file.dataset("/near/start", near.start);
  file.dataset("/near/neighbour", near.neighbour);
  file.dataset("/near/bonded", near.bonded);
  file.dataset("/near/active", near.active);
  file.dataset("/near/touch", near.touch);
  file.dataset("/near/shear", near.shear);
  file.dataset("/near/viscous_force", near.viscous_force);
  file.dataset("/near/reference_x", near.reference_x);
  file.dataset("/near/reference_y", near.reference_y);
  file.dataset("/near/reference_cell",
               std::vector<double>{near.reference_cell.xx, near.reference_cell.xy, near.reference_cell.yy});
  file.attribute("/near", "rebuilds", near.rebuilds);
  write_events(file, "/events", s.events);
  if (!simulation.walls().empty()) {
    file.dataset("/walls/touch", s.walls.touch);
    file.dataset("/walls/shear", s.walls.shear);
    file.dataset("/walls/viscous_force", s.walls.viscous_force);
    file.dataset("/walls/bedded", s.walls.bedded);
    file.dataset("/walls/row", s.walls.row);
  }
  file.group("/history");
  write_history(file, "/history", progress.history);
  file.dataset("/run", std::vector<double>{static_cast<double>(progress.rows), static_cast<double>(progress.frames),
                                           progress.kinetic_ratio, progress.seconds});
  file.commit();
}

RunProgress read_checkpoint(const std::filesystem::path& path, Simulation& simulation) {
  const io::Hdf5Reader file(path);
  if (!file.has_attribute("/", "format") || file.attribute_text("/", "format") != checkpoint_format)
    throw io::InputError({path.string(), 0, "format"}, "this is not a checkpoint this program can read",
                         std::string("allowed is ") + checkpoint_format, "start the run anew with --force");
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
  NearPairs::Snapshot& near = s.near_pairs;
  near.start = file.int32s("/near/start");
  near.neighbour = file.int32s("/near/neighbour");
  near.bonded = file.int32s("/near/bonded");
  near.active = file.int32s("/near/active");
  near.touch = file.doubles("/near/touch");
  near.shear = file.doubles("/near/shear");
  near.viscous_force = file.doubles("/near/viscous_force");
  near.reference_x = file.uint64s("/near/reference_x");
  near.reference_y = file.uint64s("/near/reference_y");
  const auto cell = file.doubles("/near/reference_cell");
  near.reference_cell = {cell.at(0), cell.at(1), cell.at(2)};
  near.rebuilds = file.attribute_int("/near", "rebuilds");
  s.events = read_events(file, "/events");
  if (!simulation.walls().empty()) {
    s.walls.touch = file.doubles("/walls/touch");
    s.walls.shear = file.doubles("/walls/shear");
    s.walls.viscous_force = file.doubles("/walls/viscous_force");
    s.walls.bedded = file.uint8s("/walls/bedded");
    s.walls.row = file.doubles("/walls/row");
  }
  RunProgress progress;
  for (const History::Column& column : History::columns())
    if (!column.optional || file.has(std::string("/history/") + column.name))
      progress.history.*column.values = file.doubles(std::string("/history/") + column.name);
  const auto run = file.doubles("/run");
  progress.rows = static_cast<std::int64_t>(run.at(0));
  progress.frames = static_cast<int>(run.at(1));
  progress.kinetic_ratio = run.at(2);
  progress.seconds = run.at(3);
  simulation.restore(std::move(s));
  return progress;
}

void write_run_file(const RunRequest& request, const Simulation& simulation, const RunFolder& folder,
                    const RunProgress& progress, const Response& response, const std::string& summary) {
  const BondNetwork& network = simulation.network();
  io::Hdf5Writer file(request.run_file);
  file.attribute("/", "format", std::string("perfora.run/1"));
  file.attribute("/", "status", std::string(status_name(response.summary.status)));
  file.attribute("/", "reason", response.summary.reason);
  file.attribute("/", "program_version", request.provenance.program_version);
  file.attribute("/", "git_revision", request.provenance.git_revision);
  file.attribute("/", "compiler", request.provenance.compiler);
  file.attribute("/", "simd", response.performance.simd);
  file.attribute("/", "threads", static_cast<std::int64_t>(response.performance.threads));
  file.attribute("/", "seconds", response.performance.seconds);
  file.attribute("/", "command_line", request.provenance.command_line);
  file.attribute("/", "seeds", request.provenance.seeds_json);
  file.attribute("/", "results_version", static_cast<std::int64_t>(request.provenance.results_version));
  file.attribute("/", "width", request.layout->width);
  file.attribute("/", "height", request.layout->height);
  file.attribute("/", "mean_diameter", request.mean_diameter);
  const BoundaryOptions& boundary = request.options.boundary;
  file.attribute("/", "top_bottom", std::string(boundary.top_bottom == TopBottom::platens ? "platens" : "periodic"));
  file.attribute("/", "sides",
                 std::string(boundary.sides == Sides::periodic ? "periodic"
                             : boundary.sides == Sides::walls  ? "walls"
                                                               : "free"));
  write_history(file, "/history", progress.history);
  file.group("/frames");
  for (int k = 0; k < progress.frames; ++k)
    file.copy_from(folder.frame_file(k), "/frame", fmt::format("/frames/{:05d}", k));
  write_events(file, "/events", simulation.events());
  file.dataset("/bonds/pairs", pairs_of(network), 2);
  file.dataset("/bonds/rest_length", network.rest_length, 0, "m");
  file.dataset("/bonds/strength_factor", network.strength);
  if (request.periodic != nullptr) geometry::write_packing(file, "/packing", *request.periodic);
  geometry::write_packing(file, "/clipped", *request.clipped);
  geometry::write_layout(file, "/layout", *request.layout);
  file.text("/config", request.provenance.config_toml);
  file.text("/summary", summary);
  file.commit();
}

}  // namespace perfora::solver
