// What is here: Bond candidates and near pairs against brute force; masses and critical step against closed forms.
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <set>

#include "geometry/make_shape.h"
#include "tests/solver/sample_packings.h"

namespace perfora::solver {
namespace {

double distance(const geometry::Packing& p, std::size_t a, std::size_t b) {
  double dx = p.x[b] - p.x[a], dy = p.y[b] - p.y[a];
  dx -= p.width * std::round(dx / p.width);
  dy -= p.height * std::round(dy / p.height);
  return std::hypot(dx, dy);
}

// All pairs within r_H, and every touching pair even when farther: brute force over all pairs.
TEST(BondNetwork, MatchesBruteForce) {
  for (std::uint64_t seed = 1; seed <= 10; ++seed) {
    geometry::Packing p = test::jittered_packing(11, 0.5e-3, seed);
    p.radius[5] = 1.4e-3;  // a giant that touches beyond r_H
    MaterialOptions material;
    material.horizon = 2.2;
    const BondNetwork net = make_bond_network(p, test::no_holes(p), material, {}, 1, 0.5e-3);
    std::set<std::pair<int, int>> found;
    for (std::size_t b = 0; b < net.i.size(); ++b) {
      ASSERT_LT(net.i[b], net.j[b]);
      EXPECT_TRUE(found.insert({net.i[b], net.j[b]}).second);
      EXPECT_NEAR(net.reference_length[b],
                  distance(p, static_cast<std::size_t>(net.i[b]), static_cast<std::size_t>(net.j[b])), 1e-15);
    }
    std::size_t expected = 0;
    for (std::size_t a = 0; a < p.x.size(); ++a)
      for (std::size_t b = a + 1; b < p.x.size(); ++b)
        if (distance(p, a, b) <= std::max(2.2 * 0.5e-3, p.radius[a] + p.radius[b])) {
          ++expected;
          EXPECT_TRUE(found.count({static_cast<int>(a), static_cast<int>(b)}));
        }
    EXPECT_EQ(found.size(), expected);
    EXPECT_EQ(count_bonds(p, test::no_holes(p), 2.2, 0.5e-3), net.size());
  }
}

// No bond across a perforation: holes under 4.5 mm (here 1 to 4 mm) at H = 3, <d> = 0.5 mm, some across the periodic
// boundary. Every bond that is left dips by at most 0.25 <d>, every pair left out within r_H dips by more; depths from
// the distance of the hole's centre to the segment, all images.
TEST(BondNetwork, NoBondAcrossSmallHoles) {
  int refused = 0;
  for (std::uint64_t seed = 1; seed <= 8; ++seed) {
    test::Uniform u(seed);
    geometry::Packing all = test::jittered_packing(24, 0.5e-3, seed), p = all;
    geometry::PerforationLayout layout = test::no_holes(all);
    layout.perforations.push_back({0.0, 0.3e-3, geometry::Circle{u(1.0e-3, 1.5e-3)}});
    layout.perforations.push_back({6e-3 + u(-1e-3, 1e-3), 6e-3, geometry::Circle{u(1.2e-3, 4e-3)}});
    p.x.clear(), p.y.clear(), p.radius.clear();
    const auto depth = [&](double ax, double ay, double bx, double by) {
      double deepest = 0.0;
      for (const geometry::Perforation& hole : layout.perforations)
        for (int ix = -1; ix <= 1; ++ix)
          for (int iy = -1; iy <= 1; ++iy) {
            const double cx = hole.x + ix * p.width - ax, cy = hole.y + iy * p.height - ay, sx = bx - ax, sy = by - ay;
            const double t = std::clamp((cx * sx + cy * sy) / (sx * sx + sy * sy), 0.0, 1.0);
            deepest = std::max(deepest, hole.reach() - std::hypot(cx - t * sx, cy - t * sy));
          }
      return deepest;
    };
    for (std::size_t k = 0; k < all.x.size(); ++k)
      if (depth(all.x[k], all.y[k], all.x[k] + 1e-9, all.y[k]) < 1e-9)
        p.x.push_back(all.x[k]), p.y.push_back(all.y[k]), p.radius.push_back(all.radius[k]);
    const BondNetwork net = make_bond_network(p, layout, {}, {}, 1, 0.5e-3);
    std::set<std::pair<int, int>> found;
    for (std::size_t b = 0; b < net.i.size(); ++b) found.insert({net.i[b], net.j[b]});
    for (std::size_t a = 0; a < p.x.size(); ++a)
      for (std::size_t b = a + 1; b < p.x.size(); ++b) {
        if (distance(p, a, b) > 1.5e-3) continue;
        double dx = p.x[b] - p.x[a], dy = p.y[b] - p.y[a];
        dx -= p.width * std::round(dx / p.width);
        dy -= p.height * std::round(dy / p.height);
        const double dip = depth(p.x[a], p.y[a], p.x[a] + dx, p.y[a] + dy);
        if (std::fabs(dip - 0.125e-3) < 1e-12) continue;
        EXPECT_EQ(found.count({static_cast<int>(a), static_cast<int>(b)}) == 1, dip <= 0.125e-3) << dip;
        refused += dip > 0.125e-3;
      }
  }
  EXPECT_GT(refused, 50);
}

// Nor across slots, one of them through the edge, two nearly as long as the cell: the depth in a slot is its radius
// less the distance of two segments, which is least at an end of one of them unless they cross.
TEST(BondNetwork, NoBondAcrossSlots) {
  const auto to_segment = [](double px, double py, double ax, double ay, double bx, double by) {
    const double ux = bx - ax, uy = by - ay;
    const double t = std::clamp(((px - ax) * ux + (py - ay) * uy) / (ux * ux + uy * uy), 0.0, 1.0);
    return std::hypot(px - ax - t * ux, py - ay - t * uy);
  };
  int refused = 0;
  for (std::uint64_t seed = 1; seed <= 4; ++seed) {
    test::Uniform u(seed);
    const geometry::Packing all = test::jittered_packing(24, 0.5e-3, seed);
    geometry::Packing p = all;
    struct Slot {
      double x, y, half, radius, angle;
    };
    const std::vector<Slot> slots{{0.0, 0.4e-3, 5.4e-3, 0.4e-3, 0.0},
                                  {6e-3 + u(-1e-3, 1e-3), 6e-3, 2e-3, u(0.3e-3, 0.8e-3), u(-1.5, 1.5)},
                                  {3e-3, 9.5e-3, 5.2e-3, 0.3e-3, 0.05}};
    geometry::PerforationLayout layout = test::no_holes(all);
    for (const Slot& s : slots)
      layout.perforations.push_back(
          {s.x, s.y,
           geometry::make_shape(geometry::ShapeKind::slot,
                                {2.0 * (s.half + s.radius), 2.0 * s.radius, s.angle, 0.0, {}})});
    const auto depth = [&](double ax, double ay, double bx, double by) {
      double deepest = 0.0;
      for (const Slot& s : slots)
        for (int ix = -2; ix <= 2; ++ix)
          for (int iy = -2; iy <= 2; ++iy) {
            const double cx = s.x + ix * p.width, cy = s.y + iy * p.height;
            const double hx = s.half * std::cos(s.angle), hy = s.half * std::sin(s.angle);
            const auto side = [&](double x0, double y0, double x1, double y1, double x, double y) {
              return (x1 - x0) * (y - y0) - (y1 - y0) * (x - x0) > 0.0;
            };
            double apart =
                std::min({to_segment(ax, ay, cx - hx, cy - hy, cx + hx, cy + hy),
                          to_segment(bx, by, cx - hx, cy - hy, cx + hx, cy + hy),
                          to_segment(cx - hx, cy - hy, ax, ay, bx, by), to_segment(cx + hx, cy + hy, ax, ay, bx, by)});
            if (side(ax, ay, bx, by, cx - hx, cy - hy) != side(ax, ay, bx, by, cx + hx, cy + hy) &&
                side(cx - hx, cy - hy, cx + hx, cy + hy, ax, ay) != side(cx - hx, cy - hy, cx + hx, cy + hy, bx, by))
              apart = 0.0;
            deepest = std::max(deepest, s.radius - apart);
          }
      return deepest;
    };
    p.x.clear(), p.y.clear(), p.radius.clear();
    for (std::size_t k = 0; k < all.x.size(); ++k)
      if (depth(all.x[k], all.y[k], all.x[k] + 1e-9, all.y[k]) < 1e-9)
        p.x.push_back(all.x[k]), p.y.push_back(all.y[k]), p.radius.push_back(all.radius[k]);
    const BondNetwork net = make_bond_network(p, layout, {}, {}, 1, 0.5e-3);
    std::set<std::pair<int, int>> found;
    for (std::size_t b = 0; b < net.i.size(); ++b) found.insert({net.i[b], net.j[b]});
    for (std::size_t a = 0; a < p.x.size(); ++a)
      for (std::size_t b = a + 1; b < p.x.size(); ++b) {
        if (distance(p, a, b) > 1.5e-3) continue;
        const double dx = std::remainder(p.x[b] - p.x[a], p.width), dy = std::remainder(p.y[b] - p.y[a], p.height);
        const double dip = depth(p.x[a], p.y[a], p.x[a] + dx, p.y[a] + dy);
        if (std::fabs(dip - 0.125e-3) < 1e-12) continue;
        EXPECT_EQ(found.count({static_cast<int>(a), static_cast<int>(b)}) == 1, dip <= 0.125e-3) << dip;
        refused += dip > 0.125e-3;
      }
  }
  EXPECT_GT(refused, 200);
}

// Near pairs: mirrored rows, complete against brute force, right after a rebuild and as long as the list says it is
// valid while discs move at random and the cell is compressed and sheared.
TEST(NeighbourList, CompleteUntilOutdated) {
  for (std::uint64_t seed = 1; seed <= 6; ++seed) {
    const geometry::Packing p = test::jittered_packing(13, 0.5e-3, seed);
    test::Uniform u(seed);
    DiscState discs;
    discs.resize(p.x.size());
    discs.radius = p.radius;
    CellMatrix cell{p.width, 0.0, p.height};
    for (std::size_t d = 0; d < p.x.size(); ++d)
      discs.sx[d] = fixed_point(p.x[d] / p.width), discs.sy[d] = fixed_point(p.y[d] / p.height);
    NeighbourList near;
    near.configure(discs.size(), 0.24e-3, 0.15e-3);
    BondNetwork none;
    near.rebuild(discs, cell, none);
    int checked = 0;
    for (int move = 0; move < 200; ++move) {
      cell.yy *= 1.0 - 2e-4;
      cell.xy += 1e-4 * cell.yy;
      double largest = 0.0;
      for (std::size_t d = 0; d < p.x.size(); ++d) {
        discs.sx[d] += static_cast<std::uint64_t>(static_cast<std::int64_t>(u(-1.0, 1.0) * 6e-3 * 0x1p62));
        discs.sy[d] += static_cast<std::uint64_t>(static_cast<std::int64_t>(u(-1.0, 1.0) * 6e-3 * 0x1p62));
        const double ux = reduced(discs.sx[d] - near.reference_x()[d]),
                     uy = reduced(discs.sy[d] - near.reference_y()[d]);
        largest = std::max(largest, std::hypot(cell.xx * ux + cell.xy * uy, cell.yy * uy));
      }
      if (near.outdated(largest, cell)) near.rebuild(discs, cell, none);
      for (std::int32_t a = 0; a < discs.size(); ++a)
        for (std::int32_t b = a + 1; b < discs.size(); ++b) {
          const auto i = static_cast<std::size_t>(a), j = static_cast<std::size_t>(b);
          const double dx = reduced(discs.sx[j] - discs.sx[i]), dy = reduced(discs.sy[j] - discs.sy[i]);
          if (std::hypot(cell.xx * dx + cell.xy * dy, cell.yy * dy) >= p.radius[i] + p.radius[j]) continue;
          ++checked;
          ASSERT_NE(near.find(a, b), nullptr);
          ASSERT_NE(near.find(b, a), nullptr);
        }
    }
    EXPECT_GT(near.rebuilds(), 3);
    EXPECT_LT(near.rebuilds(), 150);
    EXPECT_GT(checked, 100);
  }
}

// uniform_step keeps the total mass and lengthens the step in bonds and in contacts; physical masses are rho pi R^2 and
// m R^2/2.
TEST(Masses, UniformStepKeepsTheTotal) {
  const geometry::Packing p = test::jittered_packing(10, 0.5e-3, 2);
  MaterialOptions material;
  const BondNetwork net = make_bond_network(p, test::no_holes(p), material, {}, 1, 0.5e-3);
  DynamicsOptions dynamics;
  const MassProperties uniform = make_masses(p, net, material, dynamics);
  dynamics.mass = MassScaling::physical;
  const MassProperties physical = make_masses(p, net, material, dynamics);
  double total = 0.0;
  for (const double m : uniform.mass) total += m;
  double area = 0.0;
  for (const double r : p.radius) area += std::numbers::pi * r * r;
  EXPECT_NEAR(total, 2200.0 * area, 1e-12);
  EXPECT_NEAR(physical.total, 2200.0 * area, 1e-12);
  EXPECT_DOUBLE_EQ(physical.mass[3], 2200.0 * std::numbers::pi * p.radius[3] * p.radius[3]);
  EXPECT_DOUBLE_EQ(physical.inertia[3], 0.5 * physical.mass[3] * p.radius[3] * p.radius[3]);
  EXPECT_GT(uniform.critical_step, 1.2 * physical.critical_step);
  // Of discs of nearly one size, as here, contacts allow about the same step either way.
  EXPECT_GT(contact_critical_step(uniform, p.radius, material, 0.7),
            0.9 * contact_critical_step(physical, p.radius, material, 0.7));
  // The bound holds: the true critical step, by power iteration, is never shorter.
  EXPECT_GE(critical_step_by_power_iteration(net, uniform, material, 0.7, 400), uniform.critical_step);
  EXPECT_GE(critical_step_by_power_iteration(net, physical, material, 0.7, 400), physical.critical_step);
}

// Power iteration on one bond of two equal masses without shear: omega^2 = 2 k_n/m; with shear the coupled mode of
// displacement and rotation has omega^2 = k_t (2/m + l^2/(2 I)), whichever is larger.
TEST(Masses, CriticalStepOfOneBond) {
  BondNetwork net{{0}, {1}, {1e-3}, {1.0}, {0.0}, {1.0}, {0.0}, {BondState::intact}};
  MassProperties m;
  m.mass = {1e-3, 1e-3};
  m.inertia = {1e-10, 1e-10};
  MaterialOptions material;
  material.tangential_stiffness = 1e-3;
  EXPECT_NEAR(critical_step_by_power_iteration(net, m, material, 0.0, 200),
              2.0 / std::sqrt(2.0 * material.normal_stiffness / 1e-3), 1e-12);
  material.tangential_stiffness = 8.246e6;
  EXPECT_NEAR(critical_step_by_power_iteration(net, m, material, 0.0, 400),
              2.0 / std::sqrt(8.246e6 * (2.0 / 1e-3 + 1e-6 / (2.0 * 1e-10))), 1e-12);
}

}  // namespace
}  // namespace perfora::solver
