// What is here: the residual of the energies, sample by sample.
#include "solver/energy_watch.h"

#include <algorithm>
#include <cmath>

#include "results/measures.h"

namespace perfora::solver {

double EnergyWatch::residual(const results::History& history) {
  double worst = 0.0;
  for (; seen_ < history.rows(); ++seen_) {
    largest_work_ = std::max(largest_work_, std::fabs(history.external_work[seen_]));
    if (history.strain_yy[seen_] < results::residual_from_strain || !(largest_work_ > 0.0)) continue;
    worst =
        std::max(worst, std::fabs(history.external_work[seen_] - results::energy_sum(history, seen_)) / largest_work_);
  }
  return worst;
}

}  // namespace perfora::solver
