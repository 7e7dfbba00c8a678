// What is here: Sobol's sequence from Boost, scrambled. What is not: its use.
#include "optimize/model/quasi_random.h"

#include <Random123/philox.h>

#include <boost/math/distributions/normal.hpp>
#include <boost/random/sobol.hpp>

namespace perfora::model {
namespace {

constexpr int digits = 32;

/// Bits that permute one digit of one coordinate, given the digits before it.
std::uint32_t scrambled(std::uint32_t value, std::uint32_t coordinate, std::uint64_t seed) {
  const r123::Philox4x32::key_type key{{static_cast<std::uint32_t>(seed), static_cast<std::uint32_t>(seed >> 32)}};
  std::uint32_t out = 0;
  for (int digit = 0; digit < digits; ++digit) {
    const std::uint32_t before = digit == 0 ? 0 : value >> (digits - digit);
    const r123::Philox4x32::ctr_type place{{before, static_cast<std::uint32_t>(digit), coordinate, 0}};
    const std::uint32_t turn = r123::Philox4x32{}(place, key)[0] & 1U;
    const std::uint32_t own = (value >> (digits - 1 - digit)) & 1U;
    out |= (own ^ turn) << (digits - 1 - digit);
  }
  return out;
}

}  // namespace

std::vector<std::vector<double>> sobol_points(int count, int dimension, std::uint64_t seed) {
  boost::random::sobol_engine<std::uint32_t, digits, boost::random::default_sobol_table> engine(
      static_cast<std::size_t>(dimension));
  std::vector<std::vector<double>> points;
  for (int k = 0; k < count; ++k) {
    std::vector<double>& point = points.emplace_back();
    for (int d = 0; d < dimension; ++d) {
      // Boost leaves out the first point, all zeros, without which the sequence is no net.
      const std::uint32_t raw = k == 0 ? 0 : engine();
      point.push_back(scrambled(raw, static_cast<std::uint32_t>(d), seed) * 0x1p-32);
    }
  }
  return points;
}

Eigen::MatrixXd sobol_matrix(int count, int dimension, std::uint64_t seed) {
  Eigen::MatrixXd matrix(count, dimension);
  if (dimension == 0) return matrix;
  const auto points = sobol_points(count, dimension, seed);
  for (int k = 0; k < count; ++k)
    for (int d = 0; d < dimension; ++d) matrix(k, d) = points[static_cast<std::size_t>(k)][static_cast<std::size_t>(d)];
  return matrix;
}

Eigen::MatrixXd normal_matrix(int count, int dimension, std::uint64_t seed) {
  const boost::math::normal standard;
  // Half a step on: a coordinate may be 0, whose quantile is infinite.
  return sobol_matrix(count, dimension, seed).unaryExpr([&](double u) {
    return boost::math::quantile(standard, u + 0x1p-33);
  });
}

}  // namespace perfora::model
