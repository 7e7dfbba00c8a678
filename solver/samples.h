// What is here: the history of a run as it grows: samples at their strains, stresses as means around them. What is not:
// the columns (results/history.h), measures read from them (results/measures.h).
#pragma once

#include <cstdint>

#include "results/history.h"
#include "solver/fragments.h"
#include "solver/simulation.h"

namespace perfora::solver {

/// Samples at the multiples of an interval and at the end of the run (engineering strain); a step that passes several
/// makes one. All columns hold what is at the sample but the stresses, which are means from half way to the sample
/// before to half way to the next one: so a stress stands at the strain it belongs to. At the end, and where a run was
/// stopped, the mean reaches up to the sample only.
class Samples {
 public:
  /// `history`: of a run that goes on, otherwise empty; `centred_rows`: its rows whose stresses are means up to their
  /// far end. Both grow here. `mean_diameter`: m, what overlaps are stated in.
  Samples(results::History& history, std::int64_t& centred_rows, double interval, double until, double mean_diameter);
  /// The sample at the start, unless the history has one.
  void start(Simulation& simulation);
  /// To be called after every step: cheap where nothing is due. Returns whether something was.
  bool after_step(Simulation& simulation) {
    if (simulation.strain() < next_) return false;
    take(simulation);
    return true;
  }
  /// Fragments of the bonds as they are now, found anew only where bonds have broken since.
  const Fragments& fragments(const Simulation& simulation);
  /// Bonds that have broken in tension so far.
  std::int64_t broken_in_tension(const Simulation& simulation);

 private:
  void take(Simulation& simulation);
  void add(Simulation& simulation);
  void add_ends(const Simulation& simulation);
  void centre(Simulation& simulation);
  void plan_next(double strain);
  void wait_for_sample();

  results::History& history_;
  std::int64_t& centred_rows_;
  double interval_, until_, mean_diameter_;
  double half_ = 0.0;    ///< strain at which the last sample's mean ends
  double sample_ = 0.0;  ///< strain of the next sample
  double next_ = 0.0;    ///< the nearer of them
  Fragments fragments_;
  std::int64_t fragments_at_breaks_ = -1;
  std::size_t counted_events_ = 0;
  std::int64_t counted_in_tension_ = 0;
};

}  // namespace perfora::solver
