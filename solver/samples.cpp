// What is here: when a sample is due and what it holds. What is not: the run (run.cpp).
#include "solver/samples.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

namespace perfora::solver {
namespace {

constexpr double never = std::numeric_limits<double>::infinity();
constexpr double interval_rounding = 1e-9;  // of an interval: strains that differ by less are one

void set_stresses(results::History& h, const Virial& stress) {
  h.stress_yy.back() = stress.yy;
  h.stress_xx.back() = stress.xx;
  h.stress_xy.back() = 0.5 * (stress.xy + stress.yx);
  h.stress_asymmetry.back() = std::fabs(stress.xy - stress.yx);
}

/// Mean pressures on platens and side walls; their columns exist only where such walls are.
template <class Put>
void each_pressure(results::History& h, const Walls& walls, const Put& put) {
  const std::array<std::vector<double>*, 4> columns = {&h.platen_stress_bottom, &h.platen_stress_top,
                                                       &h.wall_stress_left, &h.wall_stress_right};
  for (std::size_t w = 0; w < walls.places().size(); ++w)
    if (walls.places()[w].edge) put(*columns[static_cast<std::size_t>(walls.places()[w].side)], walls.row_pressure(w));
}

}  // namespace

Samples::Samples(results::History& history, std::int64_t& centred_rows, double interval, double until,
                 double mean_diameter)
    : history_(history),
      centred_rows_(centred_rows),
      interval_(interval),
      until_(until),
      mean_diameter_(mean_diameter) {
  if (history_.rows() == 0) return;
  plan_next(history_.strain_yy.back());
  if (centred_rows_ == static_cast<std::int64_t>(history_.rows())) wait_for_sample();
}

void Samples::start(Simulation& simulation) {
  if (history_.rows() > 0) return;
  add(simulation);
  plan_next(simulation.strain());
}

void Samples::wait_for_sample() {
  half_ = never;
  next_ = sample_;
}

void Samples::plan_next(double strain) {
  const double tolerance = interval_rounding * interval_;
  sample_ = (std::floor(strain / interval_ + interval_rounding) + 1.0) * interval_;
  if (sample_ > until_ - tolerance) sample_ = until_;
  if (strain > until_ - tolerance) sample_ = never;
  half_ = std::isfinite(sample_) ? 0.5 * (strain + sample_) : never;
  // Strains of a path are good to rounding.
  sample_ -= tolerance;
  half_ -= tolerance;
  next_ = std::min(half_, sample_);
}

void Samples::take(Simulation& simulation) {
  if (simulation.strain() >= half_) {
    centre(simulation);
    wait_for_sample();
  }
  if (simulation.strain() < sample_) return;
  add(simulation);
  plan_next(simulation.strain());
}

/// The first sample stands at the start, before anything is loaded.
void Samples::centre(Simulation& simulation) {
  if (history_.rows() > 1) {
    set_stresses(history_, simulation.row_stress());
    each_pressure(history_, simulation.walls(), [](std::vector<double>& column, double p) { column.back() = p; });
  }
  simulation.reset_row();
  centred_rows_ = static_cast<std::int64_t>(history_.rows());
}

void Samples::add(Simulation& simulation) {
  const Ledger energy = simulation.ledger();
  const double strain = simulation.strain();
  results::History& h = history_;
  for (auto* stress : {&h.stress_yy, &h.stress_xx, &h.stress_xy, &h.stress_asymmetry}) stress->push_back(0.0);
  set_stresses(h, simulation.row_stress());
  h.strain_yy.push_back(strain);
  h.strain_yy_log.push_back(-std::log(1.0 - strain));
  h.broken_bonds.push_back(static_cast<double>(simulation.events().size()));
  h.fragments.push_back(fragments(simulation).count);
  h.contacts.push_back(static_cast<double>(simulation.contacts()));
  h.rate.push_back(h.time.empty() ? 0.0
                                  : (strain - h.strain_yy[h.time.size() - 1]) / (simulation.time() - h.time.back()));
  h.time.push_back(simulation.time());
  h.external_work.push_back(energy.external_work);
  h.elastic_bonds.push_back(energy.elastic_bonds);
  h.elastic_contacts.push_back(energy.elastic_contacts);
  h.kinetic.push_back(energy.kinetic);
  h.damage.push_back(energy.damage);
  h.friction.push_back(energy.friction);
  h.viscous.push_back(energy.viscous);
  h.cundall.push_back(energy.cundall);
  each_pressure(h, simulation.walls(), [](std::vector<double>& column, double p) { column.push_back(p); });
  add_ends(simulation);
}

void Samples::add_ends(const Simulation& simulation) {
  results::History& h = history_;
  h.stress_before.push_back(h.stress_yy.back());
  h.steps.push_back(static_cast<double>(simulation.steps()));
  h.broken_in_tension.push_back(static_cast<double>(broken_in_tension(simulation)));
  h.largest_fragment.push_back(fragments(simulation).largest_fraction);
  h.largest_overlap.push_back(simulation.largest_overlap() / mean_diameter_);
  h.largest_asymmetry.push_back(simulation.largest_asymmetry());
  h.peak_passed.push_back(simulation.peak_frozen() ? 1.0 : 0.0);
}

const Fragments& Samples::fragments(const Simulation& simulation) {
  const auto breaks = static_cast<std::int64_t>(simulation.events().size());
  if (fragments_.label.empty() || fragments_at_breaks_ != breaks) {
    fragments_ = find_fragments(simulation.network(), simulation.discs().radius);
    fragments_at_breaks_ = breaks;
  }
  return fragments_;
}

std::int64_t Samples::broken_in_tension(const Simulation& simulation) {
  const std::vector<results::BreakEvent>& events = simulation.events();
  for (; counted_events_ < events.size(); ++counted_events_)
    if (events[counted_events_].mode == results::BreakMode::tension) ++counted_in_tension_;
  return counted_in_tension_;
}

}  // namespace perfora::solver
