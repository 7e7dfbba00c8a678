// What is here: clipping by both rules against brute force, the order it leaves, and walls between clipped discs.
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <set>

#include "geometry/clip.h"
#include "geometry/layout.h"
#include "geometry/make_packing.h"
#include "geometry/make_shape.h"
#include "geometry/random.h"
#include "geometry/wall.h"

namespace perfora::geometry {
namespace {

/// Discs at random places: clipping asks nothing of a packing.
Packing random_discs(int count, std::uint64_t seed) {
  Packing packing;
  packing.width = 0.15;
  packing.height = 0.10;
  for (std::uint64_t k = 0; k < static_cast<std::uint64_t>(count); ++k) {
    const auto u = uniform_pair(seed, RandomStream::disc_place, k);
    packing.x.push_back(u[0] * packing.width);
    packing.y.push_back(u[1] * packing.height);
    packing.radius.push_back(1e-4 + 4e-4 * uniform_pair(seed, RandomStream::disc_size, k)[0]);
  }
  return packing;
}

double distance_to_edge(const Packing& packing, std::size_t i, const Perforation& hole) {
  return std::hypot(std::remainder(packing.x[i] - hole.x, packing.width),
                    std::remainder(packing.y[i] - hole.y, packing.height)) -
         hole.reach();
}

TEST(ClipPacking, BothRulesAgreeWithBruteForce) {
  for (std::uint64_t seed = 1; seed <= 10; ++seed) {
    const Packing packing = random_discs(2000, seed);
    PerforationLayout layout{packing.width, packing.height, {}};
    for (std::uint64_t k = 0; k < 3 * seed; ++k) {
      const auto u = uniform_pair(seed, RandomStream::hole_place, k);
      layout.perforations.push_back(
          {u[0] * 0.15, u[1] * 0.10, Circle{1e-3 + 0.02 * uniform_pair(seed, RandomStream::hole_jitter, k)[0]}});
    }
    for (ClipRule rule : {ClipRule::centre, ClipRule::whole}) {
      std::set<std::pair<double, double>> left;
      for (std::size_t i = 0; i < packing.x.size(); ++i) {
        bool keep = true;
        for (const Perforation& hole : layout.perforations)
          keep = keep && distance_to_edge(packing, i, hole) >= (rule == ClipRule::whole ? packing.radius[i] : 0.0);
        if (keep) left.emplace(packing.x[i], packing.y[i]);
      }
      const Packing clipped = clip_packing(packing, layout, rule);
      ASSERT_EQ(static_cast<std::size_t>(clipped.size()), left.size());
      for (std::size_t i = 0; i < clipped.x.size(); ++i) EXPECT_TRUE(left.contains({clipped.x[i], clipped.y[i]}));
    }
  }
}

// Holes of every shape, some nearly as long as the cell: all images asked.
TEST(ClipPacking, ClipsByEveryShapeAcrossTheEdges) {
  for (std::uint64_t seed = 1; seed <= 6; ++seed) {
    const Packing packing = random_discs(3000, seed);
    PerforationLayout layout{packing.width, packing.height, {}};
    for (std::uint64_t k = 0; k < 3 * seed; ++k) {
      const auto u = uniform_pair(seed, RandomStream::hole_place, k),
                 v = uniform_pair(seed, RandomStream::hole_jitter, k);
      const auto kind = static_cast<ShapeKind>(k % 6);
      ShapeSize size{5e-3 + (k % 4 == 1 ? 0.13 : 0.02) * v[0], 5e-3, 6.0 * v[1], 1e-3, {}};
      if (k % 4 == 1) size.angle = 0.2 * (v[1] - 0.5);
      layout.perforations.push_back({u[0] * 0.15, u[1] * 0.10, make_shape(kind, size)});
    }
    for (ClipRule rule : {ClipRule::centre, ClipRule::whole}) {
      std::set<std::pair<double, double>> left;
      for (std::size_t i = 0; i < packing.x.size(); ++i) {
        bool keep = true;
        for (const Perforation& hole : layout.perforations)
          for (int a = -2; a <= 2; ++a)
            for (int b = -2; b <= 2; ++b)
              keep = keep && !hole.contains(packing.x[i] + a * packing.width, packing.y[i] + b * packing.height,
                                            rule == ClipRule::whole ? packing.radius[i] : 0.0);
        if (keep) left.emplace(packing.x[i], packing.y[i]);
      }
      const Packing clipped = clip_packing(packing, layout, rule);
      ASSERT_EQ(static_cast<std::size_t>(clipped.size()), left.size());
      for (std::size_t i = 0; i < clipped.x.size(); ++i) EXPECT_TRUE(left.contains({clipped.x[i], clipped.y[i]}));
    }
  }
}

TEST(ClipPacking, NeighboursInSpaceBecomeNeighboursInMemory) {
  const Packing packing = random_discs(4000, 3);
  const Packing sorted = clip_packing(packing, {packing.width, packing.height, {}}, ClipRule::centre);
  ASSERT_EQ(sorted.size(), packing.size());
  const double spacing = std::sqrt(packing.width * packing.height / packing.size());
  double steps = 0.0;
  for (std::size_t i = 1; i < sorted.x.size(); ++i)
    steps += std::hypot(sorted.x[i] - sorted.x[i - 1], sorted.y[i] - sorted.y[i - 1]);
  // A Hilbert curve steps by about one spacing; an unsorted list would step by about half the cell, 30 spacings.
  EXPECT_LT(steps / sorted.size(), 2.0 * spacing);
}

TEST(ThinnestWallDiscretised, MeasuresBetweenTheCirclesThatDiscsLeaveFree) {
  // Two holes of 20 mm, 50 mm apart; discs of radius 0.5 mm ring them with centres at 10.2 mm: voids of radius 9.7 mm.
  const PerforationLayout layout{0.15, 0.10, {{0.03, 0.05, Circle{0.02}}, {0.08, 0.05, Circle{0.02}}}};
  Packing ring;
  ring.width = 0.15;
  ring.height = 0.10;
  for (const Perforation& hole : layout.perforations)
    for (int k = 0; k < 60; ++k) {
      ring.x.push_back(hole.x + 0.0102 * std::cos(2.0 * std::numbers::pi * k / 60));
      ring.y.push_back(hole.y + 0.0102 * std::sin(2.0 * std::numbers::pi * k / 60));
      ring.radius.push_back(0.0005);
    }
  EXPECT_NEAR(thinnest_wall_discretised(ring, layout), 0.05 - 2 * 0.0097, 1e-12);
  EXPECT_TRUE(std::isinf(thinnest_wall_discretised(ring, {0.15, 0.10, {}})));
}

// Two slots side by side, one disc in the wall: it stands 0.3 mm off the first and reaches 0.1 mm into the second, so
// that the rims move 0.3 mm out and 0.1 mm in.
TEST(ThinnestWallDiscretised, MovesTheRimsOfSlots) {
  PerforationLayout layout{0.05, 0.05, {}};
  for (const double y : {0.010, 0.015})
    layout.perforations.push_back({0.02, y, make_shape(ShapeKind::slot, {8e-3, 2e-3, 0.0, 0.0, {}})});
  Packing clipped;
  clipped.width = clipped.height = 0.05;
  clipped.x = {0.021, 0.019};
  clipped.y = {0.0116, 0.01376};
  clipped.radius = {0.3e-3, 0.34e-3};
  EXPECT_NEAR(thinnest_wall_discretised(clipped, layout), 3e-3 - 0.3e-3 + 0.1e-3, 1e-15);
}

}  // namespace
}  // namespace perfora::geometry
