// What is here: the pieces of strain and the rule. What is not: what a run does with them (run.cpp).
#include "solver/peak_watch.h"

namespace perfora::solver {
namespace {

constexpr double passed_ratio = 0.8;   // a piece below this fraction of the largest so far ends the search
constexpr double latest_peak = 10.0;   // times the estimated peak strain
constexpr double least_strain = 2e-4;  // pieces before that are too close to zero stress to tell a fall
constexpr double piece_rounding = 1e-9;

}  // namespace

bool PeakWatch::ends_piece(double stress, double width, double at) {
  work += stress * width;
  strain += width;
  if (strain < (1.0 - piece_rounding) * piece) return false;
  last = work / strain;
  last_at = at;
  work = strain = 0.0;
  if (last > largest) {
    largest = last;
    largest_at = at;
  }
  return true;
}

bool PeakWatch::passed(double estimated_strain) const {
  return last_at > least_strain && last < passed_ratio * largest && largest_at < latest_peak * estimated_strain;
}

}  // namespace perfora::solver
