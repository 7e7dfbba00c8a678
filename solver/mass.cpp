// What is here: mass scaling, critical step, loading estimate.
#include "solver/mass.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>
#include <numeric>

#include "solver/laws.h"

namespace perfora::solver {
namespace {

struct Stiffness {
  std::vector<double> translation;  // K_i, N/m
  std::vector<double> rotation;     // KR_i, N m
};

Stiffness disc_stiffness(const std::vector<double>& contacts, const geometry::Packing& clipped,
                         const BondNetwork& network, const MaterialOptions& material) {
  const std::size_t discs = contacts.size();
  Stiffness k{std::vector<double>(discs), std::vector<double>(discs)};
  // Contacts turn a disc with lever R: keeps the rotation of discs without long bonds bounded.
  for (std::size_t d = 0; d < discs; ++d) {
    k.translation[d] = contacts[d] * material.normal_stiffness;
    k.rotation[d] = contacts[d] * material.tangential_stiffness * clipped.radius[d] * clipped.radius[d];
  }
  for (std::int64_t b = 0; b < network.size(); ++b) {
    const auto id = static_cast<std::size_t>(b);
    const double l = network.reference_length[id];
    for (const std::int32_t end : {network.i[id], network.j[id]}) {
      k.translation[static_cast<std::size_t>(end)] += 0.5 * (material.normal_stiffness + material.tangential_stiffness);
      k.rotation[static_cast<std::size_t>(end)] += 0.25 * material.tangential_stiffness * l * l;
    }
  }
  return k;
}

/// A disc smaller than its neighbours may have as many as one among equals: they need not lie side by side for long.
constexpr double fewest_contacts = 6.0;

/// Radii at these fractions of all discs stand for the sizes that a disc may meet, from the median up.
constexpr std::array<double, 6> size_classes = {0.5, 0.6, 0.7, 0.8, 0.9, 1.0};

/// A radius and the largest mass of the discs up to it, m and kg/m.
struct SizeClass {
  double radius, mass;
};

std::vector<SizeClass> classes_of(const std::vector<double>& radius, const std::vector<double>& mass) {
  std::vector<std::size_t> order(radius.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) { return radius[a] < radius[b]; });
  std::vector<SizeClass> classes;
  double largest_mass = 0.0;
  std::size_t next = 0;
  for (const double fraction : size_classes) {
    const auto last = static_cast<std::size_t>(std::ceil(fraction * static_cast<double>(order.size()))) - 1;
    for (; next <= last; ++next) largest_mass = std::max(largest_mass, mass[order[next]]);
    classes.push_back({radius[order[last]], largest_mass});
  }
  return classes;
}

}  // namespace

double contacts_around(double radius, double neighbour) {
  return std::numbers::pi / std::asin(neighbour / (radius + neighbour));
}

std::vector<double> contacts_to_come(const std::vector<double>& radius) {
  std::vector<double> sorted = radius;
  const auto middle = sorted.begin() + static_cast<std::ptrdiff_t>(sorted.size() / 2);
  std::nth_element(sorted.begin(), middle, sorted.end());
  std::vector<double> contacts;
  contacts.reserve(radius.size());
  for (const double r : radius) contacts.push_back(std::max(fewest_contacts, contacts_around(r, *middle)));
  return contacts;
}

MassProperties make_masses(const geometry::Packing& clipped, const BondNetwork& network,
                           const MaterialOptions& material, const DynamicsOptions& dynamics) {
  const std::size_t n = clipped.x.size();
  const std::vector<double> contacts = contacts_to_come(clipped.radius);
  const Stiffness k = disc_stiffness(contacts, clipped, network, material);
  MassProperties m;
  m.mass.resize(n);
  m.inertia.resize(n);
  const auto weight = [&](std::size_t d) {
    return k.translation[d] + (contact_mass_weight - 1.0) * contacts[d] * material.normal_stiffness;
  };
  double total_stiffness = 0.0;
  for (std::size_t d = 0; d < n; ++d) {
    m.mass[d] = material.density * std::numbers::pi * clipped.radius[d] * clipped.radius[d];
    m.inertia[d] = 0.5 * m.mass[d] * clipped.radius[d] * clipped.radius[d];
    m.total += m.mass[d];
    total_stiffness += weight(d);
  }
  if (dynamics.mass == MassScaling::uniform_step) {
    for (std::size_t d = 0; d < n; ++d) {
      m.mass[d] = m.total * weight(d) / total_stiffness;
      m.inertia[d] = m.mass[d] * k.rotation[d] / k.translation[d];
    }
  }
  double worst = 0.0;
  for (std::size_t d = 0; d < n; ++d)
    worst = std::max(worst, k.translation[d] / m.mass[d] + k.rotation[d] / m.inertia[d]);
  m.critical_step = 2.0 / std::sqrt(2.0 * worst * (1.0 + dynamics.cundall_damping));
  return m;
}

double critical_step_by_power_iteration(const BondNetwork& network, const MassProperties& masses,
                                        const MaterialOptions& material, double cundall_damping, int iterations) {
  const std::size_t n = masses.mass.size();
  std::vector<double> ux(n), uy(n), phi(n), fx(n), fy(n), torque(n);
  for (std::size_t d = 0; d < n; ++d) {  // any start with a part in the highest mode: alternating signs
    ux[d] = (d % 2 ? 1.0 : -1.0);
    uy[d] = (d % 3 ? 1.0 : -1.0);
    phi[d] = (d % 5 ? 1.0 : -1.0) * std::sqrt(masses.mass[d] / masses.inertia[d]);
  }
  double omega_squared = 0.0;
  for (int step = 0; step < iterations; ++step) {
    std::fill(fx.begin(), fx.end(), 0.0);
    std::fill(fy.begin(), fy.end(), 0.0);
    std::fill(torque.begin(), torque.end(), 0.0);
    for (std::int64_t b = 0; b < network.size(); ++b) {
      const auto id = static_cast<std::size_t>(b);
      if (network.state[id] != BondState::intact) continue;
      const auto i = static_cast<std::size_t>(network.i[id]), j = static_cast<std::size_t>(network.j[id]);
      const double nx = network.direction_x[id], ny = network.direction_y[id], l = network.reference_length[id];
      const double dx = ux[j] - ux[i], dy = uy[j] - uy[i];
      const double normal = material.normal_stiffness * (dx * nx + dy * ny);
      const double shear = material.tangential_stiffness * (-dx * ny + dy * nx - 0.5 * l * (phi[i] + phi[j]));
      const double gx = normal * nx - shear * ny, gy = normal * ny + shear * nx;
      fx[i] -= gx;
      fy[i] -= gy;
      fx[j] += gx;
      fy[j] += gy;
      torque[i] -= 0.5 * l * shear;
      torque[j] -= 0.5 * l * shear;
    }
    double numerator = 0.0, denominator = 0.0, norm = 0.0;  // Rayleigh quotient u.K u/u.M u
    for (std::size_t d = 0; d < n; ++d) {
      numerator += ux[d] * fx[d] + uy[d] * fy[d] + phi[d] * torque[d];
      denominator += masses.mass[d] * (ux[d] * ux[d] + uy[d] * uy[d]) + masses.inertia[d] * phi[d] * phi[d];
      ux[d] = fx[d] / masses.mass[d];
      uy[d] = fy[d] / masses.mass[d];
      phi[d] = torque[d] / masses.inertia[d];
      norm += masses.mass[d] * (ux[d] * ux[d] + uy[d] * uy[d]) + masses.inertia[d] * phi[d] * phi[d];
    }
    if (!(norm > 0.0)) return std::numeric_limits<double>::infinity();
    omega_squared = numerator / denominator;
    const double scale = 1.0 / std::sqrt(norm);
    for (std::size_t d = 0; d < n; ++d) {
      ux[d] *= scale;
      uy[d] *= scale;
      phi[d] *= scale;
    }
  }
  return 2.0 / std::sqrt(omega_squared * (1.0 + cundall_damping));
}

double contact_critical_step(const MassProperties& masses, const std::vector<double>& radius,
                             const MaterialOptions& material, double cundall_damping) {
  const std::vector<double> contacts = contacts_to_come(radius);
  const std::vector<SizeClass> classes = classes_of(radius, masses.mass);
  double least = std::numeric_limits<double>::infinity();
  for (std::size_t d = 0; d < radius.size(); ++d) {
    const double m = masses.mass[d];
    double root = 0.0;  // sum over the contacts of sqrt(m_eff), of the sizes that make it largest
    for (const SizeClass& other : classes) {
      const double effective = m * other.mass / (m + other.mass);
      root = std::max(root, std::min(contacts[d], contacts_around(radius[d], other.radius)) * std::sqrt(effective));
    }
    const double k = contacts[d] * material.normal_stiffness * (1.0 + cundall_damping);
    const double c =
        2.0 * material.viscous_rate * std::sqrt(material.normal_stiffness) * root * (1.0 + cundall_damping);
    least = std::min(least, (std::sqrt(c * c + 4.0 * k * m) - c) / k);
  }
  return least;
}

double voigt_modulus(const MaterialOptions& material, double bond_density) {
  return bond_density * (3.0 * material.normal_stiffness + material.tangential_stiffness) / 8.0;
}

LoadingEstimate estimate_loading(const BlockMeans& block, const SolverOptions& options) {
  LoadingEstimate e;
  // Voigt's bound over the whole cell already holds the fraction of solid; the walls between holes also bend, which
  // takes about one more power of it: measured 0.51 of Voigt on the 2 x 2 square cell, 0.43 by this rule
  // (docs/user/theory.md).
  e.modulus = network_ratio * block.voigt_modulus * (1.0 - block.porosity);
  e.bulk_density = block.bulk_density;
  e.wave_speed = std::sqrt(e.modulus / e.bulk_density);
  // Walls shear off when bonds of mean length reach delta_t^0; with a spread of strengths, earlier by about that
  // spread.
  constexpr double least_strength = 0.25;  // keeps the rate finite for very wide spreads
  e.peak_strain = options.material.critical_shear_displacement *
                  threshold_factor(options.material, block.mean_diameter) / block.mean_bond_length *
                  std::max(least_strength, block.strength);
  e.rate = e.peak_strain * e.wave_speed / (options.loading.transits * block.height);
  return e;
}

LoadingEstimate estimate_loading(const BondNetwork& network, const MassProperties& masses, const SolverOptions& options,
                                 double width, double height, double porosity, double mean_diameter) {
  const MaterialOptions& material = options.material;
  double square_lengths = 0.0, lengths = 0.0;
  for (const double l : network.reference_length) {
    square_lengths += l * l;
    lengths += l;
  }
  const StrengthStatistics strength = strength_statistics(network);
  BlockMeans block;
  block.voigt_modulus = voigt_modulus(material, square_lengths / (width * height));
  block.porosity = porosity;
  block.bulk_density = masses.total / (width * height);
  block.mean_bond_length = network.size() > 0 ? lengths / static_cast<double>(network.size()) : mean_diameter;
  block.mean_diameter = mean_diameter;
  block.height = height;
  block.strength = strength.mean - strength.deviation;
  return estimate_loading(block, options);
}

}  // namespace perfora::solver
