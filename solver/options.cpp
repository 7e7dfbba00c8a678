// What is here: the solver's keys in the table, and checks that reach across keys.
#include "solver/options.h"

#include <fmt/format.h>

#include <cmath>

#include "solver/noise.h"

namespace perfora::solver {

using io::Dimension;
using io::Range;

void describe(io::Schema& schema, SolverOptions& options) {
  schema.renamed({"material.critical_normal_stretch", "material.critical_normal_displacement"});
  schema.renamed({"test", "material_test"});
  MaterialOptions& material = options.material;
  schema
      .section("material",
               "Bonds, contacts and density; defaults are the paper's Table 1 (two-dimensional, per metre of depth).")
      .real("horizon", material.horizon, Dimension::none, {1.0, 10.0, false, false},
            "Bond radius r_H over the mean disc diameter.")
      .real("normal_stiffness", material.normal_stiffness, Dimension::stiffness, Range::positive(),
            "k_n of bonds and contacts.")
      .real("tangential_stiffness", material.tangential_stiffness, Dimension::stiffness, Range::positive(),
            "k_t of bonds and contacts.")
      .real("critical_normal_displacement", material.critical_normal_displacement, Dimension::length, Range::positive(),
            "delta_n^0: bond extension at first yield in pure tension, for the reference mean diameter.")
      .real("critical_shear_displacement", material.critical_shear_displacement, Dimension::length, Range::positive(),
            "delta_t^0: bond shear displacement at first yield in pure shear, for the reference mean diameter.")
      .real("yield_exponent", material.yield_exponent, Dimension::none, {1.0, 16.0, false, false},
            "alpha of the yield surface, a multiple of 0.5.")
      .real("rupture_delay", material.rupture_delay, Dimension::none, {1.0, 100.0, false, false},
            "zeta_max: the yield surface grows this much before a bond is gone; 1 breaks at once.")
      .choice("damage_form", material.damage_form,
              {{"linear_damage", DamageForm::linear_damage}, {"linear_force", DamageForm::linear_force}},
              "How damage grows with zeta: D linear in zeta, or the force linear in zeta.")
      .choice(
          "damage_in_compression", material.damage_in_compression,
          {{"none", DamageInCompression::none}, {"full", DamageInCompression::full}},
          "Whether damage weakens a bond in compression; full weakens it, and the contact spring grows in its place.")
      .real("friction_coefficient", material.friction_coefficient, Dimension::ratio, Range::between(0.0, 10.0),
            "mu of contacts.")
      .real("viscous_rate", material.viscous_rate, Dimension::ratio, Range::between(0.0, 2.0),
            "beta of contacts: damping 2 beta sqrt(k_n m_eff).")
      .real("density", material.density, Dimension::density, Range::positive(), "Density of the discs.")
      .real("grade", material.grade, Dimension::none, {1e-6, 1e6, false, false},
            "Factor on both stiffnesses with the same critical displacements: E, strengths, stresses and energies are "
            "this many times as large, the curve keeps its shape (docs/user/theory.md, \"Grade, strength, scale\").")
      .real("strength", material.strength, Dimension::none, {1e-3, 1e3, false, false},
            "Factor on both critical displacements: strengths at the same E.")
      .choice("threshold_scaling", material.threshold_scaling,
              {{"none", ThresholdScaling::none},
               {"strength", ThresholdScaling::strength},
               {"toughness", ThresholdScaling::toughness}},
              "Critical displacements for another disc size: unchanged, ~ <d> (same strength), ~ sqrt(<d>) (same "
              "toughness).")
      .real("reference_mean_diameter", material.reference_mean_diameter, Dimension::length, Range::positive(),
            "The <d> that the critical displacements are stated for.")
      .real("characteristic_length", material.characteristic_length, Dimension::length, Range::non_negative(),
            "E G/sigma_t^2 of the solid material, measured at the reference mean diameter; 0: estimated. Walls are "
            "compared with it, nothing else follows from it.");
  NoiseOptions& noise = options.noise;
  schema.section("noise", "Factor on both thresholds of a bond, taken at its midpoint.")
      .choice("kind", noise.kind,
              {{"none", NoiseKind::none}, {"perlin", NoiseKind::perlin}, {"weibull", NoiseKind::weibull}},
              "none; Perlin's improved noise, periodic over the cell; Weibull, independent per bond.")
      .real("length", noise.length, Dimension::length, Range::positive(),
            "Perlin: lattice length l (rounded so that it divides the cell).")
      .choice(
          "mapping", noise.mapping, {{"linear", NoiseMapping::linear}, {"exponential", NoiseMapping::exponential}},
          "Perlin: factor 1 + Delta (noise - 1/2), Delta below 2; or exp(Delta (noise - 1/2)), any Delta, median 1.")
      .real("amplitude", noise.amplitude, Dimension::none, Range::between(0.0, 20.0), "Perlin: Delta.")
      .real("std", noise.deviation, Dimension::ratio, Range::between(0.0, 2.0),
            "Perlin: wanted standard deviation of the factor (exponential: of its logarithm) instead of amplitude (0: "
            "use amplitude).")
      .real("weibull_modulus", noise.weibull_modulus, Dimension::none, {0.5, 1000.0, false, false},
            "Weibull: shape parameter; the mean factor is 1.");
  LoadingOptions& loading = options.loading;
  schema.section("loading", "Oedometric compression: the height falls, the width is held.")
      .real("until", loading.until, Dimension::ratio, {0.0, largest_run_strain, true, false},
            "Engineering strain to run to.")
      .choice("control", loading.control,
              {{"adaptive", LoadingControl::adaptive}, {"constant", LoadingControl::constant}},
              "adaptive: slow before the first peak and in avalanches, faster as the rubble carries more "
              "(docs/user/theory.md, \"Loading rate\"); constant: one rate from transits.")
      .real("rate", loading.rate, Dimension::rate, Range::non_negative(),
            "Strain rate dH/dt/H0, constant; 0: from control and transits.")
      .real("transits", loading.transits, Dimension::none, Range::positive(),
            "Wave transits of the block before the first peak, from its estimated modulus and peak strain: the higher, "
            "the slower the first peak is approached.")
      .real("impact_ratio", loading.impact_ratio, Dimension::ratio, {0.0, 10.0, true, false},
            "adaptive: behind the first peak, impact stress (density x wave speed x height x rate) over the stress "
            "carried: 0.1 for results to rely on, more for a fast search.")
      .real("least_impact", loading.least_impact, Dimension::ratio, {0.0, 1.0, true, false},
            "adaptive: impact stress that is always allowed behind the first peak, over the estimated stress of that "
            "peak, so that a block that carries nothing is not waited for; 0.04 for a fast search.");
  DynamicsOptions& dynamics = options.dynamics;
  schema.section("dynamics", "Integration and damping.")
      .real("cundall_damping", dynamics.cundall_damping, Dimension::ratio, {0.0, 1.0, false, true},
            "Local damping coefficient, per component.")
      .choice(
          "cundall_scope", dynamics.cundall_scope,
          {{"all", CundallScope::all}, {"translation", CundallScope::translation}, {"bonded", CundallScope::bonded}},
          "What it acts on: forces and torques of all discs; forces only; discs with an intact bond only, so that "
          "free grains are slowed by contacts alone.")
      .choice("mass", dynamics.mass, {{"uniform_step", MassScaling::uniform_step}, {"physical", MassScaling::physical}},
              "uniform_step: masses and inertias scaled to nearly one critical step, total mass kept; physical for "
              "wave problems.")
      .real("step_factor", dynamics.step_factor, Dimension::ratio, {0.0, 0.95, true, false},
            "Time step over the critical one.")
      .choice("kernel", dynamics.kernel, {{"openmp", KernelChoice::openmp}, {"reference", KernelChoice::reference}},
              "openmp: vectorised, all threads; reference: plain and sequential, the oracle.")
      .choice(
          "simd", dynamics.simd,
          {{"auto", SimdChoice::automatic},
           {"avx512", SimdChoice::avx512},
           {"avx2", SimdChoice::avx2},
           {"portable", SimdChoice::portable}},
          "Instruction set of the vector kernels; auto: the best this machine has. Equal bits hold on one of them.");
  BoundaryOptions& boundary = options.boundary;
  schema.section("boundary", "What stands at the edges of the block (docs/user/theory.md, \"Boundaries\").")
      .choice("top_bottom", boundary.top_bottom, {{"periodic", TopBottom::periodic}, {"platens", TopBottom::platens}},
              "periodic; rigid platens: compression and friction, no tension.")
      .choice("sides", boundary.sides, {{"periodic", Sides::periodic}, {"walls", Sides::walls}, {"free", Sides::free}},
              "periodic; rigid walls that stay where they are; free to bulge and to shed fragments.")
      .real("platen_friction", boundary.platen_friction, Dimension::ratio, Range::between(0.0, 10.0),
            "mu of a disc on a platen.")
      .real("wall_friction", boundary.wall_friction, Dimension::ratio, Range::between(0.0, 10.0),
            "mu of a disc on a side wall.")
      .real(
          "crushed_bottom", boundary.crushed_bottom, Dimension::length, Range::non_negative(),
          "Height of a band at the bottom that is crushed already: its bonds are not made, and not counted as broken.")
      .real("crushed_top", boundary.crushed_top, Dimension::length, Range::non_negative(), "The same at the top.");
  OutputOptions& output = options.output;
  schema.section("output", "What a run file holds.")
      .choice("frames", output.frames,
              {{"none", FrameChoice::none}, {"few", FrameChoice::few}, {"all", FrameChoice::all}},
              "none; few: start, first peak, every 5 % and the end; all: every 1 % beside those.")
      .real_list("frame_strains", output.frame_strains, Dimension::ratio, Range::between(0.0, 0.9),
                 "Strains of frames instead of `frames`.")
      .path("curve", output.curve,
            "Measured curve (CSV: strain [%], stress [MPa]) that pictures show beside those of the runs.")
      .real("history_interval", output.history_interval, Dimension::ratio, {1e-6, 0.1, false, false},
            "Strain between samples of the history. It changes nothing of the run; a coarse one smooths the curve that "
            "measures are read from.")
      .real("checkpoint_interval", output.checkpoint_interval, Dimension::time, Range::positive(),
            "Wall time between checkpoints.")
      .choice("frame_data", output.frame_data, {{"few", FrameData::few}, {"all", FrameData::all}},
              "few: positions, angles, fragments, damage, bonds; all: also velocities, stresses of discs, forces of "
              "bonds and contacts. It changes nothing of the run.");
  TestOptions& test = options.test;
  schema
      .section("material_test",
               "Tests of the solid material (perfora test, perfora calibrate) on a square periodic sample.")
      .real("size", test.size, Dimension::length, Range::positive(), "Side of the sample.")
      .boolean("tension", test.tension, "Uniaxial tension with stress-free sides.")
      .boolean("compression", test.compression, "Uniaxial compression with stress-free sides.")
      .boolean("shear", test.shear, "Simple shear without normal stress.")
      .boolean("oedometric", test.oedometric, "Compression with the width held.")
      .real("past_peak", test.past_peak, Dimension::none, {1.1, 100.0, false, false},
            "A compression test ends at this many times the strain of its peak.");
}

void validate(const SolverOptions& options, const io::Schema& schema) {
  const double twice_alpha = 2.0 * options.material.yield_exponent;
  if (twice_alpha != std::floor(twice_alpha))
    throw io::InputError(schema.origin("material.yield_exponent"), "alpha is not a multiple of 0.5",
                         "allowed are 1, 1.5, 2, ... 16", "take the nearest of them");
  const NoiseOptions& noise = options.noise;
  if (noise.kind != NoiseKind::perlin || noise.mapping != NoiseMapping::linear) return;
  if (perlin_amplitude(noise) >= largest_perlin_amplitude()) {
    const bool by_std = noise.deviation > 0.0;
    throw io::InputError(schema.origin(by_std ? "noise.std" : "noise.amplitude"),
                         "a bond could get a threshold factor of zero or less",
                         fmt::format("{} must stay below {:.4g} with the linear mapping", by_std ? "std" : "amplitude",
                                     by_std ? largest_perlin_deviation() : largest_perlin_amplitude()),
                         "lower it, or take mapping = \"exponential\" or kind = \"weibull\" for wider spreads");
  }
}

}  // namespace perfora::solver
