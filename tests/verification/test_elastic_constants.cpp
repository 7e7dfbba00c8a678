// What is here: elastic constants of plain packings in all three modes against Voigt's, and their convergence; the
// solver's own quasi-static answer against the linear one (solver/elastic/elastic.h). What is not: holes
// (test_hole_arrays.cpp).
#include <algorithm>
#include <cmath>

#include "tests/verification/blocks.h"
#include "tests/verification/checks.h"

namespace perfora::verification {
namespace {

/// S = sum l^2/area, and from it Voigt's constants for an isotropic net.
double fabric(const Block& block, const solver::MaterialOptions& material) {
  double sum = 0.0;
  for (const double l : bonds(block, material).reference_length) sum += l * l;
  return sum / (block.layout.width * block.layout.height);
}

// Voigt's affine constants of a net whose bonds point anywhere alike: C11 = S (3 k_n + k_t)/8, C12 = S (k_n - k_t)/8,
// C66 = S (k_n + k_t)/8. 50 <d> square: 8 % fewer bonds than an endless sample would scatter; 3 % is asked.
TEST(ElasticConstants, AffineOnesAreVoigts) {
  const solver::MaterialOptions material;
  const double kn = material.normal_stiffness, kt = material.tangential_stiffness;
  const Block block = make_block(plain(50.0 * table1_diameter, 50.0 * table1_diameter), 1);
  const solver::PlaneStiffness c = elastic(block, material).affine_stiffness;
  const double s = fabric(block, material) / 8.0;
  expect_close("affine C11 over S (3 k_n + k_t)/8", c[0][0] / (s * (3.0 * kn + kt)), 1.0, 0.03);
  expect_close("affine C22 over S (3 k_n + k_t)/8", c[1][1] / (s * (3.0 * kn + kt)), 1.0, 0.03);
  expect_close("affine C12 over S (k_n - k_t)/8", c[0][1] / (s * (kn - kt)), 1.0, 0.03);
  expect_close("affine C66 over S (k_n + k_t)/8, without turns", c[2][2] / (s * (kn + kt)), 1.0, 0.03);
}

// Relaxed constants lie below Voigt's (they minimise the energy that Voigt's evaluates at one field), approach them
// with H, and are isotropic: C11 = C22 and C66 = (C11 - C12)/2 within 3 % in the mean of four samples of 50 <d> (at
// H = 1.5, with five bonds a disc, one sample scatters by some 3 %).
TEST(ElasticConstants, BelowVoigtAndIsotropic) {
  constexpr std::uint64_t samples = 4;
  std::vector<Block> blocks;
  for (std::uint64_t seed = 1; seed <= samples; ++seed)
    blocks.push_back(make_block(plain(50.0 * table1_diameter, 50.0 * table1_diameter), seed));
  const Block& block = blocks[0];
  double previous = 0.0;
  std::vector<std::vector<double>> table;
  for (const double horizon : {1.5, 2.0, 3.0, 4.0}) {
    solver::MaterialOptions material;
    material.horizon = horizon;
    const solver::ElasticResponse response = elastic(block, material);
    const solver::PlaneStiffness &c = response.stiffness, &v = response.affine_stiffness;
    const std::string at = ", H = " + short_text(horizon);
    const double fraction = 0.5 * (c[0][0] + c[1][1]) / (0.5 * (v[0][0] + v[1][1]));
    expect_between("C11 over Voigt's" + at, fraction, previous, 1.0);
    expect_between("C66 over Voigt's" + at, c[2][2] / v[2][2], 0.0, 1.0);
    expect_between("bulk modulus over Voigt's" + at,
                   (c[0][0] + c[1][1] + 2.0 * c[0][1]) / (v[0][0] + v[1][1] + 2.0 * v[0][1]), 0.0, 1.0);
    double axes = 0.0, shear = 0.0;
    for (const Block& sample : blocks) {
      const solver::PlaneStiffness e = elastic(sample, material).stiffness;
      axes += e[1][1] / e[0][0] / samples;
      shear += 2.0 * e[2][2] / (0.5 * (e[0][0] + e[1][1]) - 0.5 * (e[0][1] + e[1][0])) / samples;
    }
    expect_close("C22 over C11, mean of four samples" + at, axes, 1.0, 0.03);
    expect_close("2 C66/(C11 - C12), mean of four samples" + at, shear, 1.0, 0.03);
    expect_close("C21 over C12 (symmetry)" + at, c[1][0] / c[0][1], 1.0, 1e-6);
    table.push_back(
        {horizon, fraction, c[2][2] / v[2][2], response.moduli.isotropic_poisson, 0.5 * (c[0][0] + c[1][1])});
    previous = fraction;
  }
  write_table("horizon", {"horizon", "c11_over_voigt", "c66_over_voigt", "poisson", "c11"}, table);
}

// Sample size: C11 over Voigt's of samples of 20, 30, 50 and 70 <d>; a periodic sample has no edge, so the mean over
// seeds is the same within its scatter. From 50 <d> on, samples lie within 2 % of each other.
TEST(ElasticConstants, DoNotHangOnTheSampleSize) {
  std::vector<std::vector<double>> table;
  double large = 0.0;
  for (const double size : {70.0, 50.0, 30.0, 20.0}) {
    double sum = 0.0, square = 0.0;
    constexpr int seeds = 3;
    for (int seed = 1; seed <= seeds; ++seed) {
      const solver::ElasticResponse response =
          elastic(make_block(plain(size * table1_diameter, size * table1_diameter), static_cast<std::uint64_t>(seed)));
      const double fraction = response.stiffness[0][0] / response.affine_stiffness[0][0];
      sum += fraction / seeds;
      square += fraction * fraction / seeds;
    }
    if (large == 0.0)
      large = sum;
    else
      expect_close("C11 over Voigt's, " + short_text(size) + " <d> over " + short_text(70.0) + " <d>", sum / large, 1.0,
                   size >= 50.0 ? 0.02 : 0.04);
    table.push_back({size, sum, std::sqrt(std::max(0.0, square - sum * sum))});
  }
  write_table("sample_size", {"size", "c11_over_voigt", "scatter"}, table);
}

/// The block strained at once (positions with the cell, bonds as they were) and held until Cundall damping has brought
/// it to rest: stress, tension positive.
solver::Virial stress_after_hold(const Block& block, const solver::CellMatrix& strained, int steps) {
  solver::SolverOptions options;
  options.material.critical_normal_displacement = options.material.critical_shear_displacement = 1.0;
  options.dynamics.kernel = solver::KernelChoice::reference;  // strains of 1e-6 need double precision
  geometry::Packing moved = block.clipped;
  const double w = block.layout.width, h = block.layout.height;
  for (std::size_t d = 0; d < moved.x.size(); ++d) {
    moved.x[d] = strained.xx / w * block.clipped.x[d] + strained.xy / h * block.clipped.y[d];
    moved.y[d] = strained.yy / h * block.clipped.y[d];
  }
  solver::SimulationInput input;
  input.clipped = &moved;
  input.network = bonds(block, options.material);
  input.masses = solver::make_masses(block.clipped, input.network, options.material, options.dynamics);
  input.time_step = options.dynamics.step_factor * input.masses.critical_step;
  input.cell.start = strained;
  input.options = options;
  input.mean_diameter = block.mean_diameter;
  solver::Simulation s(std::move(input));
  for (int k = 0; k < steps; ++k) s.step();
  const solver::Virial v = s.stress();
  return {-v.xx, -v.xy, -v.yx, -v.yy};
}

// The time stepping at rest against the linear solution, which shares no code with it. At a strain of 1e-6 what is not
// linear is some 1e-6 of the stress; what is left to swing after 6,000 damped steps is below 1e-5. 1e-4 is asked.
TEST(ElasticConstants, TheStepComesToRestAtTheSameStress) {
  const Block block = make_block(plain(30.0 * table1_diameter, 30.0 * table1_diameter), 2);
  const solver::PlaneStiffness c = elastic(block).stiffness;
  const double w = block.layout.width, h = block.layout.height;
  constexpr double strain = 1e-6;
  constexpr int steps = 6000;
  const solver::Virial x = stress_after_hold(block, {w * (1.0 + strain), 0.0, h}, steps),
                       y = stress_after_hold(block, {w, 0.0, h * (1.0 + strain)}, steps),
                       xy = stress_after_hold(block, {w, h * strain, h}, steps);
  expect_close("C11 of the step over the linear one's", x.xx / strain / c[0][0], 1.0, 1e-4);
  expect_close("C21 of the step over the linear one's", x.yy / strain / c[1][0], 1.0, 1e-4);
  expect_close("C22 of the step over the linear one's", y.yy / strain / c[1][1], 1.0, 1e-4);
  expect_close("C66 of the step over the linear one's", 0.5 * (xy.xy + xy.yx) / strain / c[2][2], 1.0, 1e-4);
}

}  // namespace
}  // namespace perfora::verification
