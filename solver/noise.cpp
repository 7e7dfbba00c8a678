// What is here: Perlin's improved noise on a periodic lattice and the Weibull draw; streams from counter-based Philox
// (Random123).
#include "solver/noise.h"

#include <Random123/philox.h>

#include <algorithm>
#include <cmath>
#include <numeric>

namespace perfora::solver {
namespace {

constexpr std::uint32_t permutation_stream = 0x7065726cu;
constexpr std::uint32_t phase_stream = 0x70686173u;
constexpr std::uint32_t weibull_stream = 0x77656962u;
constexpr int table_size = 256;  // of the permutation; the lattice wraps before

/// Two uniform numbers in (0, 1) of a counter; 32 bits each.
std::array<double, 2> uniforms(std::uint64_t seed, std::uint32_t stream, std::uint64_t counter) {
  using Philox = r123::Philox4x32;
  const Philox::ctr_type input = {
      {static_cast<std::uint32_t>(counter), static_cast<std::uint32_t>(counter >> 32), stream, 0u}};
  const Philox::key_type key = {{static_cast<std::uint32_t>(seed), static_cast<std::uint32_t>(seed >> 32)}};
  const Philox::ctr_type bits = Philox()(input, key);
  return {(bits[0] + 0.5) / 4294967296.0, (bits[1] + 0.5) / 4294967296.0};
}

double fade(double t) {
  return t * t * t * (t * (t * 6.0 - 15.0) + 10.0);
}

double lerp(double t, double a, double b) {
  return a + t * (b - a);
}

/// Dot product of gradient `hash` with (x, y, 0): the sixteen entries of the 2002 paper (twelve edges, four of them
/// twice).
double gradient(int hash, double x, double y) {
  constexpr std::array<std::array<int, 2>, 16> g = {{{1, 1},
                                                     {-1, 1},
                                                     {1, -1},
                                                     {-1, -1},
                                                     {1, 0},
                                                     {-1, 0},
                                                     {1, 0},
                                                     {-1, 0},
                                                     {0, 1},
                                                     {0, -1},
                                                     {0, 1},
                                                     {0, -1},
                                                     {1, 1},
                                                     {-1, 1},
                                                     {0, -1},
                                                     {0, -1}}};
  const auto& direction = g[static_cast<std::size_t>(hash & 15)];
  return direction[0] * x + direction[1] * y;
}

int lattice_nodes(double period, double length) {
  return std::clamp(static_cast<int>(std::lround(period / length)), 1, table_size);
}

}  // namespace

PerlinField::PerlinField(double width, double height, double length, std::uint64_t seed)
    : width_(width), height_(height), nodes_x_(lattice_nodes(width, length)), nodes_y_(lattice_nodes(height, length)) {
  std::array<std::uint8_t, table_size> table{};
  std::iota(table.begin(), table.end(), std::uint8_t{0});
  for (int k = table_size - 1; k > 0; --k) {  // Fisher-Yates
    const double u = uniforms(seed, permutation_stream, static_cast<std::uint64_t>(k))[0];
    std::swap(table[static_cast<std::size_t>(k)], table[static_cast<std::size_t>(u * (k + 1))]);
  }
  for (std::size_t k = 0; k < permutation_.size(); ++k) permutation_[k] = table[k % table_size];
  const auto phase = uniforms(seed, phase_stream, 0);
  phase_x_ = phase[0] * nodes_x_;
  phase_y_ = phase[1] * nodes_y_;
}

double PerlinField::value(double x, double y) const {
  const double u = x / width_ * nodes_x_ + phase_x_;
  const double v = y / height_ * nodes_y_ + phase_y_;
  const double fu = std::floor(u), fv = std::floor(v);
  const double dx = u - fu, dy = v - fv;
  const auto wrap = [](double cell, int nodes) {
    const int k = static_cast<int>(std::fmod(cell, nodes));
    return k < 0 ? k + nodes : k;
  };
  const int x0 = wrap(fu, nodes_x_), x1 = (x0 + 1) % nodes_x_;
  const int y0 = wrap(fv, nodes_y_), y1 = (y0 + 1) % nodes_y_;
  const auto hash = [this](int cx, int cy) {
    const int first = permutation_[static_cast<std::size_t>(cx)] + cy;
    return static_cast<int>(permutation_[permutation_[static_cast<std::size_t>(first)]]);  // last step: z = 0
  };
  const double wx = fade(dx), wy = fade(dy);
  const double bottom = lerp(wx, gradient(hash(x0, y0), dx, dy), gradient(hash(x1, y0), dx - 1.0, dy));
  const double top = lerp(wx, gradient(hash(x0, y1), dx, dy - 1.0), gradient(hash(x1, y1), dx - 1.0, dy - 1.0));
  return lerp(wy, bottom, top);
}

// Independent corner gradients of zero mean: var p(x, y) = sum over corners of w^2 (E[g_x^2] d_x^2 + E[g_y^2] d_y^2), w
// = W(d_x) W(d_y), W = 1 - fade; averaged over a lattice cell this is 4 (E[g_x^2] + E[g_y^2]) A B with A = int W^2 t^2
// dt, B = int W^2 dt on [0, 1].
double perlin_deviation() {
  static const double deviation = [] {
    constexpr int intervals = 1000;  // Simpson; the integrands are polynomials of degree 12
    double a = 0.0, b = 0.0;
    for (int k = 0; k <= intervals; ++k) {
      const double t = static_cast<double>(k) / intervals;
      const double weight = (k == 0 || k == intervals ? 1.0 : (k % 2 ? 4.0 : 2.0)) / (3.0 * intervals);
      const double w = 1.0 - fade(t);
      a += weight * w * w * t * t;
      b += weight * w * w;
    }
    const double mean_gx2 = 10.0 / 16.0, mean_gy2 = 12.0 / 16.0;  // over the sixteen entries
    return std::sqrt(4.0 * (mean_gx2 + mean_gy2) * a * b);
  }();
  return deviation;
}

double perlin_amplitude(const NoiseOptions& noise) {
  return noise.deviation > 0.0 ? 2.0 * noise.deviation / perlin_deviation() : noise.amplitude;
}
double largest_perlin_amplitude() {
  return 2.0;
}  // |p| <= 1, so 1 + Delta p/2 > 0 needs Delta < 2
double largest_perlin_deviation() {
  return 0.5 * largest_perlin_amplitude() * perlin_deviation();
}

double weibull_factor(std::uint64_t seed, std::int64_t bond, double modulus) {
  const double u = uniforms(seed, weibull_stream, static_cast<std::uint64_t>(bond))[0];
  return std::pow(-std::log(u), 1.0 / modulus) / std::tgamma(1.0 + 1.0 / modulus);
}

}  // namespace perfora::solver
