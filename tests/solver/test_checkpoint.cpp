// What is here: a checkpoint holds every member that decides the path of a run, and one whose content does not belong
// together is refused before it is used. What is not: whole runs that go on from one (test_resume.cpp), the checksum of
// a file (tests/io). Expected values: the state that was written.
#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <functional>
#include <limits>
#include <map>
#include <utility>

#include "bounded_block.h"
#include "io/hdf5.h"
#include "solver/checkpoint.h"
#include "solver/checkpoint_members.h"
#include "solver/samples.h"
#include "tests/io/io_support.h"

namespace perfora::solver {
namespace {

using io::input_error;
using io::TemporaryFolder;
using ::testing::HasSubstr;

constexpr double pitch = 0.5e-3;

/// A block between platens and walls in the middle of a run: bonds broken, contacts closed, a row half summed.
class CheckpointTest : public testing::Test {
 protected:
  CheckpointTest() : packing(test::jittered_packing(10, pitch, 5)) {
    options = test::with_edges(TopBottom::platens, Sides::walls);
    options.boundary.wall_friction = 0.3;
  }

  Simulation fresh() const { return test::make_bounded(packing, options, pitch, 200.0); }

  static RunProgress some_progress(const Simulation& simulation) {
    RunProgress run;
    for (const results::History::Column& column : results::History::columns()) run.history.*column.values = {0.0, 1e-3};
    run.centred_rows = 1;
    run.frame_strains = {0.0, 1e-3};
    run.frame_steps = {0, 5};
    run.peak_frame_step = simulation.steps() - 1;
    run.watch.last_at = 1e-3;
    return run;
  }

  static Checkpoint taken(const Simulation& simulation) {
    return {3, "# of a test\n", simulation.snapshot(), some_progress(simulation)};
  }

  static Simulation& run_on(Simulation& simulation, int steps) {
    for (int k = 0; k < steps; ++k) simulation.step();
    return simulation;
  }

  const TemporaryFolder folder;
  const geometry::Packing packing;
  SolverOptions options;
};

/// Visits all members; changes the numbered one a little, in a way that no check refuses.
class Changing {
 public:
  explicit Changing(int which) : which_(which) {}
  bool changed() const { return !path_.empty(); }
  const std::string& path() const { return path_; }

  template <class Value>
  void operator()(std::string_view name, Value& value) {
    const std::string path = prefix_ + "/" + std::string(name);
    if constexpr (requires { visit_members(*this, value); }) {
      const std::string before = std::exchange(prefix_, path);
      visit_members(*this, value);
      prefix_ = before;
    } else if (count_++ == which_ && change(path, value)) {
      path_ = path;
    }
  }

 private:
  static bool change(const std::string& path, double& value) {
    if (path.ends_with("peak_frozen")) return value = 1.0 - value, true;
    if (path.ends_with("peak_step")) return value += 1.0, true;
    if (path.ends_with("loading/steps")) return value = 8.0, true;
    if (path.ends_with("loading/segment")) return value = 7.0, true;
    value = value == 0.0 ? 1e-4 : value * 1.0009765625;
    return true;
  }
  static bool change(const std::string&, std::int64_t& value) { return --value, true; }
  static bool change(const std::string&, std::string& value) { return value += "x", true; }
  static bool change(const std::string&, std::vector<double>& values) {
    // The last: lists that rise go on rising.
    double& value = values.at(values.size() - 1);
    return value = value == 0.0 ? 1e-4 : value * 1.0009765625, true;
  }
  template <class Whole>
  static bool change(const std::string&, std::vector<Whole>& values) {
    return values.at(values.size() - 1) ^= 1, true;
  }
  static bool change(const std::string&, std::vector<results::BreakEvent>& events) {
    return events.at(0).time *= 2.0, true;
  }

  int which_, count_ = 0;
  std::string prefix_, path_;
};

/// All members as text, to the last bit: what two states differ in.
class Listing {
 public:
  template <class Value>
  void operator()(std::string_view name, Value& value) {
    const std::string path = prefix_ + "/" + std::string(name);
    if constexpr (requires { visit_members(*this, value); }) {
      const std::string before = std::exchange(prefix_, path);
      visit_members(*this, value);
      prefix_ = before;
    } else {
      text[path] = written_out(value);
    }
  }
  std::map<std::string, std::string> text;

 private:
  template <class Value>
  static std::string written_out(const Value& value) {
    return fmt::format("{}", value);
  }
  template <class Element>
  static std::string written_out(const std::vector<Element>& values) {
    return fmt::format("{}", fmt::join(values, " "));
  }
  static std::string written_out(const std::vector<results::BreakEvent>& events) {
    std::string all;
    for (const results::BreakEvent& e : events)
      all += fmt::format("{} {} {} {} {} {} {} {} {}\n", e.time, e.strain, e.bond, e.i, e.j, e.x, e.y,
                         static_cast<int>(e.mode), e.energy);
    return all;
  }
  std::string prefix_;
};

template <class Value>
std::map<std::string, std::string> listing(Value value) {
  Listing list;
  visit_members(list, value);
  return list.text;
}

template <class Value>
std::vector<std::string> differences(const Value& a, const Value& b) {
  std::vector<std::string> names;
  const auto first = listing(a), second = listing(b);
  for (const auto& [name, text] : first)
    if (second.at(name) != text) names.push_back(name);
  return names;
}

TEST_F(CheckpointTest, HoldsEveryMember) {
  Simulation simulation = fresh();
  run_on(simulation, 700).reset_row();
  run_on(simulation, 50);
  ASSERT_GT(simulation.events().size(), 20u);
  const Checkpoint straight = taken(simulation);
  int members = 0;
  for (;; ++members) {
    Checkpoint changed = straight;
    Changing changing(members);
    visit_members(changing, changed);
    if (!changing.changed()) break;
    const std::string name = changing.path();
    SCOPED_TRACE(name);
    // Members that a check ties to others, changed alone, are refused: those are seen as well.
    try {
      write_checkpoint(folder / "c.h5", changed);
      const Checkpoint read = read_checkpoint(folder / "c.h5", simulation);
      if (!name.ends_with("/events")) {
        EXPECT_THAT(differences(straight, read), testing::ElementsAre(name));
      }
      EXPECT_EQ(listing(read), listing(changed));
      Simulation restored = fresh();
      restored.restore(read.simulation);
      EXPECT_THAT(differences(restored.snapshot(), read.simulation), testing::IsEmpty());
    } catch (const io::InputError& error) {
      const std::string tied = name.ends_with("bonded") ? "active" : name.substr(name.rfind('/') + 1);
      EXPECT_THAT(error.origin().key, HasSubstr(tied));
    }
  }
  EXPECT_GT(members, 100);
}

/// Members that are added to these classes are seen here. What decides the path of a run goes into the snapshot (and
/// with it into the checkpoint); then the size below is that of the class as it is now.
TEST(CheckpointMembers, NoneIsAddedUnseen) {
  constexpr std::size_t of_vector = sizeof(std::vector<double>);
  EXPECT_EQ(sizeof(results::History), results::History::columns().size() * of_vector) << "History::columns()";
  const results::BreakEvent event;
  [[maybe_unused]] const auto& [time, strain, bond, i, j, x, y, mode, energy] =
      event;  // results::write_events and read_events
  EXPECT_EQ(sizeof(BondNetwork), 8 * of_vector) << "damage and state change, the others do not";
#if defined(__GLIBCXX__) && defined(__x86_64__) && !defined(_GLIBCXX_DEBUG)
  EXPECT_EQ(sizeof(Simulation), 2552u);
  EXPECT_EQ(sizeof(NeighbourList), 368u);
  EXPECT_EQ(sizeof(Walls), 280u);
  EXPECT_EQ(sizeof(CundallDamping), 56u) << "follows from the network alone";
  EXPECT_EQ(sizeof(Samples), 128u) << "follows from the history and centred_rows";
#endif
}

/// What a checkpoint of that content is refused with.
TEST_F(CheckpointTest, ContentThatDoesNotBelongTogetherIsRefused) {
  Simulation simulation = fresh();
  run_on(simulation, 700);
  const Checkpoint straight = taken(simulation);
  const double nan = std::numeric_limits<double>::quiet_NaN();
  struct Case {
    const char* names;
    std::function<void(Checkpoint&)> spoil;
  };
  const auto list = [](Checkpoint& c) -> NeighbourList::Snapshot& { return c.simulation.neighbour_list; };
  const std::vector<Case> cases = {
      {"/simulation/discs/sx", [](Checkpoint& c) { c.simulation.discs.sx.pop_back(); }},
      {"/simulation/discs/vx", [](Checkpoint& c) { c.simulation.discs.vx.push_back(0.0); }},
      {"/simulation/discs/fy", [&](Checkpoint& c) { c.simulation.discs.fy[3] = nan; }},
      {"/simulation/discs/omega", [](Checkpoint& c) { c.simulation.discs.omega[3] = 1e300; }},
      {"/simulation/discs/radius", [](Checkpoint& c) { c.simulation.discs.radius[0] *= 2.0; }},
      {"/simulation/discs/inertia", [](Checkpoint& c) { c.simulation.discs.inertia.clear(); }},
      {"/simulation/damage", [](Checkpoint& c) { c.simulation.damage.resize(3); }},
      {"/simulation/damage", [](Checkpoint& c) { c.simulation.damage[1] = 1.5; }},
      {"/simulation/bond_state", [](Checkpoint& c) { c.simulation.bond_state.push_back(0); }},
      {"/simulation/bond_state", [](Checkpoint& c) { c.simulation.bond_state[0] = 77; }},
      {"/simulation/bond_state", [](Checkpoint& c) { c.simulation.events.pop_back(); }},
      {"/simulation/events/bond", [](Checkpoint& c) { c.simulation.events[0].bond = 1 << 30; }},
      {"/simulation/events/bond", [](Checkpoint& c) { c.simulation.events[0].bond = -1; }},
      {"/simulation/events/i", [](Checkpoint& c) { c.simulation.events[0].i = 1 << 30; }},
      {"/simulation/events/bond", [](Checkpoint& c) { c.simulation.events.push_back(c.simulation.events[0]); }},
      {"/simulation/progress/intact", [](Checkpoint& c) { c.simulation.progress.intact -= 1.0; }},
      {"/simulation/progress", [&](Checkpoint& c) { c.simulation.progress.travelled = nan; }},
      {"/simulation/progress/loading", [](Checkpoint& c) { c.simulation.progress.loading.steps = 2.5; }},
      {"/simulation/progress/loading", [](Checkpoint& c) { c.simulation.progress.loading.step = 1.0; }},
      {"/simulation/progress/cell", [](Checkpoint& c) { c.simulation.progress.cell.yy = 0.0; }},
      {"/simulation/neighbour_list/start", [&](Checkpoint& c) { list(c).start.pop_back(); }},
      {"/simulation/neighbour_list/start", [&](Checkpoint& c) { list(c).start.back() += 100000; }},
      {"/simulation/neighbour_list/start", [&](Checkpoint& c) { list(c).start[4] = 1 << 30; }},
      {"/simulation/neighbour_list/start", [&](Checkpoint& c) { list(c).start[4] = -5; }},
      {"/simulation/neighbour_list/neighbour", [&](Checkpoint& c) { list(c).neighbour[2] = 1 << 30; }},
      {"/simulation/neighbour_list/neighbour", [&](Checkpoint& c) { list(c).neighbour[2] = -1; }},
      {"/simulation/neighbour_list/bonded", [&](Checkpoint& c) { list(c).bonded[2] = 2; }},
      {"/simulation/neighbour_list/bonded", [&](Checkpoint& c) { list(c).bonded.pop_back(); }},
      {"/simulation/neighbour_list/active", [&](Checkpoint& c) { list(c).active[2] += 1; }},
      {"/simulation/neighbour_list/shear", [&](Checkpoint& c) { list(c).shear.resize(1); }},
      {"/simulation/neighbour_list/contact_distance", [&](Checkpoint& c) { list(c).contact_distance.clear(); }},
      {"/simulation/neighbour_list/reference_x", [&](Checkpoint& c) { list(c).reference_x.push_back(1); }},
      {"/simulation/neighbour_list/reference_cell", [&](Checkpoint& c) { list(c).reference_cell.yy = -1.0; }},
      {"/simulation/walls/shear", [](Checkpoint& c) { c.simulation.walls.shear.pop_back(); }},
      {"/simulation/walls/row", [](Checkpoint& c) { c.simulation.walls.row.resize(4); }},
      {"/simulation/walls/has_face_stiffness", [](Checkpoint& c) { c.simulation.walls.has_face_stiffness[0] = 9; }},
      {"/run/history/stress_yy", [](Checkpoint& c) { c.run.history.stress_yy.pop_back(); }},
      {"/run/history/wall_stress_left", [](Checkpoint& c) { c.run.history.wall_stress_left.clear(); }},
      {"/run/history/strain_yy",
       [](Checkpoint& c) {
         c.run.history.strain_yy = {0.5, 0.1};
       }},
      {"/run/centred_rows", [](Checkpoint& c) { c.run.centred_rows = 3; }},
      {"/run/frame_steps", [](Checkpoint& c) { c.run.frame_steps = {0}; }},
      {"/run/frame_steps",
       [](Checkpoint& c) {
         c.run.frame_steps = {5, 5};
       }},
      {"/run/peak_frame_step", [](Checkpoint& c) { c.run.peak_frame_step = std::int64_t{1} << 60; }},
  };
  for (const Case& one : cases) {
    SCOPED_TRACE(one.names);
    Checkpoint spoilt = straight;
    one.spoil(spoilt);
    write_checkpoint(folder / "c.h5", spoilt);
    EXPECT_THAT(input_error([&] { (void)read_checkpoint(folder / "c.h5", simulation); }),
                testing::AllOf(HasSubstr("c.h5"), HasSubstr(one.names)));
  }
  write_checkpoint(folder / "c.h5", straight);
  EXPECT_EQ(listing(read_checkpoint(folder / "c.h5", simulation)), listing(straight));
}

TEST_F(CheckpointTest, AnotherFormatOrAnotherDesignIsRefused) {
  Simulation simulation = fresh();
  io::Hdf5Writer file(folder / "old.h5");
  file.attribute("/", "format", std::string("perfora.checkpoint/4"));
  file.commit();
  EXPECT_THAT(input_error([&] { (void)read_checkpoint(folder / "old.h5", simulation); }),
              HasSubstr("not a checkpoint that this version of perfora can read"));
  write_checkpoint(folder / "c.h5", taken(run_on(simulation, 10)));
  const geometry::Packing larger = test::jittered_packing(11, pitch, 5);
  const Simulation other = test::make_bounded(larger, options, pitch, 200.0);
  EXPECT_THAT(input_error([&] { (void)read_checkpoint(folder / "c.h5", other); }), HasSubstr("/simulation/discs/sx"));
}

}  // namespace
}  // namespace perfora::solver
