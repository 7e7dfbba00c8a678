// What is here: the tables of labels. What is not: how they are printed (summary_text.cpp).
#include "results/summary_labels.h"

namespace perfora::results {
namespace {

using enum io::Dimension;

constexpr Label packing[] = {
    {"discs", "discs", count},
    {"perforations", "perforations", count},
    {"mean_diameter", "mean diameter", length},
    {"solid_fraction", "solid fraction of the packing", ratio},
    {"porosity", "porosity (share of the perforations)", ratio},
    {"bonds_per_disc", "bonds per disc", none},
    {"thinnest_wall", "thinnest wall", length},
    {"thinnest_wall_discretised", "thinnest wall between the discs", length},
    {"max_overlap_ratio", "largest overlap / smaller diameter", none},
    {"coordination_number", "coordination number", none},
    {"rattler_fraction", "rattlers", ratio},
};

constexpr Label curve[] = {
    {"first_peak_stress", "first peak stress", stress},
    {"first_peak_strain", "first peak strain", ratio},
    {"stress_drop_ratio", "smallest stress after it / peak", ratio},
    {"plateau_stress", "plateau stress", stress},
    {"minimum_stress_in_window", "smallest stress in the window", stress},
    {"undulation", "undulation", ratio},
    {"densification_strain", "densification strain", ratio},
    {"efficiency_strain", "strain of largest efficiency", ratio},
    {"only_rising_strain", "stress only rises from strain", ratio},
    {"recovery_strain", "half the first peak again at strain", ratio},
    {"intermediate_peaks", "peaks behind the first", count},
    {"energy_absorbed", "energy absorbed to window end", energy_density},
    {"cundall_share", "share of Cundall damping in the work", ratio},
};

constexpr Label damage[] = {
    {"broken_bonds", "broken bonds", count},
    {"broken_in_tension", "  in tension", count},
    {"broken_in_shear", "  in shear", count},
    {"fragments", "fragments", count},
    {"largest_fragment_fraction", "largest fragment (of the solid)", ratio},
};

constexpr Label run[] = {
    {"final_strain", "strain reached", ratio},
    {"steps", "steps", count},
    {"time_step", "time step", time},
    {"rate", "mean strain rate", rate},
    {"smallest_rate", "  smallest", rate},
    {"largest_rate", "  largest", rate},
    {"energy_residual", "energy residual", ratio},
    {"max_overlap_in_run", "largest overlap / mean diameter", ratio},
    {"transits_before_peak", "wave transits before the peak", none},
    {"kinetic_ratio_at_peak", "kinetic / elastic energy at the peak", ratio},
    {"step_margin", "critical step / step", none},
};

constexpr Label elastic[] = {
    {"bonds", "bonds", count},
    {"young_x", "Young's modulus, stress along x", stress},
    {"young_y", "Young's modulus, stress along y", stress},
    {"poisson_xy", "contraction in y, stress along x", none},
    {"poisson_yx", "contraction in x, stress along y", none},
    {"shear_modulus", "shear modulus", stress},
    {"oedometric_modulus", "modulus along y, width held", stress},
    {"affine_share", "  share of the affine (Voigt) bound", ratio},
    {"anisotropy", "anisotropy", ratio},
    {"isotropic_young", "nearest isotropic: Young's modulus", stress},
    {"isotropic_poisson", "  Poisson's ratio", none},
    {"plane_strain_young", "  read as plane strain: E", stress},
    {"plane_strain_poisson", "  nu", none},
};

constexpr Label first_yield[] = {
    {"first_yield_strain", "strain", ratio},
    {"first_yield_stress", "stress", stress},
    {"first_yield_lateral_stress", "lateral stress", stress},
    {"first_yield_mode", "first bond yields in", none},
    {"first_yield_bonds", "bonds within 2 % of its strain", count},
};

constexpr Label solution[] = {
    {"iterations", "iterations", count},
    {"residual", "forces left over forces that meet", none},
};

constexpr Label search[] = {
    {"score", "score", none},
    {"target", "target", stress},
    {"evaluations", "evaluations", count},
    {"stop_reason", "stopped because", none},
};

constexpr Label material[] = {
    {"young_modulus", "Young's modulus E (2D)", stress},
    {"poisson_ratio", "Poisson's ratio nu (2D)", none},
    {"young_modulus_plane_strain", "E, plane-strain reading", stress},
    {"poisson_ratio_plane_strain", "nu, plane-strain reading", none},
    {"shear_modulus", "shear modulus G", stress},
    {"oedometric_modulus", "oedometric modulus C11", stress},
    {"tensile_strength", "tensile strength", stress},
    {"compressive_strength", "compressive strength", stress},
    {"strength_ratio", "compressive / tensile strength", none},
    {"shear_strength", "shear strength", stress},
    {"oedometric_strength", "oedometric strength", stress},
    {"fracture_energy", "fracture energy", surface_energy},
    {"characteristic_length", "characteristic length E G / ft^2", length},
};

constexpr Label estimate[] = {
    {"perforations", "perforations", count},
    {"porosity", "porosity (share of the perforations)", ratio},
    {"thinnest_wall", "thinnest wall", length},
    {"horizon_radius", "horizon r_H", length},
    {"discs", "discs", count},
    {"bonds", "bonds", count},
    {"bonds_per_disc", "bonds per disc", none},
    {"time_step", "time step", time},
    {"rate", "mean strain rate", rate},
    {"steps", "steps", count},
    {"memory", "memory", memory},
    {"disk", "disk", memory},
};

}  // namespace

std::span<const Label> packing_labels() {
  return packing;
}
std::span<const Label> curve_labels() {
  return curve;
}
std::span<const Label> damage_labels() {
  return damage;
}
std::span<const Label> run_labels() {
  return run;
}
std::span<const Label> elastic_labels() {
  return elastic;
}
std::span<const Label> first_yield_labels() {
  return first_yield;
}
std::span<const Label> solution_labels() {
  return solution;
}
std::span<const Label> search_labels() {
  return search;
}
std::span<const Label> material_labels() {
  return material;
}
std::span<const Label> estimate_labels() {
  return estimate;
}

io::Dimension dimension_of(std::string_view key) {
  for (const auto labels : {curve_labels(), damage_labels(), run_labels(), packing_labels(), material_labels()})
    for (const Label& one : labels)
      if (one.key == key) return one.dimension;
  return none;
}

}  // namespace perfora::results
