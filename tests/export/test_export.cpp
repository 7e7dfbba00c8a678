// What is here: exports of made-up runs held against the frames they were made of. What is not: whether other programs
// open them (tests/viewers), XDMF (test_xdmf.cpp).
#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <cstring>
#include <filesystem>
#include <set>
#include <sstream>

#include "geometry/make_packing.h"
#include "io/csv.h"
#include "io/error.h"
#include "io/files.h"
#include "report/export/registry.h"
#include "tests/results/synthetic_run.h"

namespace perfora::report {
namespace {

namespace fs = std::filesystem;
using results::testing::SyntheticRun;
using ::testing::HasSubstr;
using ::testing::Not;

/// A small run; `forces`: its frames hold what output.frame_data = "all" adds.
SyntheticRun small_run(bool forces = false) {
  SyntheticRun run = results::testing::make_run(0.02, 1, 1e-3, 0.3);
  run.run.provenance.config =
      "[material]\nnormal_stiffness = 2.0e7\ntangential_stiffness = 8e6\ndensity = 2200.0\ngrade = 2.0\n";
  for (auto& frame : run.frames) {
    if (!forces) continue;
    const std::size_t n = frame.angle.size(), m = frame.bond_damage.size();
    frame.velocity.assign(2 * n, 0.25);
    frame.spin.assign(n, 3.0);
    frame.stress.assign(3 * n, -1.5e6);
    frame.bond_normal_force.assign(m, 12.0);
    frame.bond_shear_force.assign(m, -4.0);
    frame.contact_pairs = {0, 1, 1, 2};
    frame.contact_normal_force = {5.0, 6.0};
    frame.contact_shear_force = {0.5, -0.5};
  }
  return run;
}

class Exports : public ::testing::Test {
 protected:
  void prepare(const SyntheticRun& run) {
    // Tests may run at the same time.
    folder_ = results::testing::fresh_folder(std::string("export-") +
                                             ::testing::UnitTest::GetInstance()->current_test_info()->name());
    write_run(run, folder_ / "R.h5");
  }
  std::string text_of(const char* name, const ExportOptions& options = {}) {
    const Scene scene(folder_ / "R.h5", options);
    for (const Export& one : exports())
      if (std::string(one.name) == name) {
        one.write(scene, folder_ / "out.put");
        return io::read_file(folder_ / (std::string("out.put") + one.extension));
      }
    throw std::logic_error(name);
  }
  fs::path folder_;
};

std::size_t count(const std::string& text, const std::string& part) {
  std::size_t found = 0;
  for (std::size_t at = text.find(part); at != std::string::npos; at = text.find(part, at + 1)) ++found;
  return found;
}

TEST_F(Exports, TheListHasDifferentNamesAndFiles) {
  std::set<std::string> names, extensions;
  for (const Export& one : exports()) {
    EXPECT_TRUE(names.insert(one.name).second);
    EXPECT_TRUE(extensions.insert(one.extension).second);
    EXPECT_GT(std::strlen(one.help), 10u);
    for (const std::string& other : one.others) EXPECT_TRUE(extensions.insert(other).second);
  }
}

TEST_F(Exports, EveryExportWritesWhatItSays) {
  prepare(small_run());
  const Scene scene(folder_ / "R.h5", {});
  for (const Export& one : exports()) {
    one.write(scene, folder_ / one.name);
    EXPECT_TRUE(fs::exists(with_extension(folder_ / one.name, one.extension))) << one.name;
    for (const std::string& other : one.others)
      EXPECT_TRUE(fs::exists(with_extension(folder_ / one.name, other))) << one.name << other;
  }
}

TEST_F(Exports, DumpHoldsEveryFrameToTheLastDigit) {
  const SyntheticRun run = small_run();
  prepare(run);
  const std::string text = text_of("lammps-dump");
  EXPECT_EQ(count(text, "ITEM: TIMESTEP"), run.frames.size());
  EXPECT_EQ(count(text, "ITEM: UNITS\nsi\n"), 1u);
  EXPECT_THAT(text, HasSubstr("ITEM: ATOMS id type x y z radius angle fragment damage\n"));
  const results::Frame& last = run.frames.back();
  const std::size_t d = 7;
  EXPECT_THAT(text, HasSubstr(fmt::format("\n8 1 {} {} 0 {} {} {} {}\n", last.position[2 * d], last.position[2 * d + 1],
                                          run.run.clipped.radius[d], last.angle[d], last.fragment[d], last.damage[d])));
  EXPECT_THAT(text, HasSubstr(fmt::format("ITEM: BOX BOUNDS pp pp pp\n0 {}\n0 {}\n", last.info.h_xx, last.info.h_yy)));
}

TEST_F(Exports, AxisOfStrainAndOneFrame) {
  const SyntheticRun run = small_run();
  prepare(run);
  ExportOptions options;
  options.axis = TimeAxis::strain;
  EXPECT_THAT(text_of("lammps-dump", options), HasSubstr("ITEM: TIME\n0.1\nITEM: TIMESTEP\n100000\n"));
  EXPECT_THAT(text_of("vtk", options), HasSubstr("timestep=\"0.1\" part=\"0\" name=\"discs\""));
  EXPECT_THAT(text_of("xdmf", options), HasSubstr("<Time Value=\"0.1\"/>"));
  options.at = 0.12;
  EXPECT_THROW(static_cast<void>(text_of("xdmf", options)), io::InputError);
  const std::string one = text_of("xyz", options);
  EXPECT_EQ(count(one, "Lattice="), 1u);
  EXPECT_THAT(one, HasSubstr("strain=0.1 "));
  options.at = 10.0;
  try {
    static_cast<void>(text_of("xyz", options));
    FAIL() << "a strain that the run never had";
  } catch (const io::InputError& error) {
    EXPECT_THAT(error.what(), HasSubstr("the run ends at 30 % strain"));
    EXPECT_THAT(error.what(), HasSubstr("per cent"));
  }
}

// A bond of stiffness k_n has K = k_n/2 in LAMMPS; grade 2 doubles k_n.
TEST_F(Exports, DataHasATypeABond) {
  const SyntheticRun run = small_run();
  prepare(run);
  const std::string text = text_of("lammps-data");
  const std::size_t bonds = run.run.bonds.size();
  EXPECT_THAT(text, HasSubstr(fmt::format("\n{} atoms\n1 atom types\n{} bonds\n{} bond types\n",
                                          run.run.clipped.x.size(), bonds, bonds)));
  EXPECT_THAT(text, HasSubstr(fmt::format("\n1 20000000 {}\n", run.run.bonds.reference_length[0])));
  EXPECT_THAT(text,
              HasSubstr(fmt::format("\nBonds\n\n1 1 {} {}\n", run.run.bonds.pairs[0] + 1, run.run.bonds.pairs[1] + 1)));
  EXPECT_THAT(text, HasSubstr(fmt::format("\n1 1 {} {} 0 1 {} 2200\n", run.run.clipped.x[0], run.run.clipped.y[0],
                                          2.0 * run.run.clipped.radius[0])));
}

// What is exported can be imported: the discs of a dump and of a data file make the packing they came from.
TEST_F(Exports, LammpsFilesAreReadBack) {
  const SyntheticRun run = small_run();
  prepare(run);
  ExportOptions first;
  first.at = 0.0;
  static_cast<void>(text_of("lammps-dump", first));
  static_cast<void>(text_of("lammps-data"));
  std::vector<double> frame_x;
  for (std::size_t d = 0; d < run.run.clipped.x.size(); ++d) frame_x.push_back(run.frames[0].position[2 * d]);
  for (const auto& [name, x] : {std::pair("out.put.dump", frame_x), std::pair("out.put.data", run.run.clipped.x)}) {
    geometry::PackingOptions options;
    options.file = folder_ / name;
    const geometry::Packing packing = geometry::import_packing(options, run.run.width, run.run.height);
    EXPECT_EQ(packing.x, x) << name;
    ASSERT_EQ(packing.radius.size(), run.run.clipped.radius.size()) << name;
    for (std::size_t d = 0; d < packing.radius.size(); ++d)
      EXPECT_DOUBLE_EQ(packing.radius[d], run.run.clipped.radius[d]) << name;
  }
}

TEST_F(Exports, TablesHaveARowADiscBondAndBreak) {
  const SyntheticRun run = small_run(true);
  prepare(run);
  static_cast<void>(text_of("csv"));
  const auto discs = io::read_csv(folder_ / "out.put.discs.csv",
                                  std::vector<std::string>{"frame", "disc", "x", "stress_yy", "velocity_x"}, 1000000);
  EXPECT_EQ(discs.rows(), run.frames.size() * run.run.clipped.x.size());
  EXPECT_EQ(discs.columns[2][3], run.frames[0].position[6]);
  EXPECT_EQ(discs.columns[3][3], -1.5e6);
  EXPECT_EQ(discs.columns[4][3], 0.25);
  std::size_t bonds = 0;
  for (const auto& frame : run.frames) bonds += frame.bond_damage.size();
  EXPECT_EQ(io::read_csv(folder_ / "out.put.bonds.csv", std::vector<std::string>{"i", "j", "damage", "normal_force"},
                         10000000)
                .rows(),
            bonds);
  const auto contacts =
      io::read_csv(folder_ / "out.put.contacts.csv", std::vector<std::string>{"i", "j", "normal_force"}, 1000);
  EXPECT_EQ(contacts.rows(), 2 * run.frames.size());
  EXPECT_EQ(contacts.columns[2][1], 6.0);
  const auto breaks = io::read_text_table(folder_ / "out.put.breaks.csv");
  EXPECT_EQ(breaks.rows.size(), run.run.events.size());
}

// Forces stand in every format that shows discs; velocities by the names that LAMMPS has for them.
TEST_F(Exports, ForcesAreShownWhereFramesHoldThem) {
  prepare(small_run(true));
  EXPECT_THAT(text_of("lammps-dump"), HasSubstr("damage vx vy spin stress_xx stress_yy stress_xy\n"));
  EXPECT_THAT(text_of("xyz"), HasSubstr(":stress_yy:R:1"));
  const std::string pvd = text_of("vtk");
  EXPECT_THAT(pvd, HasSubstr("name=\"contacts\""));
  const std::string bonds = io::read_file(folder_ / "out.put.vtk/00000-bonds.vtp");
  EXPECT_THAT(bonds, HasSubstr("Name=\"normal_force\""));
  // Velocities as vectors of three, as arrows and magnitudes want them.
  const std::string discs = io::read_file(folder_ / "out.put.vtk/00000-discs.vtp");
  EXPECT_THAT(discs, HasSubstr("Name=\"velocity\" NumberOfComponents=\"3\""));
  EXPECT_THAT(discs, Not(HasSubstr("velocity_x")));
}

TEST_F(Exports, ASecondExportLeavesNoFrameOfTheFirst) {
  prepare(small_run());
  static_cast<void>(text_of("vtk"));
  ExportOptions one;
  one.at = 0.1;
  static_cast<void>(text_of("vtk", one));
  const auto files = std::distance(fs::directory_iterator(folder_ / "out.put.vtk"), fs::directory_iterator());
  EXPECT_EQ(files, 3);
}

TEST_F(Exports, RunsWithoutFramesAndPackingsSayWhatIsMissing) {
  SyntheticRun run = small_run();
  run.frames.clear();
  prepare(run);
  for (const char* name : {"lammps-dump", "vtk", "csv", "xyz", "xdmf"}) {
    try {
      static_cast<void>(text_of(name));
      ADD_FAILURE() << name;
    } catch (const io::InputError& error) {
      EXPECT_THAT(error.what(), HasSubstr("output.frames"));
    }
  }
  EXPECT_NO_THROW(static_cast<void>(text_of("lammps-data"))) << "the start needs no frame";
  write_pack(small_run(), folder_ / "R.h5");
  EXPECT_THAT(text_of("lammps-dump"), HasSubstr("id type x y z radius\n"));
  EXPECT_THROW(static_cast<void>(text_of("xdmf")), io::InputError);
}

}  // namespace
}  // namespace perfora::report
