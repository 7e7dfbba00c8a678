// What is here: see linear_net.h.
#include "tests/verification/linear_net.h"

#include <Eigen/Dense>
#include <cmath>

namespace perfora::verification {
namespace {

double dot(const std::vector<double>& a, const std::vector<double>& b) {
  double sum = 0.0;
  for (std::size_t k = 0; k < a.size(); ++k) sum += a[k] * b[k];
  return sum;
}

}  // namespace

LinearNet::LinearNet(const solver::BondNetwork& network, int discs, const solver::MaterialOptions& material,
                     double width, double height)
    : discs_(discs),
      normal_stiffness_(material.normal_stiffness),
      tangential_stiffness_(material.tangential_stiffness),
      width_(width),
      height_(height) {
  double sum = 0.0;
  for (std::size_t b = 0; b < network.i.size(); ++b) {
    bonds_.push_back(
        {network.i[b], network.j[b], network.direction_x[b], network.direction_y[b], network.rest_length[b]});
    sum += network.rest_length[b];
  }
  scale_ = sum / static_cast<double>(bonds_.size());
}

// Unknowns of disc d: u[3d], u[3d+1] displacement, u[3d+2] turn times scale_.
LinearNet::BondForce LinearNet::force(const Bond& b, const std::vector<double>& u, const Tensor& strain) const {
  const double* a = &u[3 * static_cast<std::size_t>(b.i)];
  const double* c = &u[3 * static_cast<std::size_t>(b.j)];
  const double dx = c[0] - a[0] + b.length * (strain.xx * b.nx + strain.xy * b.ny),
               dy = c[1] - a[1] + b.length * (strain.xy * b.nx + strain.yy * b.ny);
  return {normal_stiffness_ * (dx * b.nx + dy * b.ny),
          tangential_stiffness_ * (-dx * b.ny + dy * b.nx - 0.5 * b.length / scale_ * (a[2] + c[2]))};
}

void LinearNet::forces(const std::vector<double>& u, const Tensor& strain, std::vector<double>& f) const {
  std::fill(f.begin(), f.end(), 0.0);
  for (const Bond& b : bonds_) {
    const BondForce g = force(b, u, strain);
    const double gx = g.normal * b.nx - g.shear * b.ny, gy = g.normal * b.ny + g.shear * b.nx,
                 torque = 0.5 * b.length / scale_ * g.shear;
    double* a = &f[3 * static_cast<std::size_t>(b.i)];
    double* c = &f[3 * static_cast<std::size_t>(b.j)];
    a[0] += gx;
    a[1] += gy;
    a[2] += torque;
    c[0] -= gx;
    c[1] -= gy;
    c[2] += torque;
  }
}

std::vector<double> LinearNet::inverse_diagonal_blocks() const {
  std::vector<Eigen::Matrix3d> blocks(static_cast<std::size_t>(discs_), Eigen::Matrix3d::Zero());
  for (const Bond& b : bonds_) {
    const Eigen::Vector3d normal(b.nx, b.ny, 0.0);
    for (const int end : {b.i, b.j}) {
      const double sign = end == b.j ? 1.0 : -1.0;
      const Eigen::Vector3d shear(-sign * b.ny, sign * b.nx, -0.5 * b.length / scale_);
      blocks[static_cast<std::size_t>(end)] += normal_stiffness_ * normal * normal.transpose() +
                                               tangential_stiffness_ * shear * shear.transpose();
    }
  }
  std::vector<double> inverse;
  inverse.reserve(9 * blocks.size());
  for (Eigen::Matrix3d& block : blocks) {
    // A disc without bonds (none is left over in these packings) or with one only would be singular.
    block.diagonal().array() += 1e-9 * normal_stiffness_;
    const Eigen::Matrix3d m = block.inverse();
    inverse.insert(inverse.end(), m.data(), m.data() + 9);
  }
  return inverse;
}

NetState LinearNet::relax(const Tensor& strain) const {
  constexpr double wanted = 1e-8;
  constexpr int most = 20000;
  const std::size_t n = 3 * static_cast<std::size_t>(discs_);
  const std::vector<double> inverse = inverse_diagonal_blocks();
  const auto precondition = [&](const std::vector<double>& r, std::vector<double>& z) {
    for (std::size_t d = 0; d < n / 3; ++d)
      for (std::size_t row = 0; row < 3; ++row)
        z[3 * d + row] = inverse[9 * d + row] * r[3 * d] + inverse[9 * d + 3 + row] * r[3 * d + 1] +
                         inverse[9 * d + 6 + row] * r[3 * d + 2];
  };
  std::vector<double> u(n), r(n), z(n), p(n), q(n);
  forces(u, strain, r);
  precondition(r, z);
  p = z;
  double rz = dot(r, z);
  const double start = std::sqrt(dot(r, r));
  NetState s;
  s.strain = strain;
  s.residual = start > 0.0 ? 1.0 : 0.0;
  while (s.residual > wanted && s.iterations < most) {
    forces(p, {}, q);  // -K p
    const double step = -rz / dot(p, q);
    for (std::size_t k = 0; k < n; ++k) {
      u[k] += step * p[k];
      r[k] += step * q[k];
    }
    precondition(r, z);
    const double next = dot(r, z);
    for (std::size_t k = 0; k < n; ++k) p[k] = z[k] + next / rz * p[k];
    rz = next;
    s.residual = std::sqrt(dot(r, r)) / start;
    ++s.iterations;
  }
  for (std::size_t d = 0; d < n / 3; ++d) {
    s.ux.push_back(u[3 * d]);
    s.uy.push_back(u[3 * d + 1]);
    s.turn.push_back(u[3 * d + 2] / scale_);
  }
  for (const Tensor& v : disc_virials(s)) {
    s.stress.xx += v.xx / area();
    s.stress.yy += v.yy / area();
    s.stress.xy += v.xy / area();
  }
  return s;
}

std::vector<Tensor> LinearNet::disc_virials(const NetState& state) const {
  std::vector<double> u;
  for (std::size_t d = 0; d < state.ux.size(); ++d) {
    u.push_back(state.ux[d]);
    u.push_back(state.uy[d]);
    u.push_back(state.turn[d] * scale_);
  }
  std::vector<Tensor> virial(static_cast<std::size_t>(discs_));
  for (const Bond& b : bonds_) {
    const BondForce g = force(b, u, state.strain);
    const double gx = g.normal * b.nx - g.shear * b.ny, gy = g.normal * b.ny + g.shear * b.nx;
    for (const int end : {b.i, b.j}) {
      Tensor& v = virial[static_cast<std::size_t>(end)];
      v.xx += 0.5 * gx * b.length * b.nx;
      v.yy += 0.5 * gy * b.length * b.ny;
      v.xy += 0.25 * b.length * (gx * b.ny + gy * b.nx);
    }
  }
  return virial;
}

Tensor LinearNet::affine_stress(const Tensor& strain) const {
  NetState s;
  s.strain = strain;
  s.ux.assign(static_cast<std::size_t>(discs_), 0.0);
  s.uy = s.turn = s.ux;
  Tensor sum;
  for (const Tensor& v : disc_virials(s)) {
    sum.xx += v.xx / area();
    sum.yy += v.yy / area();
    sum.xy += v.xy / area();
  }
  return sum;
}

namespace {
template <class Response>
Stiffness stiffness_of(const Response& stress) {
  const Tensor x = stress(Tensor{1.0, 0.0, 0.0}), y = stress(Tensor{0.0, 1.0, 0.0}), xy = stress(Tensor{0.0, 0.0, 0.5});
  return {x.xx, y.xx, x.yy, y.yy, xy.xy};
}
}  // namespace

Stiffness measure(const LinearNet& net) {
  return stiffness_of([&](const Tensor& strain) { return net.relax(strain).stress; });
}

Stiffness voigt(const LinearNet& net) {
  return stiffness_of([&](const Tensor& strain) { return net.affine_stress(strain); });
}

}  // namespace perfora::verification
