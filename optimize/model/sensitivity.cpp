// What is here: estimators of Sobol indices. What is not: models.
#include "optimize/model/sensitivity.h"

#include "optimize/model/quasi_random.h"

namespace perfora::model {

SobolIndices sobol_indices(const std::function<double(std::span<const double>)>& function, int dimension, int count,
                           std::uint64_t seed) {
  const Eigen::MatrixXd points = sobol_matrix(count, 2 * dimension, seed);
  const auto value_at = [&](const Eigen::VectorXd& x) {
    return function({x.data(), static_cast<std::size_t>(x.size())});
  };
  Eigen::VectorXd a(count), b(count);
  for (int k = 0; k < count; ++k) {
    a(k) = value_at(points.row(k).head(dimension));
    b(k) = value_at(points.row(k).tail(dimension));
  }
  SobolIndices found{std::vector<double>(static_cast<std::size_t>(dimension), 0.0),
                     std::vector<double>(static_cast<std::size_t>(dimension), 0.0)};
  found.mean = 0.5 * (a.mean() + b.mean());
  found.variance = 0.5 * ((a.array() - found.mean).square().mean() + (b.array() - found.mean).square().mean());
  if (!(found.variance > 0.0)) return found;
  for (int j = 0; j < dimension; ++j) {
    double first = 0.0, total = 0.0;
    for (int k = 0; k < count; ++k) {
      Eigen::VectorXd mixed = points.row(k).head(dimension);
      mixed(j) = points(k, dimension + j);
      const double value = value_at(mixed);
      first += (b(k) - found.mean) * (value - a(k)) / count;
      total += 0.5 * (a(k) - value) * (a(k) - value) / count;
    }
    found.first[static_cast<std::size_t>(j)] = first / found.variance;
    found.total[static_cast<std::size_t>(j)] = total / found.variance;
  }
  return found;
}

}  // namespace perfora::model
