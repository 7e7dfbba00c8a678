// What is here: packings and layouts written and read again, and keys that disagree.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <functional>

#include "geometry/make_packing.h"
#include "geometry/make_shape.h"
#include "geometry/packing_file.h"
#include "io/error.h"

namespace perfora::geometry {
namespace {

class PackingFile : public testing::Test {
 protected:
  PackingFile() : path(std::filesystem::path(testing::TempDir()) / ("packing-" + std::to_string(::getpid()) + ".h5")) {
    packing.key = {0.15, 0.10, 5e-4, 1e-3, 3.0, 0.719, "dilate", 0xFFFFFFFFFFFFFFFFull, 1, ""};
    packing.width = 0.15;
    packing.height = 0.10;
    packing.x = {0.01, 0.1 / 3.0};
    packing.y = {0.02, 0.03};
    packing.radius = {2e-4, 5e-4};
    packing.quality = {0.719, 0.8513, 1e-4, 3.98, 0.08, 4321, false, "why not"};
  }
  ~PackingFile() override { std::filesystem::remove(path); }
  std::filesystem::path path;
  Packing packing;
};

TEST_F(PackingFile, ComesBackAsItWas) {
  const PerforationLayout layout{0.15, 0.10, {{0.01, 0.02, Circle{0.003}}, {0.05, 0.06, Circle{0.007}}}};
  {
    io::Hdf5Writer file(path);
    write_packing(file, "/packing", packing);
    write_layout(file, "/layout", layout);
    write_layout(file, "/empty", {0.15, 0.10, {}});
    file.commit();
  }
  const io::Hdf5Reader file(path);
  const Packing read = read_packing(file, "/packing");
  EXPECT_EQ(read.key, packing.key);
  EXPECT_EQ(read.x, packing.x);
  EXPECT_EQ(read.y, packing.y);
  EXPECT_EQ(read.radius, packing.radius);
  EXPECT_EQ(read.width, packing.width);
  EXPECT_EQ(read.height, packing.height);
  EXPECT_EQ(read.quality.solid_fraction, 0.719);
  EXPECT_EQ(read.quality.jamming_fraction, 0.8513);
  EXPECT_EQ(read.quality.max_overlap_ratio, 1e-4);
  EXPECT_EQ(read.quality.coordination_number, 3.98);
  EXPECT_EQ(read.quality.rattler_fraction, 0.08);
  EXPECT_EQ(read.quality.iterations, 4321);
  EXPECT_FALSE(read.quality.reached);
  EXPECT_EQ(read.quality.reason, "why not");
  const PerforationLayout holes = read_layout(file, "/layout");
  ASSERT_EQ(holes.perforations.size(), 2u);
  EXPECT_EQ(holes.perforations[1].largest_extent(), 0.007);
  EXPECT_EQ(holes.width, 0.15);
  EXPECT_TRUE(read_layout(file, "/empty").perforations.empty());
}

// Circles alone leave no other datasets than before; of other shapes every number comes back.
TEST_F(PackingFile, LayoutsOfEveryShapeComeBack) {
  PerforationLayout layout{0.15, 0.10, {{0.01, 0.02, Circle{0.003}}}};
  const auto written = [&] {
    io::Hdf5Writer file(path);
    write_layout(file, "/layout", layout);
    file.commit();
  };
  written();
  EXPECT_FALSE(io::Hdf5Reader(path).has("/layout/corners"));
  layout.perforations.push_back({0.03, 0.02, make_shape(ShapeKind::slot, {8e-3, 2e-3, 0.3, 0.0, {}})});
  layout.perforations.push_back({0.05, 0.06, Circle{0.007}});
  layout.perforations.push_back({0.07, 0.06, make_shape(ShapeKind::ellipse, {8e-3, 2e-3, 0.3, 0.0, {}})});
  layout.perforations.push_back(
      {0.09, 0.06, make_shape(ShapeKind::polygon, {8e-3, 0.0, 0.0, 0.0, {{3, 0}, {0, 1}, {1, 0}, {0, -1}}})});
  written();
  EXPECT_EQ(read_layout(io::Hdf5Reader(path), "/layout").perforations, layout.perforations);
}

TEST_F(PackingFile, RefusesCornersThatAreNoOutline) {
  const auto refused = [&](const std::vector<double>& corners, const std::vector<std::int64_t>& first) {
    {
      const std::vector<double> one{0.01}, radius{0.0};
      io::Hdf5Writer file(path);
      file.group("/layout");
      for (const char* name : {"/layout/x", "/layout/y", "/layout/diameter"})
        file.dataset(name, std::span<const double>(one), 0, "m");
      file.dataset("/layout/radius", std::span<const double>(radius), 0, "m");
      file.dataset("/layout/first_corner", std::span<const std::int64_t>(first));
      file.dataset("/layout/corners", std::span<const double>(corners), 2, "m");
      file.attribute("/layout", "width", 0.1);
      file.attribute("/layout", "height", 0.1);
      file.commit();
    }
    EXPECT_THROW(static_cast<void>(read_layout(io::Hdf5Reader(path), "/layout")), io::InputError);
  };
  refused({0, 0, 1, 1, 1, 0, 0, 1}, {0, 4});  // crosses itself
  refused({0, 0, 0, 1, 1, 0}, {0, 3});        // clockwise
  refused({0, 0, 1, 0, 0, 1}, {0, 4});        // more corners than there are
  refused({0, 0, 1, 0, 0, 1}, {0});
  refused({0, 0, 0, 0}, {0, 2});
}

TEST_F(PackingFile, RefusesDiscsOutsideTheCellAndUnequalArrays) {
  const auto refused = [&] {
    {
      io::Hdf5Writer file(path);
      write_packing(file, "/packing", packing);
      file.commit();
    }
    try {
      read_packing(io::Hdf5Reader(path), "/packing");
    } catch (const io::InputError& error) {
      return std::string(error.what());
    }
    return std::string();
  };
  EXPECT_EQ(refused(), "");
  packing.x[1] = 0.2;
  EXPECT_THAT(refused(), testing::HasSubstr("entry 1"));
  packing.x = {0.01};
  std::filesystem::remove(path);
  EXPECT_THAT(refused(), testing::HasSubstr("not equally long"));
}

TEST_F(PackingFile, AKeyThatDisagreesNamesTheFieldAndBothValues) {
  const auto complaint = [&](const std::function<void(PackingKey&)>& change) {
    PackingKey wanted = packing.key;
    change(wanted);
    try {
      require_same_key(wanted, packing.key, "P.h5");
    } catch (const io::InputError& error) {
      return std::string(error.what());
    }
    return std::string();
  };
  using testing::AllOf;
  using testing::HasSubstr;
  EXPECT_EQ(complaint([](PackingKey&) {}), "");
  EXPECT_THAT(complaint([](PackingKey& key) { key.solid_fraction = 0.8; }),
              AllOf(HasSubstr("P.h5"), HasSubstr("packing.solid_fraction"), HasSubstr("0.719"), HasSubstr("0.8")));
  EXPECT_THAT(complaint([](PackingKey& key) { key.seed = 3; }),
              AllOf(HasSubstr("18446744073709551615"), HasSubstr("3")));
  EXPECT_THAT(complaint([](PackingKey& key) { key.protocol = "quench"; }),
              AllOf(HasSubstr("\"dilate\""), HasSubstr("\"quench\"")));
  for (const auto& change : std::vector<std::function<void(PackingKey&)>>{
           [](PackingKey& key) { key.width = 1; }, [](PackingKey& key) { key.height = 1; },
           [](PackingKey& key) { key.mean_diameter = 1; }, [](PackingKey& key) { key.maximum_diameter = 2; },
           [](PackingKey& key) { key.size_ratio = 2; },
           [](PackingKey& key) { key.algorithm_version = packing_algorithm_version + 1; },
           [](PackingKey& key) { key.source = "crc32:1"; }})
    EXPECT_NE(complaint(change), "");
}

TEST(GeometryOptions, DefaultsAreThoseOfTable1) {
  PackingOptions options;
  io::Schema schema;
  describe(schema, options);
  EXPECT_EQ(schema.get_number("packing.mean_diameter"), 0.5044e-3);
  schema.set("packing.protocol", io::Value{std::string("quench"), 1}, {"design.toml", 1, "packing.protocol"});
  EXPECT_EQ(options.protocol, PackingProtocol::quench);
}

}  // namespace
}  // namespace perfora::geometry
