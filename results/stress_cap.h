// What is here: stresses that a wish forbids a curve to pass, for pictures and reports. What is not: whether they are
// kept (verdict.h).
#pragma once

#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "results/target.h"

namespace perfora::results {

/// A largest wished stress from strain 0 on.
struct StressCap {
  double until = 0.0;   ///< engineering strain; infinite: to the end
  double stress = 0.0;  ///< Pa
  std::string text;     ///< "at most 4 MPa"
};

/// target.limit.stress_until up to its strain; the limits on the first peak and on the cap ratio (of the wished stress)
/// up to `window_end`, where a first peak and a plateau lie.
std::vector<StressCap> stress_caps(const Target& target, double window_end);

nlohmann::json to_json(const std::vector<StressCap>& caps);
/// Throws nlohmann::json::exception for anything but such a list.
std::vector<StressCap> stress_caps_from_json(const nlohmann::json& list);

}  // namespace perfora::results
