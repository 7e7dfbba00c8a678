// What is here: the elastic response of blocks with platens, walls and free sides against the stiffness of the periodic
// block, which comes from a linear solution of its own (elastic.h). What is not: breaking.
#include <gtest/gtest.h>

#include <cmath>

#include "solver/elastic/elastic.h"
#include "tests/solver/bounded_block.h"

namespace perfora::solver {
namespace {

constexpr double pitch = 0.5e-3;
constexpr double strain = 2e-4;

struct Answer {
  double modulus = 0.0;                                               ///< stress_yy over strain, Pa
  double bottom = 0.0, top = 0.0, left = 0.0, right = 0.0, xx = 0.0;  ///< over stress_yy
};

/// Slow elastic compression to `strain`; means over the last tenth of it, which average out what still swings.
Answer compress(const geometry::Packing& packing, SolverOptions options, double modulus, int transits) {
  test::make_unbreakable(options.material);
  double mass = 0.0;
  {
    const Simulation probe = test::make_bounded(packing, options, pitch, 0.0);
    for (const double m : probe.discs().mass) mass += m;
  }
  const double wave = std::sqrt(modulus / (mass / (packing.width * packing.height)));
  Simulation s = test::make_bounded(packing, options, pitch, strain * wave / (transits * packing.height));
  while (s.strain() < 0.9 * strain) s.step();
  s.reset_row();
  while (s.strain() < strain) s.step();
  const double stress = s.row_stress().yy;
  Answer a;
  a.modulus = stress / (0.95 * strain);
  a.xx = s.row_stress().xx / stress;
  for (std::size_t w = 0; w < s.walls().places().size(); ++w) {
    double* const fractions[] = {&a.bottom, &a.top, &a.left, &a.right};
    *fractions[static_cast<std::size_t>(s.walls().places()[w].side)] = s.walls().row_pressure(w) / stress;
  }
  return a;
}

struct Block {
  geometry::Packing packing;
  PlaneStiffness stiffness;
};
Block block_of(int rows, std::uint64_t seed) {
  Block b{test::jittered_packing(rows, pitch, seed), {}};
  const BondNetwork net = make_bond_network(b.packing, test::no_holes(b.packing), MaterialOptions{}, {}, 1, pitch);
  b.stiffness = elastic_response(net, b.packing.size(), b.packing.width, b.packing.height, MaterialOptions{}).stiffness;
  return b;
}

constexpr int transits = 25;  // what a run takes by default; inertia is then below 1 % of the stress

// In slow loading the force on either platen is the stress of the block: over the branches, the virial of a block in
// equilibrium is the force through every cut. What differs is inertia: (pi/2)/transits squared of it, and the sum of
// what waves are left, 1 % together. The same holds sideways where platens do not rub: else they hold the block back,
// too.
TEST(BoundedElasticity, PlatenStressIsTheStressOfTheBlock) {
  const Block b = block_of(24, 1);
  for (const double friction : {0.0, 0.4})
    for (const Sides sides : {Sides::periodic, Sides::walls, Sides::free}) {
      SolverOptions options = test::with_edges(TopBottom::platens, sides);
      options.boundary.platen_friction = friction;
      const Answer a = compress(b.packing, options, b.stiffness[1][1], transits);
      EXPECT_NEAR(a.bottom, 1.0, 0.01);
      EXPECT_NEAR(a.top, 1.0, 0.01);
      if (friction == 0.0 && sides != Sides::periodic) {
        EXPECT_NEAR(a.left, a.xx, 0.01);  // free sides: nothing has come to the walls that catch, so both are zero
        EXPECT_NEAR(a.right, a.xx, 0.01);
      }
      if (friction > 0.0 && sides == Sides::free) {
        EXPECT_GT(a.xx, 0.01);  // the rubbing platens hold the ends together
      }
    }
}

// What an edge layer takes from the modulus of blocks of 24 and 48 discs across, over the modulus of the periodic
// block. The layer is about a bond radius r_H = 3 pitches deep, so the defect is about c r_H/H with c near one, and
// falls as 1/H: twice the smaller less the larger is what would be left at infinite size. It is zero to the next order,
// (r_H/H)^2 of the smaller block, 1.6 %.
void expect_edge_layer(const Answer& small, const Answer& large, double small_limit, double large_limit) {
  const double first = 1.0 - small.modulus / small_limit, second = 1.0 - large.modulus / large_limit;
  constexpr double edge = 3.0 / 24.0;
  EXPECT_GT(first, 0.0);
  EXPECT_LT(first, 1.2 * edge);
  EXPECT_LT(second, 0.75 * first);
  EXPECT_NEAR(2.0 * second - first, 0.0, edge * edge);
}

TEST(BoundedElasticity, ModulusGoesToThePeriodicOneWithTheSize) {
  const Block small = block_of(24, 2), large = block_of(48, 2);
  for (const Sides sides : {Sides::periodic, Sides::walls}) {
    SolverOptions options = test::with_edges(TopBottom::platens, sides);
    options.boundary.platen_friction = 0.0;
    expect_edge_layer(compress(small.packing, options, small.stiffness[1][1], transits),
                      compress(large.packing, options, large.stiffness[1][1], transits), small.stiffness[1][1],
                      large.stiffness[1][1]);
  }
}

/// Stress over strain in y with no stress in x.
double young(const PlaneStiffness& c) {
  return c[1][1] - c[0][1] * c[0][1] / c[0][0];
}

// Free sides and smooth platens: uniaxial stress, so the modulus goes to E = C_yyyy - C_xxyy^2/C_xxxx of the periodic
// block; without platens, too, for an infinite column.
TEST(BoundedElasticity, FreeSidesGiveYoungsModulus) {
  const Block small = block_of(24, 3), large = block_of(48, 3);
  for (const TopBottom top_bottom : {TopBottom::platens, TopBottom::periodic}) {
    SolverOptions options = test::with_edges(top_bottom, Sides::free);
    options.boundary.platen_friction = 0.0;
    const Answer a = compress(small.packing, options, small.stiffness[1][1], transits),
                 b = compress(large.packing, options, large.stiffness[1][1], transits);
    EXPECT_NEAR(b.xx, 0.0, 0.01);
    expect_edge_layer(a, b, young(small.stiffness), young(large.stiffness));
  }
}

}  // namespace
}  // namespace perfora::solver
