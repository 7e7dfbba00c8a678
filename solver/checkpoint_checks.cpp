// What is here: the checks of a checkpoint's content, group by group. What is not: its file (checkpoint.cpp).
#include "solver/checkpoint_checks.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "io/error.h"
#include "solver/checkpoint_members.h"
#include "solver/index.h"

namespace perfora::solver {
namespace {

/// Refuses with the place of what is wrong.
class Place {
 public:
  Place(const std::filesystem::path& path, std::string group) : path_(path), group_(std::move(group)) {}
  Place inside(std::string_view name) const { return {path_, group_ + "/" + std::string(name)}; }

  [[noreturn]] void refuse(std::string_view name, const std::string& problem, const std::string& allowed = {}) const {
    throw io::InputError({path_.string(), 0, group_ + "/" + std::string(name)}, problem, allowed);
  }
  void require(bool sound, std::string_view name, const std::string& problem, const std::string& allowed = {}) const {
    if (!sound) refuse(name, problem, allowed);
  }
  template <class Element>
  void require_size(std::string_view name, const std::vector<Element>& values, std::size_t wanted) const {
    require(values.size() == wanted, name, fmt::format("has {} numbers where {} belong", values.size(), wanted));
  }
  template <class Element>
  void require_range(std::string_view name, const std::vector<Element>& values, Element least, Element most) const {
    for (const Element value : values)
      require(value >= least && value <= most, name, fmt::format("holds {}", value),
              fmt::format("{} to {}", least, most));
  }
  void require_range(std::string_view name, double value, double least, double most) const {
    require(value >= least && value <= most, name, fmt::format("is {}", value), fmt::format("{} to {}", least, most));
  }
  void require_whole(std::string_view name, double value, double most) const {
    require(value >= 0.0 && value <= most && value == std::floor(value), name, fmt::format("is {}", value),
            fmt::format("a whole number from 0 to {}", most));
  }

 private:
  const std::filesystem::path& path_;
  std::string group_;
};

/// More than any quantity of a run in SI; a float holds it.
constexpr double largest_number = 1e38;

/// Visits a checkpoint: all its doubles are numbers that a state can hold.
class Finite {
 public:
  explicit Finite(Place place) : place_(std::move(place)) {}

  template <class Value>
  void operator()(std::string_view name, Value& value) {
    if constexpr (std::is_same_v<Value, double>) {
      place_.require(std::fabs(value) <= largest_number, name, fmt::format("is {}", value), "a finite number");
    } else if constexpr (std::is_same_v<Value, std::vector<double>>) {
      for (const double one : value)
        place_.require(std::fabs(one) <= largest_number, name, fmt::format("holds {}", one), "finite numbers");
    } else if constexpr (requires { visit_members(*this, value); }) {
      Finite inner(place_.inside(name));
      visit_members(inner, value);
    }
  }

 private:
  Place place_;
};

void check_discs(const Place& place, const DiscState& found, const DiscState& wanted) {
  const std::size_t n = wanted.sx.size();
  for (const auto& [name, field] :
       {std::pair("sx", &found.sx), std::pair("sy", &found.sy), std::pair("half_angle", &found.half_angle)})
    place.require_size(name, *field, n);
  for (const auto& [name, field] :
       {std::pair("vx", &found.vx), std::pair("vy", &found.vy), std::pair("omega", &found.omega),
        std::pair("fx", &found.fx), std::pair("fy", &found.fy), std::pair("torque", &found.torque)})
    place.require_size(name, *field, n);
  const std::string other = "is that of other discs: a checkpoint goes with the packing it was written for";
  place.require(found.radius == wanted.radius, "radius", other);
  place.require(found.mass == wanted.mass, "mass", other);
  place.require(found.inertia == wanted.inertia, "inertia", other);
}

void check_bonds(const Place& place, const Simulation::Snapshot& s, const BondNetwork& network) {
  const std::size_t bonds = at(network.size());
  place.require_size("damage", s.damage, bonds);
  place.require_range("damage", s.damage, 0.0, 1.0);
  place.require_size("bond_state", s.bond_state, bonds);
  place.require_range("bond_state", s.bond_state, std::uint8_t{0}, static_cast<std::uint8_t>(BondState::compacted));
  std::vector<std::uint8_t> broke(bonds, 0);
  for (const results::BreakEvent& event : s.events) {
    place.require(event.bond >= 0 && at(event.bond) < bonds, "events/bond", fmt::format("names bond {}", event.bond),
                  fmt::format("0 to {}", network.size() - 1));
    const std::size_t b = at(event.bond);
    place.require(event.i == network.i[b] && event.j == network.j[b], "events/i",
                  fmt::format("gives bond {} other discs than the design does", event.bond));
    place.require(event.mode == results::BreakMode::tension || event.mode == results::BreakMode::shear, "events/mode",
                  fmt::format("holds {}", static_cast<int>(event.mode)), "0 or 1");
    place.require(broke[b] == 0, "events/bond", fmt::format("breaks bond {} twice", event.bond));
    broke[b] = 1;
  }
  std::size_t intact = 0, in_layout = 0;
  for (std::size_t b = 0; b < bonds; ++b) {
    const auto state = static_cast<BondState>(s.bond_state[b]);
    place.require((state != BondState::intact) == (broke[b] != 0), "bond_state",
                  fmt::format("and the events disagree on whether bond {} broke", b));
    intact += state == BondState::intact ? 1 : 0;
    in_layout += state == BondState::broken ? 1 : 0;
  }
  place.require(s.progress.intact == static_cast<double>(intact), "progress/intact",
                fmt::format("is {} where {} bonds are intact", s.progress.intact, intact));
  place.require(
      s.progress.broken_in_layout == static_cast<double>(in_layout), "progress/broken_in_layout",
      fmt::format("is {} where {} bonds are broken and not compacted", s.progress.broken_in_layout, in_layout));
}

void check_near_pairs(const Place& place, const NeighbourList::Snapshot& near, std::int32_t discs) {
  const std::size_t n = at(discs), slots = near.neighbour.size();
  place.require_size("start", near.start, n + 1);
  place.require_size("active", near.active, n);
  place.require_size("bonded", near.bonded, slots);
  for (const auto& [name, field] : {std::pair("contact_distance", &near.contact_distance),
                                    std::pair("shear", &near.shear), std::pair("viscous_force", &near.viscous_force)})
    place.require_size(name, *field, slots);
  place.require_size("reference_x", near.reference_x, n);
  place.require_size("reference_y", near.reference_y, n);
  place.require_range("bonded", near.bonded, 0, 1);
  place.require(near.start.front() == 0 && at(near.start.back()) == slots && near.start.back() >= 0, "start",
                fmt::format("goes from {} to {}", near.start.front(), near.start.back()),
                fmt::format("0 to {}, the number of near pairs", slots));
  for (std::size_t i = 0; i < n; ++i) {
    const std::int32_t begin = near.start[i], end = near.start[i + 1];
    place.require(begin <= end && at(end) <= slots, "start", fmt::format("does not rise at disc {}", i));
    std::int32_t before = -1, open = 0;
    for (std::int32_t k = begin; k < end; ++k) {
      const std::int32_t j = near.neighbour[at(k)];
      place.require(j > before && j < discs && at(j) != i, "neighbour",
                    fmt::format("holds {} after {} in the row of disc {}", j, before, i),
                    fmt::format("other discs, 0 to {}, rising", discs - 1));
      before = j;
      open += near.bonded[at(k)] == 0 ? 1 : 0;
    }
    place.require(near.active[i] == open, "active",
                  fmt::format("is {} for disc {}, which has {} pairs without a bond", near.active[i], i, open));
  }
  place.require(near.reference_cell.xx > 0.0 && near.reference_cell.yy > 0.0, "reference_cell",
                fmt::format("is {} x {} m", near.reference_cell.xx, near.reference_cell.yy), "a positive size");
  place.require(near.rebuilds >= 0, "rebuilds", fmt::format("is {}", near.rebuilds), "0 or more");
}

void check_walls(const Place& place, const Walls::Snapshot& found, const Simulation& simulation) {
  const Walls::Snapshot wanted = simulation.walls().snapshot();
  for (const auto& [name, field] : {std::pair("contact_distance", &found.contact_distance),
                                    std::pair("shear", &found.shear), std::pair("viscous_force", &found.viscous_force)})
    place.require_size(name, *field, wanted.contact_distance.size());
  place.require_size("has_face_stiffness", found.has_face_stiffness, wanted.has_face_stiffness.size());
  place.require_range("has_face_stiffness", found.has_face_stiffness, std::uint8_t{0}, std::uint8_t{1});
  place.require_size("row", found.row, wanted.row.size());
}

void check_progress(const Place& place, const Simulation::Progress& p) {
  constexpr double largest_count = 0x1p53;  // doubles hold whole numbers up to it
  const auto steps = static_cast<double>(p.steps);
  place.require_range("steps", steps, 0.0, largest_count);
  place.require(p.cell.xx > 0.0 && p.cell.yy > 0.0, "cell", fmt::format("is {} x {} m", p.cell.xx, p.cell.yy),
                "a positive size");
  place.require(p.peak_frozen == 0.0 || p.peak_frozen == 1.0, "peak_frozen", fmt::format("is {}", p.peak_frozen),
                "0 or 1");
  place.require_whole("peak_step", p.peak_step, steps);
  place.require(p.travelled >= 0.0, "travelled", fmt::format("is {} m", p.travelled), "0 or more");
  place.require(p.row_weight >= 0.0, "row_weight", fmt::format("is {}", p.row_weight), "0 or more");
  const Place loading = place.inside("loading");
  const LoadingState& l = p.loading;
  loading.require_whole("segment", l.segment, largest_count);
  loading.require_whole("steps", l.steps, largest_count);
  loading.require_whole("step", l.step, l.steps);
  loading.require(l.steps == 0.0 || l.step < l.steps, "step", fmt::format("is {} of {}", l.step, l.steps),
                  "less than the steps of the segment, which ends with its last one");
  loading.require_range("end", l.end, 0.0, largest_run_strain * (1.0 + results::strain_rounding));
  loading.require_range("begin", l.begin, 0.0, l.end);
  loading.require_range("last_begin", l.last_begin, 0.0, l.begin);
  loading.require(l.rate >= 0.0, "rate", fmt::format("is {} 1/s", l.rate), "0 or more");
}

/// Columns of walls stand in a history exactly where the simulation has such walls.
bool has_column(const results::History::Column& column, const results::History& history, const Walls& walls) {
  const results::History* const h = &history;
  const auto is = [&](const std::vector<double>& one) { return &(h->*column.values) == &one; };
  const auto stands = [&](WallSide side) {
    return std::any_of(walls.places().begin(), walls.places().end(),
                       [side](const WallPlace& place) { return place.edge && place.side == side; });
  };
  if (is(h->platen_stress_bottom)) return stands(WallSide::bottom);
  if (is(h->platen_stress_top)) return stands(WallSide::top);
  if (is(h->wall_stress_left)) return stands(WallSide::left);
  if (is(h->wall_stress_right)) return stands(WallSide::right);
  return true;
}

void check_run(const Place& place, const RunProgress& run, const Simulation& simulation, double steps) {
  const Place rows = place.inside("history");
  const std::size_t count = run.history.rows();
  for (const results::History::Column& column : results::History::columns())
    rows.require_size(column.name, run.history.*column.values,
                      has_column(column, run.history, simulation.walls()) ? count : 0);
  rows.require(std::is_sorted(run.history.strain_yy.begin(), run.history.strain_yy.end()), "strain_yy",
               "does not rise");
  place.require_range("centred_rows", static_cast<double>(run.centred_rows), 0.0, static_cast<double>(count));
  place.require_size("frame_steps", run.frame_steps, run.frame_strains.size());
  place.require(std::is_sorted(run.frame_strains.begin(), run.frame_strains.end()), "frame_strains", "does not rise");
  place.require(std::adjacent_find(run.frame_steps.begin(), run.frame_steps.end(), std::greater_equal<>()) ==
                    run.frame_steps.end(),
                "frame_steps", "does not rise");
  for (const std::int64_t step : run.frame_steps)
    place.require_range("frame_steps", static_cast<double>(step), 0.0, steps);
  place.require_range("peak_frame_step", static_cast<double>(run.peak_frame_step), 0.0, steps);
  place.require(run.seconds >= 0.0, "seconds", fmt::format("is {}", run.seconds), "0 or more");
  place.require(run.watch.strain >= 0.0, "watch/strain", fmt::format("is {}", run.watch.strain), "0 or more");
}

}  // namespace

void require_sound(const std::filesystem::path& path, Checkpoint& checkpoint, const Simulation& simulation) {
  const Place file(path, "");
  file.require(checkpoint.number >= 0, "number", fmt::format("is {}", checkpoint.number), "0 or more");
  Finite finite(file);
  visit_members(finite, checkpoint);
  const Simulation::Snapshot& s = checkpoint.simulation;
  const Place place = file.inside("simulation");
  check_progress(place.inside("progress"), s.progress);
  check_discs(place.inside("discs"), s.discs, simulation.discs());
  check_bonds(place, s, simulation.network());
  check_near_pairs(place.inside("neighbour_list"), s.neighbour_list, simulation.discs().size());
  check_walls(place.inside("walls"), s.walls, simulation);
  check_run(file.inside("run"), checkpoint.run, simulation, static_cast<double>(s.progress.steps));
}

}  // namespace perfora::solver
