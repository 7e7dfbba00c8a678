// What is here: the table of measures and its orders. What is not: how measures are computed, printed or drawn.
#include "results/measure_table.h"

#include <fmt/format.h>

#include <algorithm>
#include <limits>
#include <vector>

#include "io/schema.h"
#include "io/units.h"

namespace perfora::results {
namespace {

using enum io::Dimension;
using enum MeasureGroup;

double thinnest_wall(const PackSummary& pack) {
  return pack.thinnest_wall.first < 0 ? std::numeric_limits<double>::infinity() : pack.thinnest_wall.thickness;
}

constexpr Measure table[] = {
    {"discs", &PackSummary::discs, count, packing, "discs", "discs after clipping", 0, 1},
    {"perforations", &PackSummary::perforations, count, packing, "holes", "holes of the layout", 0, 2},
    {"mean_diameter", &PackSummary::mean_diameter, length, packing, "mean diameter",
     "number mean of the disc diameters"},
    {"solid_fraction", &PackSummary::solid_fraction, ratio, packing, "solid fraction of the packing",
     "area of the discs over that of the cell, before clipping", 0, 5},
    {"porosity", &PackSummary::porosity, ratio, packing, "porosity (share of the holes)",
     "area of the holes over that of the cell", 0, 3, Sense::within},
    {"bonds_per_disc", &PackSummary::bonds_per_disc, none, packing, "bonds per disc", "twice the bonds over the discs",
     0, 6},
    {"thinnest_wall", thinnest_wall, length, packing, "thinnest wall",
     "smallest gap between two holes; null without holes", 0, 4, Sense::at_least},
    {"thinnest_wall_discretised", &PackSummary::thinnest_wall_discretised, length, packing,
     "thinnest wall between the discs", "the same between the discs that clipping has left"},
    {"thinnest_wall_ratio", &PackSummary::wall_ratio, none, packing, "thinnest wall / characteristic length",
     "thinnest wall over E G/sigma_t^2 of the material, measured (material.characteristic_length) or estimated; null "
     "without holes"},
    {"max_overlap_ratio", &PackSummary::max_overlap_ratio, none, packing, "largest overlap / smaller diameter",
     "of two discs of the packing"},
    {"coordination_number", &PackSummary::coordination_number, none, packing, "coordination number",
     "contacts per disc of the packing, rattlers left out"},
    {"rattler_fraction", &PackSummary::rattler_fraction, ratio, packing, "rattlers",
     "share of the discs with fewer than three contacts"},
    {"first_peak_stress", &Summary::first_peak_stress, stress, curve, "first peak stress",
     "largest stress before the first fall", 2, 0, Sense::at_most, Term::logarithm_above},
    {"first_peak_strain", &Summary::first_peak_strain, ratio, curve, "first peak strain", "strain of the first peak",
     3},
    {"stress_drop_ratio", &Summary::stress_drop_ratio, ratio, curve, "smallest stress after it / peak",
     "smallest stress after the first peak (before twice its strain + 1 %) over the peak"},
    {"plateau_stress", &Summary::plateau_stress, stress, curve, "plateau stress", "mean stress over the plateau window",
     1, 0, Sense::within},
    {"minimum_stress_in_window", &Summary::minimum_stress_in_window, stress, curve, "smallest stress in the window",
     "smallest stress within the plateau window", 4, 0, Sense::at_least, Term::logarithm_below},
    {"undulation", &Summary::undulation, ratio, curve, "undulation",
     "ULC: mean distance from the plateau stress within the window, over the plateau stress", 5, 0, Sense::at_most,
     Term::square},
    {"smallest_over_mean", &Summary::smallest_over_mean, ratio, curve, "smallest smoothed stress / plateau",
     "smallest stress within the window, smoothed over measures.smoothing, over the plateau stress", 11, 0,
     Sense::at_least, Term::logarithm},
    {"largest_over_mean", &Summary::largest_over_mean, ratio, curve, "largest smoothed stress / plateau",
     "the same for the largest", 12, 0, Sense::at_most, Term::logarithm},
    {"slope", &Summary::slope, none, curve, "slope (stress at end / at start)",
     "of the line fitted within the window: its stress at the end over that at the start; null where that is not above "
     "zero",
     13, 0, Sense::within, Term::logarithm},
    {"cap_ratio", &Summary::cap_ratio, none, curve, "cap ratio (largest stress / plateau)",
     "largest stress from 0 to the end of the window, the first peak included, over the plateau stress", 14, 0,
     Sense::at_most, Term::logarithm},
    {"crush_force_efficiency", &Summary::crush_force_efficiency, ratio, curve, "crush force efficiency",
     "plateau stress over first peak stress", 0, 0, Sense::at_least, Term::logarithm},
    {"trough_stress", &Summary::trough_stress, stress, curve, "trough before the plateau",
     "smallest smoothed stress from the first peak to the start of the window", 15, 0, Sense::at_least,
     Term::logarithm_below},
    {"target_distance", &Summary::target_distance, none, curve, "distance to the target",
     "root of the mean square of ln(smoothed stress / target) within the window; 0.22 is 25 % off throughout", 0, 0,
     Sense::at_most, Term::square},
    {"found_plateau_stress", &Summary::found_plateau_stress, stress, curve, "found plateau",
     "mean stress of the found plateau: the longest flat interval between first peak and densification", 16, 0,
     Sense::within},
    {"found_plateau_start", &Summary::found_plateau_start, ratio, curve, "  from strain", "start of the found plateau",
     17, 0, Sense::at_most},
    {"found_plateau_end", &Summary::found_plateau_end, ratio, curve, "  to strain", "end of the found plateau", 18, 0,
     Sense::at_least},
    {"found_plateau_length", &Summary::found_plateau_length, ratio, curve, "  length",
     "length of the found plateau in strain; 0 where there is none", 19, 0, Sense::at_least, Term::shortfall},
    {"stroke_at_cap", &Summary::stroke_at_cap, ratio, curve, "stroke at the cap",
     "strain at which the stress is last below target.cap; the end of the run where it stays below", 0, 0,
     Sense::at_least, Term::shortfall},
    {"stress_until", &Summary::stress_until, stress, curve, "largest stress up to the strain asked",
     "largest stress from 0 to the strain of target.limit.stress_until, the first peak included", 0, 0, Sense::at_most,
     Term::logarithm_above},
    {"densification_strain", &Summary::densification_strain, ratio, curve, "densification strain",
     "from where on the stress stays above 1.3 times the plateau stress (ISO 13314: the end of the plateau)", 6, 0,
     Sense::at_least, Term::shortfall},
    {"efficiency_strain", &Summary::efficiency_strain, ratio, curve, "strain of largest efficiency",
     "where absorbed energy over the largest stress so far is largest; the end of the run where it still grows there",
     0, 0, Sense::at_least, Term::shortfall},
    {"densification_onset", &Summary::densification_onset, ratio, curve, "onset of densification",
     "the same of the smoothed stress from the foot of the first peak on (Li et al. 2006)", 20, 0, Sense::at_least,
     Term::shortfall},
    {"only_rising_strain", &Summary::only_rising_strain, ratio, curve, "stress only rises from strain",
     "from here on the smoothed stress never falls by more than a tenth"},
    {"recovery_strain", &Summary::recovery_strain, ratio, curve, "half the first peak again at strain",
     "where the smoothed stress, once below half the first peak, reaches that again"},
    {"intermediate_peaks", &Summary::intermediate_peaks, count, curve, "peaks behind the first",
     "number of peaks behind the first that stand 5 % of it above their valleys"},
    {"energy_absorbed", &Summary::energy_absorbed, energy_density, curve, "energy absorbed to window end",
     "external work per area of the cell up to the end of the plateau window", 7, 0, Sense::at_least},
    {"cundall_share", &Summary::cundall_fraction, ratio, curve, "share of Cundall damping in the work",
     "of the external work up to the end of the plateau window, or of the run where it ends before", 8, 0,
     Sense::at_most, Term::square},
    {"broken_in_window", &Summary::broken_in_window, count, curve, "bonds broken in the window",
     "bonds that break within the plateau window"},
    {"damage_stress", &Summary::damage_stress, stress, curve, "stress from damage",
     "energy of broken bonds over the plateau window, per area of the block and strain"},
    {"friction_stress", &Summary::friction_stress, stress, curve, "stress from friction", "the same for friction"},
    {"viscous_stress", &Summary::viscous_stress, stress, curve, "stress from contact dashpots",
     "the same for the viscous part of contacts"},
    {"cundall_stress", &Summary::cundall_stress, stress, curve, "stress from Cundall damping",
     "the same for Cundall damping"},
    {"impact_stress", &Summary::impact_stress, stress, curve, "impact stress in the window",
     "bulk density x wave speed x height x mean strain rate in the plateau window"},
    {"impact_ratio", &Summary::impact_ratio, ratio, curve, "impact stress / plateau stress",
     "0.1 or less for a plateau that the rate does not carry", 0, 0, Sense::at_most},
    {"broken_bonds", &Summary::broken_bonds, count, breakage, "broken bonds", "bonds broken in the run", 9},
    {"broken_in_tension", &Summary::broken_in_tension, count, breakage, "  in tension",
     "of these: normal displacement beyond its part of the yield function"},
    {"broken_in_shear", &Summary::broken_in_shear, count, breakage, "  in shear", "the others"},
    {"fragments", &Summary::fragments, count, breakage, "fragments",
     "groups of discs held together by bonds, at the end", 10},
    {"largest_fragment_fraction", &Summary::largest_fragment_fraction, ratio, breakage,
     "largest fragment (of the solid)", "area of the largest fragment over that of all discs, at the end"},
    {"final_strain", &Summary::final_strain, ratio, run, "strain reached", "strain at the end of the run"},
    {"steps", &Summary::steps, count, run, "steps", "time steps of the run"},
    {"time_step", &Summary::time_step, time, run, "time step", "length of a time step"},
    {"rate", &Summary::rate, rate, run, "mean strain rate", "strain over time, of the run"},
    {"smallest_rate", &Summary::smallest_rate, rate, run, "  smallest", "of all rows of the history"},
    {"largest_rate", &Summary::largest_rate, rate, run, "  largest", "of all rows of the history"},
    {"energy_residual", &Summary::energy_residual, ratio, run, "energy residual",
     "largest difference of external work and the sum of all energies over the work so far"},
    {"max_overlap_in_run", &Summary::max_overlap_in_run, ratio, run, "largest overlap / mean diameter",
     "of two discs without a bond, over the run"},
    {"transits_before_peak", &Summary::transits_before_peak, none, run, "wave transits before the peak",
     "times that a wave could cross the block before the first peak"},
    {"kinetic_ratio_at_peak", &Summary::kinetic_ratio_at_peak, ratio, run, "kinetic / elastic energy at the peak",
     "kinetic over elastic energy at the first peak"},
    {"step_margin", &Summary::step_margin, none, run, "critical step / step", "critical time step over the step used"},
    {"stress_asymmetry", &Summary::stress_asymmetry, ratio, hidden, "stress asymmetry",
     "largest difference of the two shear stresses over the first peak stress"},
    {"impact_stress_per_rate", &Summary::impact_stress_per_rate, none, hidden, "impact stress over rate, Pa s",
     "bulk density x wave speed (as estimated) x height of the block, in Pa s"},
    {"noise_mean", &Summary::noise_mean, none, hidden, "mean strength factor",
     "mean of the strength factors of the bonds"},
    {"noise_std", &Summary::noise_std, none, hidden, "deviation of the strength factors", "their standard deviation"},
    {"noise_min", &Summary::noise_min, none, hidden, "smallest strength factor", "the smallest of them"},
    {"noise_max", &Summary::noise_max, none, hidden, "largest strength factor", "the largest of them"},
};
static_assert(std::size(table) <= most_measures);

std::vector<const Measure*> chosen(int Measure::*place) {
  std::vector<const Measure*> found;
  for (const Measure& measure : table)
    if (measure.*place > 0) found.push_back(&measure);
  std::sort(found.begin(), found.end(), [&](const Measure* a, const Measure* b) { return a->*place < b->*place; });
  return found;
}

}  // namespace

std::span<const Measure> measures() {
  return table;
}

const Measure* measure_called(std::string_view key) {
  const auto* const found =
      std::find_if(std::begin(table), std::end(table), [&](const Measure& one) { return one.key == key; });
  return found == std::end(table) ? nullptr : found;
}

double value_of(const Measure& measure, const PackSummary& pack, const Summary& summary) {
  struct Visitor {
    const PackSummary& pack;
    const Summary& summary;
    double operator()(double PackSummary::*member) const { return pack.*member; }
    double operator()(std::int64_t PackSummary::*member) const { return static_cast<double>(pack.*member); }
    double operator()(double (*function)(const PackSummary&)) const { return function(pack); }
    double operator()(double Summary::*member) const { return summary.*member; }
    double operator()(std::int64_t Summary::*member) const { return static_cast<double>(summary.*member); }
  };
  return std::visit(Visitor{pack, summary}, measure.member);
}

double value_of(const Measure& measure, const Evaluation& evaluation) {
  return value_of(measure, evaluation.pack, evaluation.summary);
}

const std::vector<const Measure*>& ensemble_measures() {
  static const std::vector<const Measure*> list = chosen(&Measure::ensemble_column);
  return list;
}

const std::vector<const Measure*>& sweep_measures() {
  static const std::vector<const Measure*> list = [] {
    std::vector<const Measure*> found = chosen(&Measure::sweep_column);
    const auto of_run = static_cast<std::ptrdiff_t>(found.size());
    for (const Measure& measure : table)
      if (!measure.of_packing()) found.push_back(&measure);
    std::sort(found.begin() + of_run, found.end(),
              [](const Measure* a, const Measure* b) { return std::string_view(a->key) < b->key; });
    return found;
  }();
  return list;
}

std::string measure_reference() {
  std::string text = "| key | SI unit | meaning |\n|---|---|---|\n";
  for (const Measure& measure : table)
    text += fmt::format("| `{}` | {} | {} |\n", measure.key, io::si_unit(measure.dimension), measure.help);
  return text;
}

}  // namespace perfora::results
