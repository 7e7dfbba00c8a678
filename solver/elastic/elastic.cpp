// What is here: the stiffness matrix of a bonded block assembled and solved for three unit strains. Bond displacements
// are delta = B u + A with a sparse matrix B (two rows a bond, three columns a disc) and the affine part A; so K = B^T
// D B, f = B^T D A and stiffness = A^T D delta / area. What is not: the force kernels, on purpose. One thread: a second
// one gains little here, and waits where many compressions share the cores.
#define EIGEN_DONT_PARALLELIZE
#include "solver/elastic/elastic.h"

#include <Eigen/Dense>
#include <Eigen/Sparse>
#include <algorithm>
#include <cmath>
#include <limits>

namespace perfora::solver {
namespace {

using SparseRows = Eigen::SparseMatrix<double, Eigen::RowMajor>;
using SparseColumns = Eigen::SparseMatrix<double>;
using Triplets = std::vector<Eigen::Triplet<double>>;
using Columns = Eigen::Matrix<double, Eigen::Dynamic, 3, Eigen::RowMajor>;  ///< one column a load case
using Index = Eigen::Index;

/// The intact bonds as a linear map. The unknown of a rotation is phi x rotation_length, so that all unknowns are
/// lengths and all residuals forces.
struct LinearBonds {
  std::vector<std::int64_t> id;  ///< of the intact bonds, in order
  double rotation_length = 1.0;  ///< half the mean bond length, m
  SparseRows displacement;       ///< B
  Columns affine;                ///< A: displacements that the unit strains themselves make
  Eigen::VectorXd stiffness;     ///< D: k_n and k_t in turn
};

double mean_half_length(const BondNetwork& network, const std::vector<std::int64_t>& ids) {
  double sum = 0.0;
  for (const std::int64_t id : ids) sum += network.reference_length[static_cast<std::size_t>(id)];
  return ids.empty() ? 1.0 : 0.5 * sum / static_cast<double>(ids.size());
}

LinearBonds linearise(const BondNetwork& network, std::int32_t discs, double k_n, double k_t) {
  LinearBonds bonds;
  for (std::int64_t b = 0; b < network.size(); ++b)
    if (network.state[static_cast<std::size_t>(b)] == BondState::intact) bonds.id.push_back(b);
  bonds.rotation_length = mean_half_length(network, bonds.id);
  const auto rows = static_cast<Index>(2 * bonds.id.size());
  bonds.affine.resize(rows, 3);
  bonds.stiffness.resize(rows);
  Triplets entries;
  constexpr std::size_t entries_per_bond = 10;
  entries.reserve(entries_per_bond * bonds.id.size());
  Index row = 0;
  for (const std::int64_t bond : bonds.id) {
    const auto id = static_cast<std::size_t>(bond);
    const int i = 3 * network.i[id], j = 3 * network.j[id];
    const int normal = static_cast<int>(row), shear = normal + 1;
    const double nx = network.direction_x[id], ny = network.direction_y[id], l = network.reference_length[id];
    const double tx = -ny, ty = nx, lever = -0.5 * l / bonds.rotation_length;
    entries.insert(entries.end(), {{normal, i, -nx}, {normal, i + 1, -ny}, {normal, j, nx}, {normal, j + 1, ny}});
    entries.insert(entries.end(), {{shear, i, -tx}, {shear, i + 1, -ty}, {shear, i + 2, lever}});
    entries.insert(entries.end(), {{shear, j, tx}, {shear, j + 1, ty}, {shear, j + 2, lever}});
    const double rx = l * nx, ry = l * ny;
    bonds.affine.row(row) << nx * rx, ny * ry, 0.5 * (nx * ry + ny * rx);
    bonds.affine.row(row + 1) << tx * rx, ty * ry, 0.5 * (tx * ry + ty * rx);
    bonds.stiffness(row) = k_n;
    bonds.stiffness(row + 1) = k_t;
    row += 2;
  }
  bonds.displacement.resize(rows, 3 * static_cast<Index>(discs));
  bonds.displacement.setFromTriplets(entries.begin(), entries.end());
  return bonds;
}

/// Groups of neighbouring discs and where each disc sits in its group, along bonds, so that periodicity needs no care.
struct Groups {
  std::vector<std::int32_t> group;  ///< of every disc
  std::vector<double> x, y;         ///< from the root of the group, m
  std::int32_t count = 0;
};

/// A bond seen from one of its discs.
struct Neighbour {
  std::int32_t disc;
  double x, y;  ///< branch to it, m
};

std::vector<std::vector<Neighbour>> neighbours_of(const BondNetwork& network, std::int32_t discs,
                                                  const std::vector<std::int64_t>& ids) {
  std::vector<std::vector<Neighbour>> neighbours(static_cast<std::size_t>(discs));
  for (const std::int64_t bond : ids) {
    const auto id = static_cast<std::size_t>(bond);
    const double x = network.reference_length[id] * network.direction_x[id],
                 y = network.reference_length[id] * network.direction_y[id];
    neighbours[static_cast<std::size_t>(network.i[id])].push_back({network.j[id], x, y});
    neighbours[static_cast<std::size_t>(network.j[id])].push_back({network.i[id], -x, -y});
  }
  return neighbours;
}

/// A disc none of whose neighbours is taken founds a group of all of them; what is left over joins the group of a
/// neighbour (the usual way of algebraic multigrid: Vanek, Mandel, Brezina, Computing 56, 1996). About 30 discs a group
/// at 21 bonds a disc.
Groups make_groups(const BondNetwork& network, std::int32_t discs, const std::vector<std::int64_t>& ids) {
  constexpr std::int32_t none = -1;
  const auto neighbours = neighbours_of(network, discs, ids);
  const auto n = static_cast<std::size_t>(discs);
  Groups g{std::vector<std::int32_t>(n, none), std::vector<double>(n, 0.0), std::vector<double>(n, 0.0), 0};
  const auto at = [](std::int32_t k) { return static_cast<std::size_t>(k); };
  for (std::size_t root = 0; root < n; ++root) {
    const bool free =
        g.group[root] == none && std::none_of(neighbours[root].begin(), neighbours[root].end(),
                                              [&](const Neighbour& m) { return g.group[at(m.disc)] != none; });
    if (!free) continue;
    g.group[root] = g.count;
    for (const Neighbour& m : neighbours[root]) {
      g.group[at(m.disc)] = g.count;
      g.x[at(m.disc)] = m.x;
      g.y[at(m.disc)] = m.y;
    }
    ++g.count;
  }
  const std::vector<std::int32_t> founded = g.group;
  for (std::size_t d = 0; d < n; ++d) {
    if (founded[d] != none) continue;
    for (const Neighbour& m : neighbours[d])  // a disc without a group has a neighbour in one, or it had founded one
      if (founded[at(m.disc)] != none) {
        g.group[d] = founded[at(m.disc)];
        g.x[d] = g.x[at(m.disc)] - m.x;
        g.y[d] = g.y[at(m.disc)] - m.y;
        break;
      }
  }
  return g;
}

/// Columns: the two translations and the rotation of each group.
SparseColumns rigid_motions(const Groups& groups, double rotation_length) {
  const auto n = static_cast<int>(groups.group.size());
  Triplets entries;
  constexpr int entries_per_disc = 5;
  entries.reserve(static_cast<std::size_t>(entries_per_disc * n));
  for (int d = 0; d < n; ++d) {
    const auto at = static_cast<std::size_t>(d);
    const int row = 3 * d, column = 3 * groups.group[at];
    entries.insert(entries.end(), {{row, column, 1.0}, {row + 1, column + 1, 1.0}, {row + 2, column + 2, 1.0}});
    entries.emplace_back(row, column + 2, -groups.y[at] / rotation_length);
    entries.emplace_back(row + 1, column + 2, groups.x[at] / rotation_length);
  }
  SparseColumns motions(3 * n, 3 * groups.count);
  motions.setFromTriplets(entries.begin(), entries.end());
  return motions;
}

/// Approximate inverse of K: each disc on its own (its 3 x 3 block) plus the rigid motions of the groups (solved
/// exactly). The second carries the long waves, for which the first alone needs some thousand iterations.
class TwoLevels {
 public:
  TwoLevels(const SparseRows& matrix, const SparseColumns& motions) : motions_(motions) {
    invert_blocks(matrix);
    const SparseColumns columns = matrix;
    const SparseColumns moved = columns * motions;
    SparseColumns coarse = motions.transpose() * moved;
    // Fragments and the whole block move freely: a small share on the diagonal keeps the factors finite. The right-hand
    // sides have no part in those motions.
    constexpr double fraction = 1e-8;
    const double least = fraction * coarse.diagonal().maxCoeff() + std::numeric_limits<double>::min();
    for (Index k = 0; k < coarse.rows(); ++k) coarse.coeffRef(k, k) += std::max(fraction * coarse.coeff(k, k), least);
    factors_.compute(coarse);
  }

  bool good() const { return factors_.info() == Eigen::Success; }

  Columns operator()(const Columns& force) const {
    const Eigen::MatrixXd on_groups = motions_.transpose() * force;
    const Eigen::MatrixXd of_groups = factors_.solve(on_groups);
    Columns result = motions_ * of_groups;
    for (std::size_t d = 0; d < blocks_.size(); ++d) {
      const auto row = 3 * static_cast<Index>(d);
      result.middleRows<3>(row) += blocks_[d] * force.middleRows<3>(row);
    }
    return result;
  }

 private:
  /// Pseudo-inverse of each block: a disc with one bond or none has directions that nothing holds.
  void invert_blocks(const SparseRows& matrix) {
    constexpr double rounding = 1e-12;
    blocks_.resize(static_cast<std::size_t>(matrix.rows() / 3));
    for (std::size_t d = 0; d < blocks_.size(); ++d) {
      const auto row = 3 * static_cast<Index>(d);
      const Eigen::Matrix3d block = matrix.block(row, row, 3, 3);
      const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> modes(block);
      const double least = rounding * modes.eigenvalues().maxCoeff();
      const Eigen::Vector3d inverse =
          modes.eigenvalues().unaryExpr([&](double value) { return value > least ? 1.0 / value : 0.0; });
      blocks_[d] = modes.eigenvectors() * inverse.asDiagonal() * modes.eigenvectors().transpose();
    }
  }

  SparseColumns motions_;
  std::vector<Eigen::Matrix3d> blocks_;
  Eigen::SimplicialLDLT<SparseColumns> factors_;
};

struct Solution {
  Columns displacement;
  int iterations = 0;
  double residual = 0.0;
  bool converged = false;
};

/// Conjugate gradients for three right-hand sides side by side, which share every product with the matrix. `scale`: the
/// forces that a residual is compared with, one a column.
Solution solve(const SparseRows& matrix, const TwoLevels& inverse, const Columns& force,
               const Eigen::RowVector3d& scale, const ElasticOptions& options) {
  const auto dot = [](const Columns& a, const Columns& b) -> Eigen::Array3d {
    return a.cwiseProduct(b).colwise().sum().transpose();
  };
  const auto quotient = [](const Eigen::Array3d& a, const Eigen::Array3d& b) -> Eigen::Array3d {
    return (b > 0.0).select(a / b, 0.0);  // a column that is solved to the last bit stays as it is
  };
  Solution s;
  s.displacement = Columns::Zero(force.rows(), 3);
  Columns rest = force, direction = Columns::Zero(force.rows(), 3);
  Eigen::Array3d before = Eigen::Array3d::Zero();
  for (;; ++s.iterations) {
    s.residual = quotient(rest.colwise().norm().transpose().array(), scale.transpose().array()).maxCoeff();
    s.converged = s.residual <= options.tolerance;
    if (s.converged || s.iterations == options.most_iterations || !std::isfinite(s.residual)) return s;
    const Columns correction = inverse(rest);
    const Eigen::Array3d now = dot(rest, correction);
    direction = correction + direction * quotient(now, before).matrix().asDiagonal();
    const Columns reaction = matrix * direction;
    const Eigen::Array3d step = quotient(now, dot(direction, reaction));
    s.displacement += direction * step.matrix().asDiagonal();
    rest -= reaction * step.matrix().asDiagonal();
    before = now;
  }
}

/// A^T D delta / area; what is smaller than the solution is exact is nothing.
PlaneStiffness stiffness_of(const LinearBonds& bonds, const Columns& delta, double area, double nothing) {
  const Eigen::Matrix3d c = bonds.affine.transpose() * bonds.stiffness.asDiagonal() * delta / area;
  PlaneStiffness result{};
  for (std::size_t a = 0; a < 3; ++a)
    for (std::size_t b = 0; b < 3; ++b) {
      const double value = c(static_cast<Index>(a), static_cast<Index>(b));
      result[a][b] = std::fabs(value) > nothing ? value : 0.0;
    }
  return result;
}

double largest(const PlaneStiffness& c) {
  return std::max({c[0][0], c[1][1], c[2][2]});
}

/// Columns as the response keeps them: mean displacement zero, rotations in rad.
std::array<std::vector<double>, 3> displacements_of(const Columns& solution, double rotation_length) {
  std::array<std::vector<double>, 3> result;
  const Index discs = solution.rows() / 3;
  for (std::size_t e = 0; e < 3; ++e) {
    result[e].resize(static_cast<std::size_t>(solution.rows()));
    const Eigen::VectorXd column = solution.col(static_cast<Index>(e));
    Eigen::Map<Eigen::Matrix<double, Eigen::Dynamic, 3, Eigen::RowMajor>> rows(result[e].data(), discs, 3);
    rows = Eigen::Map<const Eigen::Matrix<double, Eigen::Dynamic, 3, Eigen::RowMajor>>(column.data(), discs, 3);
    rows.col(2) /= rotation_length;
    for (Index k = 0; k < 2 && discs > 0; ++k) rows.col(k).array() -= rows.col(k).mean();
  }
  return result;
}

}  // namespace

ElasticResponse elastic_response(const BondNetwork& network, std::int32_t discs, double width, double height,
                                 double normal_stiffness, double tangential_stiffness, const ElasticOptions& options) {
  const LinearBonds bonds = linearise(network, discs, normal_stiffness, tangential_stiffness);
  ElasticResponse response;
  response.bonds = static_cast<std::int64_t>(bonds.id.size());
  Solution solution;
  solution.displacement = Columns::Zero(3 * static_cast<Index>(discs), 3);
  if (!bonds.id.empty()) {
    const SparseRows transposed = bonds.displacement.transpose();
    const SparseRows weighted = bonds.stiffness.asDiagonal() * bonds.displacement;
    const SparseRows matrix = transposed * weighted;
    const TwoLevels inverse(matrix, rigid_motions(make_groups(network, discs, bonds.id), bonds.rotation_length));
    const Columns loads = bonds.stiffness.asDiagonal() * bonds.affine;
    const Columns force = -(transposed * loads);
    const Columns magnitudes = transposed.cwiseAbs() * loads.cwiseAbs();
    solution = solve(matrix, inverse, force, magnitudes.colwise().norm(), options);
    if (!solution.converged || !inverse.good()) response.status = ElasticStatus::not_converged;
  }
  response.iterations = solution.iterations;
  response.residual = solution.residual;
  const double area = width * height;
  response.affine_stiffness = stiffness_of(bonds, bonds.affine, area, 0.0);
  const Columns delta = bonds.affine + bonds.displacement * solution.displacement;
  response.stiffness = stiffness_of(bonds, delta, area, options.tolerance * largest(response.affine_stiffness));
  response.moduli = plane_moduli(response.stiffness);
  response.displacement = displacements_of(solution.displacement, bonds.rotation_length);
  return response;
}

ElasticResponse elastic_response(const BondNetwork& network, std::int32_t discs, double width, double height,
                                 const MaterialOptions& material, const ElasticOptions& options) {
  return elastic_response(network, discs, width, height, material.grade * material.normal_stiffness,
                          material.grade * material.tangential_stiffness,
                          options);
}

BondAnswer bond_answer(const BondNetwork& network, std::int64_t bond, const ElasticResponse& response,
                       UnitStrain strain) {
  const auto id = static_cast<std::size_t>(bond);
  const std::vector<double>& u = response.displacement[static_cast<std::size_t>(strain)];
  const double* const ui = &u[3 * static_cast<std::size_t>(network.i[id])];
  const double* const uj = &u[3 * static_cast<std::size_t>(network.j[id])];
  const double nx = network.direction_x[id], ny = network.direction_y[id], l = network.reference_length[id];
  double dx = uj[0] - ui[0], dy = uj[1] - ui[1];
  if (strain == UnitStrain::xx) dx += l * nx;
  if (strain == UnitStrain::yy) dy += l * ny;
  if (strain == UnitStrain::xy) {
    dx += 0.5 * l * ny;
    dy += 0.5 * l * nx;
  }
  return {nx * dx + ny * dy, nx * dy - ny * dx - 0.5 * l * (ui[2] + uj[2])};
}

}  // namespace perfora::solver
