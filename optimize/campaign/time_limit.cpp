// What is here: time limits from estimates. What is not: the estimate itself.
#include "optimize/campaign/time_limit.h"

#include <algorithm>
#include <cmath>

#include "io/error.h"
#include "optimize/evaluate/estimate.h"
#include "optimize/evaluate/material_tests.h"

namespace perfora::optimize {
namespace {

constexpr double times_the_estimate = 20.0;
constexpr double at_least = 60.0;  // s

/// s; 0 where nothing can be said.
double estimate_of(const Request& request, int threads) {
  try {
    DesignFile design = DesignFile::of(*request.design, "request");
    if (!request.material_test.empty()) design = material_sample(design);
    design.design().solver.loading.until = request.strain();
    design.require_valid();
    const double seconds = estimate_design(design, threads).seconds;
    return std::isfinite(seconds) ? std::max(seconds, 0.0) : 0.0;
  } catch (const io::InputError&) {  // The worker says what is wrong with it.
    return 0.0;
  }
}

}  // namespace

double TimeLimits::of(const Request& request) const {
  const double estimate = estimate_of(request, threads_);
  return estimate > 0.0 ? times_the_estimate * slowest_ * estimate + at_least : 0.0;
}

void TimeLimits::learn(const Request& request, double seconds) {
  const double estimate = estimate_of(request, threads_);
  if (estimate > 0.0) slowest_ = std::max(slowest_, seconds / estimate);
}

}  // namespace perfora::optimize
