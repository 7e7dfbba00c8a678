// What is here: real packings, plain or perforated, and runs of them. What is not: hand-made packings
// (tests/solver/sample_packings.h).
#pragma once

#include <cstdint>
#include <utility>

#include "geometry/layout.h"
#include "geometry/make_packing.h"
#include "solver/run.h"
#include "solver/run_setup.h"
#include "solver/simulation.h"

namespace perfora::verification {

inline constexpr double solid_fraction = 0.719;       ///< of Table 1's block (docs/theory.md)
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
  block.clipped =
      geometry::clip_packing(geometry::make_packing(options, layout.width, layout.height, seed, 1), layout, options.clip);
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
