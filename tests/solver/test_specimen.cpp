// What is here: a block cut out of its periodic rectangle: places, holes, bonds, strength field, beds. What is expected
// is the periodic block itself. What is not: forces (test_walls.cpp).
#include <gtest/gtest.h>

#include <cmath>
#include <map>
#include <utility>

#include "solver/crushed_bands.h"
#include "tests/solver/bounded_block.h"

namespace perfora::solver {
namespace {

constexpr double pitch = 0.5e-3;

std::map<std::pair<std::int32_t, std::int32_t>, double> strengths(const BondNetwork& network) {
  std::map<std::pair<std::int32_t, std::int32_t>, double> found;
  for (std::size_t b = 0; b < network.i.size(); ++b) found[{network.i[b], network.j[b]}] = network.strength[b];
  return found;
}

TEST(Specimen, PeriodicEdgesChangeNothing) {
  const geometry::Packing packing = test::jittered_packing(14, pitch, 1);
  const Specimen s = make_specimen(packing, test::no_holes(packing), {}, {}, pitch);
  EXPECT_EQ(s.packing.x, packing.x);
  EXPECT_EQ(s.packing.y, packing.y);
  EXPECT_EQ(s.cell.xx, packing.width);
  EXPECT_EQ(s.cell.yy, packing.height);
  EXPECT_TRUE(s.walls.empty());
}

// Every disc is reported where it was in the periodic rectangle: rounding of the reduced coordinate of a cell some ten
// times as high, 1e-16 of it.
TEST(Specimen, PlacesAreThoseOfTheBlock) {
  const geometry::Packing packing = test::jittered_packing(14, pitch, 2);
  for (const Sides sides : {Sides::periodic, Sides::walls, Sides::free}) {
    const Simulation s = test::make_bounded(packing, test::with_edges(TopBottom::platens, sides), pitch, 0.0);
    EXPECT_NEAR(s.block().xx, packing.width, 1e-15);
    EXPECT_NEAR(s.block().yy, packing.height, 1e-15);
    for (std::int32_t d = 0; d < packing.size(); ++d) {
      const auto [x, y] = s.position(d);
      EXPECT_NEAR(x, packing.x[static_cast<std::size_t>(d)], 1e-15);
      EXPECT_NEAR(y, packing.y[static_cast<std::size_t>(d)], 1e-15);
    }
  }
}

// The bonds are those of the periodic block that do not cross a cut edge, each as strong as there (Perlin's field at
// the same place: rounding of the place, 1e-15 of a lattice length).
TEST(Specimen, BondsAndStrengthsAreThoseOfThePeriodicBlock) {
  const geometry::Packing packing = test::jittered_packing(16, pitch, 3);
  NoiseOptions noise;
  noise.kind = NoiseKind::perlin;
  noise.length = 2e-3;
  const auto periodic =
      strengths(make_bond_network(packing, test::no_holes(packing), MaterialOptions{}, noise, 5, pitch));
  for (const TopBottom top_bottom : {TopBottom::periodic, TopBottom::platens})
    for (const Sides sides : {Sides::periodic, Sides::walls, Sides::free}) {
      BoundaryOptions boundary;
      boundary.top_bottom = top_bottom;
      boundary.sides = sides;
      const Specimen s = make_specimen(packing, test::no_holes(packing), boundary, {}, pitch);
      const auto cut = strengths(make_bond_network(s.packing, s.layout, {}, noise, 5, pitch, s.field));
      std::size_t expected = 0;
      for (const auto& [pair, strength] : periodic) {
        const auto i = static_cast<std::size_t>(pair.first), j = static_cast<std::size_t>(pair.second);
        const bool over_x = std::fabs(packing.x[j] - packing.x[i]) > 0.5 * packing.width,
                   over_y = std::fabs(packing.y[j] - packing.y[i]) > 0.5 * packing.height;
        if ((over_x && sides != Sides::periodic) || (over_y && top_bottom == TopBottom::platens)) continue;
        ++expected;
        ASSERT_TRUE(cut.contains(pair));
        EXPECT_NEAR(cut.at(pair), strength, 1e-12);
      }
      EXPECT_EQ(cut.size(), expected);
    }
}

// A crushed end has no bond whose middle lies in it, whatever stands around the block; all other bonds stay, in order
// and as strong as they were.
TEST(CrushedEnds, HaveNoBonds) {
  const geometry::Packing packing = test::jittered_packing(16, pitch, 3);
  for (const TopBottom top_bottom : {TopBottom::periodic, TopBottom::platens}) {
    BoundaryOptions boundary;
    boundary.top_bottom = top_bottom;
    boundary.crushed_bottom = 2.3 * pitch;
    boundary.crushed_top = 1.1 * pitch;
    NoiseOptions noise;
    noise.kind = NoiseKind::weibull;
    const Specimen s = make_specimen(packing, test::no_holes(packing), boundary, {}, pitch);
    const BondNetwork whole = make_bond_network(s.packing, s.layout, {}, noise, 5, pitch, s.field);
    BondNetwork crushed = whole;
    remove_crushed_bonds(crushed, s.packing, s.field, boundary);
    std::size_t kept = 0;
    for (std::size_t b = 0; b < whole.i.size(); ++b) {
      const double y = packing.y[static_cast<std::size_t>(whole.i[b])];
      double middle = std::fmod(y + 0.5 * whole.direction_y[b] * whole.reference_length[b], packing.height);
      if (middle < 0.0) middle += packing.height;
      if (middle < 2.3 * pitch || middle > packing.height - 1.1 * pitch) continue;
      ASSERT_LT(kept, crushed.i.size());
      EXPECT_EQ(crushed.i[kept], whole.i[b]);
      EXPECT_EQ(crushed.j[kept], whole.j[b]);
      EXPECT_EQ(crushed.strength[kept], whole.strength[b]);
      EXPECT_EQ(crushed.direction_y[kept], whole.direction_y[b]);
      ++kept;
    }
    EXPECT_EQ(crushed.i.size(), kept);
    EXPECT_EQ(crushed.state.size(), kept);
    EXPECT_GT(kept, 0U);
    EXPECT_LT(kept, whole.i.size());
  }
}

// A hole that the edge cuts is in the periodic layout once; both of its parts cut the block.
TEST(Specimen, HolesAcrossACutEdgeStandOnBothSides) {
  const geometry::Packing packing = test::jittered_packing(20, pitch, 4);
  geometry::PerforationLayout layout = test::no_holes(packing);
  layout.perforations = {{5e-3, 1e-3, geometry::Circle{4e-3}}, {5e-3, 5e-3, geometry::Circle{2e-3}}};
  BoundaryOptions boundary;
  boundary.top_bottom = TopBottom::platens;
  const Specimen s = make_specimen(packing, layout, boundary, {}, pitch);
  ASSERT_EQ(s.layout.perforations.size(), 3u);
  const double offset = s.block.origin_y * s.cell.yy;
  EXPECT_NEAR(s.layout.perforations[0].y - offset, 1e-3, 1e-15);
  EXPECT_NEAR(s.layout.perforations[1].y - offset, 11e-3, 1e-15);
  EXPECT_NEAR(s.layout.perforations[2].y - offset, 5e-3, 1e-15);
}

// The beds of an edge hold all that its cut bonds held: sum over them of k_n n_y^2 + k_t n_x^2, once for either side.
TEST(Specimen, BedsHoldWhatTheCutBondsHeld) {
  const geometry::Packing packing = test::jittered_packing(14, pitch, 5);
  const MaterialOptions material;
  const BondNetwork net = make_bond_network(packing, test::no_holes(packing), material, {}, 1, pitch);
  double cut = 0.0;
  for (std::size_t b = 0; b < net.i.size(); ++b) {
    const auto i = static_cast<std::size_t>(net.i[b]), j = static_cast<std::size_t>(net.j[b]);
    if (std::fabs(packing.y[j] - packing.y[i]) <= 0.5 * packing.height) continue;
    cut += material.normal_stiffness * net.direction_y[b] * net.direction_y[b] +
           material.tangential_stiffness * net.direction_x[b] * net.direction_x[b];
  }
  BoundaryOptions boundary;
  boundary.top_bottom = TopBottom::platens;
  const Specimen s = make_specimen(packing, test::no_holes(packing), boundary, material, pitch);
  ASSERT_EQ(s.walls.size(), 2u);
  for (const WallPlace& wall : s.walls) {
    double held = 0.0;
    for (const FaceStiffness& face : wall.face_stiffness) {
      held += face.normal_stiffness;
      const double y = packing.y[static_cast<std::size_t>(face.disc)];
      EXPECT_LT(wall.side == WallSide::bottom ? y : packing.height - y, material.horizon * pitch);
    }
    EXPECT_NEAR(held, cut, 1e-9 * cut);
  }
}

// Whatever the strain, pairs across the vacuum are farther apart than bonds and near pairs reach.
TEST(Specimen, VacuumOutlastsTheLargestStrain) {
  const geometry::Packing packing = test::jittered_packing(14, pitch, 6);
  BoundaryOptions boundary;
  boundary.top_bottom = TopBottom::platens;
  boundary.sides = Sides::walls;
  const Specimen s = make_specimen(packing, test::no_holes(packing), boundary, {}, pitch);
  const double reach = 3.0 * pitch + 2.0 * 0.48 * pitch;  // r_H and a largest disc
  EXPECT_GT((1.0 - largest_run_strain) * (s.cell.yy - packing.height), reach);
  EXPECT_GT(s.cell.xx - packing.width, reach);
}

}  // namespace
}  // namespace perfora::solver
