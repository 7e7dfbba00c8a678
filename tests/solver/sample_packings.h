// What is here: small disc packings and networks made by hand for the solver's tests. What is not: real packings
// (geometry/make_packing.h).
#pragma once

#include <Random123/philox.h>

#include <cmath>
#include <cstdint>

#include "geometry/packing.h"
#include "solver/simulation.h"

namespace perfora::test {

/// Repeatable uniform numbers in (0, 1).
class Uniform {
 public:
  explicit Uniform(std::uint64_t seed) : seed_(seed) {}
  double operator()() {
    const r123::Philox2x32::ctr_type bits =
        r123::Philox2x32()({{counter_++, 17u}}, {{static_cast<std::uint32_t>(seed_ * 2654435761u + 1u)}});
    return (bits[0] + 0.5) / 4294967296.0;
  }
  double operator()(double low, double high) { return low + (high - low) * (*this)(); }

 private:
  std::uint64_t seed_;
  std::uint32_t counter_ = 0;
};

/// A jittered triangular arrangement of rows x rows discs of mean diameter `pitch`, filling the periodic cell.
inline geometry::Packing jittered_packing(int rows, double pitch, std::uint64_t seed) {
  Uniform u(seed);
  geometry::Packing p;
  p.width = rows * pitch;
  p.height = rows * pitch;
  for (int r = 0; r < rows; ++r)
    for (int c = 0; c < rows; ++c) {
      p.x.push_back(std::fmod((c + 0.5 * (r % 2) + u(0.0, 0.2)) * pitch, p.width));
      p.y.push_back(std::fmod((r + u(0.0, 0.2)) * pitch, p.height));
      p.radius.push_back(pitch * u(0.35, 0.48));
    }
  return p;
}

/// A cluster of that arrangement in the middle of a much larger cell: no bond or contact crosses the boundary, so
/// angular momentum has a meaning.
inline geometry::Packing cluster_packing(int rows, double pitch, std::uint64_t seed) {
  geometry::Packing p = jittered_packing(rows, pitch, seed);
  const double shift = 2.0 * p.width;
  p.width *= 5.0;
  p.height *= 5.0;
  for (std::size_t k = 0; k < p.x.size(); ++k) {
    p.x[k] += shift;
    p.y[k] += shift;
  }
  return p;
}

inline geometry::PerforationLayout no_holes(const geometry::Packing& p) {
  geometry::PerforationLayout layout;
  layout.width = p.width;
  layout.height = p.height;
  return layout;
}

/// Bonds the packing (no perforations) and readies a simulation; rate in 1/s compresses the height.
inline solver::Simulation make_simulation(const geometry::Packing& packing, solver::SolverOptions options,
                                          double mean_diameter, double rate = 0.0, int threads = 1,
                                          std::uint64_t noise_seed = 1) {
  solver::SimulationInput input;
  input.clipped = &packing;
  input.network =
      solver::make_bond_network(packing, no_holes(packing), options.material, options.noise, noise_seed, mean_diameter);
  input.masses = solver::make_masses(packing, input.network, options.material, options.dynamics);
  input.time_step = options.dynamics.step_factor * input.masses.critical_step;
  input.cell.start = {packing.width, 0.0, packing.height};
  input.cell.control[2] = rate != 0.0 ? solver::CellControl::rate : solver::CellControl::fixed;
  input.cell.velocity.yy = -rate * packing.height;
  input.options = options;
  input.mean_diameter = mean_diameter;
  input.threads = threads;
  return solver::Simulation(std::move(input));
}

}  // namespace perfora::test
