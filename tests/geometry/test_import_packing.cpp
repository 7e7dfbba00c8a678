// What is here: packings from files of LAMMPS and from CSV with units. Expected: the numbers that the files state. What
// is not: CSV in metres (test_packing.cpp), files that perfora wrote (tests/export).
#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include <filesystem>
#include <fstream>
#include <random>

#include "geometry/lammps_file.h"
#include "geometry/make_packing.h"
#include "io/error.h"

namespace perfora::geometry {
namespace {

using ::testing::HasSubstr;

class ImportFiles : public ::testing::Test {
 protected:
  void TearDown() override { std::filesystem::remove(options_.file); }
  Packing read(const std::string& text, double width = 0.010, double height = 0.020) {
    options_.file = std::filesystem::path(testing::TempDir()) / fmt::format("import-{}", ::getpid());
    std::ofstream(options_.file) << text;
    return import_packing(options_, width, height);
  }
  std::string complaint(const std::string& text, double width = 0.010, double height = 0.020) {
    try {
      read(text, width, height);
    } catch (const io::InputError& error) {
      return error.what();
    }
    return "accepted";
  }
  PackingOptions options_;
};

std::string dump(const std::string& bounds, const std::string& columns, const std::string& atoms,
                 const std::string& units = "") {
  return units + "ITEM: TIMESTEP\n0\nITEM: NUMBER OF ATOMS\n2\nITEM: BOX BOUNDS pp pp pp\n" + bounds + "ITEM: ATOMS " +
         columns + "\n" + atoms;
}
const std::string bounds = "-5 5\n0 20\n-0.5 0.5\n";

TEST_F(ImportFiles, DumpInMillimetres) {
  options_.file_unit = "mm";
  const Packing packing = read(dump(bounds, "id type x y z radius", "1 1 -4 2 0 0.5\n2 1 4.5 15 0 0.25\n"));
  ASSERT_EQ(packing.size(), 2);
  EXPECT_NEAR(packing.x[0], 0.001, 1e-12);
  EXPECT_NEAR(packing.x[1], 0.0095, 1e-12);
  EXPECT_NEAR(packing.y[1], 0.015, 1e-12);
  EXPECT_NEAR(packing.radius[1], 0.00025, 1e-15);
  EXPECT_EQ(packing.key.protocol, "imported");
  EXPECT_THAT(packing.key.source, HasSubstr(" mm"));
}

TEST_F(ImportFiles, LastFrameScaledPlacesDiametersAndUnitsOfTheFile) {
  const std::string first = dump(bounds, "id x y z radius", "1 0 1 0 0.5\n2 1 2 0 0.5\n", "ITEM: UNITS\ncgs\n");
  const std::string last = dump("0 1\n0 2\n-0.5 0.5\n", "diameter zs ys xs", "0.1 0.5 0.25 0.5\n0.2 0.5 0.75 0.25\n");
  const Packing packing = read(first + last);
  EXPECT_NEAR(packing.x[0], 0.005, 1e-12);
  EXPECT_NEAR(packing.y[1], 0.015, 1e-12);
  EXPECT_NEAR(packing.radius[1], 0.001, 1e-12);
}

TEST_F(ImportFiles, AnotherPlane) {
  options_.file_unit = "mm";
  options_.file_plane = ImportPlane::xz;
  const Packing packing = read(dump("-5 5\n-1 1\n0 20\n", "id x y z radius", "1 -4 0.1 2 0.5\n2 4.5 0.1 15 0.25\n"));
  EXPECT_NEAR(packing.x[1], 0.0095, 1e-12);
  EXPECT_NEAR(packing.y[1], 0.015, 1e-12);
  options_.file_plane = ImportPlane::xy;
  EXPECT_THAT(complaint(dump("-5 5\n0 20\n-10 10\n", "id x y z radius", "1 -4 2 -5 0.5\n2 4.5 15 5 0.25\n")),
              HasSubstr("the discs lie in no plane: z goes from -5 to 5"));
}

TEST_F(ImportFiles, DumpsThatCannotServe) {
  const std::string atoms = "1 1 -4 2 0 0.5\n2 1 4.5 15 0 0.25\n";
  EXPECT_THAT(complaint(dump(bounds, "id type x y z radius", atoms)),
              HasSubstr("packing.file_unit: the file does not say"));
  options_.file_unit = "mm";
  EXPECT_THAT(complaint(dump(bounds, "id type x y z radius", atoms), 0.011),
              HasSubstr("cell.width: the box of the file is 10 mm along x, the cell 11 mm"));
  EXPECT_THAT(complaint(dump(bounds, "id type x y z q", atoms)), HasSubstr(":9: packing.file: the dump has no sizes"));
  EXPECT_THAT(complaint(dump(bounds, "id type vx vy vz radius", atoms)), HasSubstr("no places"));
  EXPECT_THAT(complaint(dump(bounds, "id type x y z radius", "1 1 -4 2 0 0.5\n")),
              HasSubstr("the file ends where atom 2 of 2"));
  EXPECT_THAT(complaint(dump(bounds, "id type x y z radius", "1 1 -4 2 0 0.5\n2 1 4.5 y 0 0.25\n")),
              HasSubstr(":11: packing.file: \"y\" is no finite number"));
  EXPECT_THAT(complaint(dump(bounds, "id type x y z radius", "1 1 -4 2 0 0.5\n2 1 4.5 15 0 -0.25\n")),
              HasSubstr(":11: packing.file: a disc of this radius"));
}

const std::string data_head =
    "title, units = si\n\n2 atoms\n1 atom types\n\n0 0.010 xlo xhi\n-0.01 0.01 ylo yhi\n-0.5 0.5 zlo zhi\n\n";

TEST_F(ImportFiles, DataOfSpheresAndHybrids) {
  const Packing spheres =
      read(data_head + "Atoms # sphere\n\n1 1 0.001 2200 0.001 -0.009 0 0 0 0\n2 1 0.0005 2200 0.0095 0.005 0\n");
  EXPECT_NEAR(spheres.y[0], 0.001, 1e-12);
  EXPECT_NEAR(spheres.radius[0], 0.0005, 1e-15);
  const Packing bonded = read(
      data_head + "Atoms # hybrid bond sphere\n\n1 1 0.001 -0.009 0 1 0.001 2200\n2 1 0.0095 0.005 0 1 0.0005 2200\n");
  EXPECT_EQ(bonded.x, spheres.x);
  EXPECT_EQ(bonded.radius, spheres.radius);
  EXPECT_THAT(complaint(data_head + "Atoms # atomic\n\n1 1 0 0 0\n"),
              HasSubstr("atoms of style \"atomic\" have no size"));
  EXPECT_THAT(complaint(data_head + "Atoms\n\n1 1 0 0 0\n"),
              HasSubstr(":10: packing.file: the section does not say its style"));
  EXPECT_THAT(complaint(data_head), HasSubstr("no section Atoms"));
}

TEST_F(ImportFiles, CsvWithUnitsDiametersAndAPlane) {
  const Packing packing = read("x [mm],y [mm],diameter [um]\n1,2,500\n5,15,1000\n");
  EXPECT_NEAR(packing.x[1], 0.005, 1e-15);
  EXPECT_NEAR(packing.radius[0], 0.00025, 1e-15);
  options_.file_unit = "mm";
  EXPECT_THAT(complaint("x [mm],y [mm],radius [mm]\n1,2,0.5\n5,15,1\n"), HasSubstr("names units already"));
  options_.file_plane = ImportPlane::yz;
  const Packing other = read("x,y,z,radius\n9,1,2,0.25\n9,5,15,0.5\n");
  EXPECT_EQ(other.x, packing.x);
  EXPECT_EQ(other.radius, packing.radius);
}

TEST_F(ImportFiles, ColumnsWithoutNamesAreTold) {
  options_.file_unit = "mm";
  options_.file_plane = ImportPlane::xz;
  read("1, 2, 0.5\n4, 15, 0.25\n");
  EXPECT_THAT(import_note(options_), HasSubstr("has no header: its columns are taken for x, z and radius in mm"));
  read("x, z, radius\n1, 2, 0.5\n4, 15, 0.25\n");
  EXPECT_EQ(import_note(options_), "");
  options_.file_plane = ImportPlane::xy;
  read(dump(bounds, "id type x y z radius", "1 1 -4 2 0 0.5\n2 1 4.5 15 0 0.25\n"));
  EXPECT_EQ(import_note(options_), "");
}

TEST_F(ImportFiles, TheLastFrameOfARunIsCompressed) {
  options_.file_unit = "mm";
  const std::string last = dump("-5 5\n0 12\n-0.5 0.5\n", "id x y z radius", "1 -4 2 0 0.5\n2 4.5 11 0 0.25\n");
  EXPECT_THAT(complaint(last), HasSubstr("--at 0"));
}

// Every beginning, and bytes changed at random, of good files: taken or refused.
TEST_F(ImportFiles, BrokenFilesAreRefusedOrTaken) {
  const std::string good_dump =
      dump(bounds, "id type x y z radius", "1 1 -4 2 0 0.5\n2 1 4.5 15 0 0.25\n", "ITEM: UNITS\nsi\n");
  const std::string good_data =
      data_head + "Atoms # hybrid bond sphere\n\n1 1 0.001 0 0 1 0.001 2200\n2 1 0.0095 0.005 0 1 0.0005 2200\n";
  std::mt19937_64 random(3);
  for (const auto& [reader, good] :
       {std::pair(&read_lammps_dump, good_dump), std::pair(&read_lammps_data, good_data)}) {
    const auto expect = [&, read_one = reader](const std::string& text) {
      try {
        static_cast<void>(read_one(text, "file", 1000));
      } catch (const io::InputError& error) {
        EXPECT_EQ(std::string(error.what()).find('\n'), std::string::npos);
      }
    };
    for (std::size_t end = 0; end <= good.size(); ++end) expect(good.substr(0, end));
    for (int k = 0; k < 5000; ++k) {
      std::string bad = good;
      for (int change = 0; change < 1 + k % 4 && !bad.empty(); ++change) {
        const std::size_t at = random() % bad.size();
        if (k % 2 == 0)
          bad[at] = static_cast<char>(random());
        else
          bad.erase(at, 1 + random() % 9);
      }
      expect(bad);
    }
  }
}

}  // namespace
}  // namespace perfora::geometry
