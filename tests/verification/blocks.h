// What is here: real packings, plain or perforated, and runs of them. What is not: hand-made packings
// (tests/solver/sample_packings.h).
#pragma once

#include <cstdint>
#include <utility>

#include "geometry/clip.h"
#include "geometry/layout.h"
#include "geometry/make_packing.h"
#include "solver/elastic/elastic.h"
#include "solver/run.h"
#include "solver/run_setup.h"
#include "solver/simulation.h"

namespace perfora::verification {

inline constexpr double solid_fraction = 0.719;       ///< of Table 1's block (docs/user/theory.md)
inline constexpr double table1_diameter = 0.5044e-3;  ///< <d>, m

/// A packing with its holes.
struct Block {
  geometry::PerforationLayout layout;
  geometry::Packing clipped;
  double mean_diameter = table1_diameter;
};

/// Table 1's discs, in size `diameter` on average (the same size ratio), in a cell of these holes.
inline Block make_block(const geometry::PerforationLayout& layout, std::uint64_t seed,
                        double diameter = table1_diameter) {
  geometry::PackingOptions options;
  options.mean_diameter = diameter;
  options.maximum_diameter *= diameter / table1_diameter;
  options.solid_fraction = solid_fraction;
  Block block;
  block.layout = layout;
  block.mean_diameter = diameter;
  block.clipped = geometry::clip_packing(geometry::make_packing(options, layout.width, layout.height, seed, 1), layout,
                                         options.clip);
  return block;
}

/// rows x columns holes, square or staggered.
inline geometry::PerforationLayout holes(double width, double height, double diameter, int rows, int columns,
                                         geometry::LayoutFamily family = geometry::LayoutFamily::square) {
  geometry::LayoutOptions options;
  options.width = width;
  options.height = height;
  options.family = family;
  options.diameter = diameter;
  options.rows = rows;
  options.columns = columns;
  return geometry::make_layout(options, 1);
}

inline geometry::PerforationLayout plain(double width, double height) {
  geometry::PerforationLayout layout;
  layout.width = width;
  layout.height = height;
  return layout;
}

inline solver::BondNetwork bonds(const Block& block, const solver::MaterialOptions& material) {
  return solver::make_bond_network(block.clipped, block.layout, material, {}, 1, block.mean_diameter);
}

inline solver::ElasticResponse elastic(const Block& block, const solver::MaterialOptions& material = {}) {
  return solver::elastic_response(bonds(block, material), block.clipped.size(), block.layout.width, block.layout.height,
                                  material);
}

/// Young's modulus for a stress at 45 degrees to the axes, Pa.
inline double young_on_the_diagonal(const solver::PlaneStiffness& c) {
  const double determinant = c[0][0] * c[1][1] - c[0][1] * c[0][1];
  const double s11 = c[1][1] / determinant, s22 = c[0][0] / determinant, s12 = -c[0][1] / determinant;
  return 4.0 / (s11 + s22 + 2.0 * s12 + 1.0 / c[2][2]);
}

inline solver::Response crush(const Block& block, const solver::SolverOptions& options, std::uint64_t noise_seed = 1) {
  solver::RunRequest request;
  request.clipped = &block.clipped;
  request.layout = &block.layout;
  request.options = options;
  request.noise_seed = noise_seed;
  request.mean_diameter = block.mean_diameter;
  return solver::run_compression(request);
}

}  // namespace perfora::verification
