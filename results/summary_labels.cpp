// What is here: the tables of labels; those of packings and runs come from the table of measures. What is not: how they
// are printed (summary_text.cpp).
#include "results/summary_labels.h"

#include <vector>

#include "results/measure_table.h"

namespace perfora::results {
namespace {

using enum io::Dimension;

/// The printed measures of a group as labels.
std::vector<Label> labels_of(MeasureGroup group) {
  std::vector<Label> labels;
  for (const Measure& measure : measures())
    if (measure.group == group) labels.push_back({measure.key, measure.label, measure.dimension});
  return labels;
}

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
    {"score", "search score (smaller is better)", none},
    {"target", "target", stress},
    {"evaluations", "evaluations in all", count},
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
    {"width", "width of the block", length},
    {"height", "height of the block", length},
    {"perforations", "holes", count},
    {"porosity", "porosity (share of the holes)", ratio},
    {"thinnest_wall", "thinnest wall", length},
    {"thinnest_wall_ratio", "thinnest wall / characteristic length", none},
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
  static const std::vector<Label> labels = labels_of(MeasureGroup::packing);
  return labels;
}
std::span<const Label> curve_labels() {
  static const std::vector<Label> labels = labels_of(MeasureGroup::curve);
  return labels;
}
std::span<const Label> damage_labels() {
  static const std::vector<Label> labels = labels_of(MeasureGroup::breakage);
  return labels;
}
std::span<const Label> run_labels() {
  static const std::vector<Label> labels = labels_of(MeasureGroup::run);
  return labels;
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
  if (const Measure* measure = measure_called(key)) return measure->dimension;
  for (const Label& one : material_labels())
    if (one.key == key) return one.dimension;
  return none;
}

}  // namespace perfora::results
