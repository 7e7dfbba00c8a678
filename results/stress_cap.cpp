// What is here: which limits are stresses over a range of strain. What is not: drawing.
#include "results/stress_cap.h"

#include <fmt/format.h>

#include <cmath>
#include <limits>
#include <string_view>

#include "io/text.h"
#include "results/json.h"

namespace perfora::results {

using nlohmann::json;

std::vector<StressCap> stress_caps(const Target& target, double window_end) {
  std::vector<StressCap> caps;
  if (target.stress_until.size() == 2)
    caps.push_back({target.stress_until[0], target.stress_until[1],
                    "at most " + io::quantity(target.stress_until[1], io::Dimension::stress)});
  for (const Wish& wish : limits(target)) {
    const std::string_view key = wish.measure->key;
    if (!std::isfinite(wish.high)) continue;
    if (key == "first_peak_stress")
      caps.push_back({window_end, wish.high, "first peak at most " + io::quantity(wish.high, io::Dimension::stress)});
    if (key == "cap_ratio" && target.plateau_stress > 0.0)
      caps.push_back({window_end, wish.high * target.plateau_stress,
                      fmt::format("cap: {} x {}", io::number(wish.high),
                                  io::quantity(target.plateau_stress, io::Dimension::stress))});
  }
  return caps;
}

json to_json(const std::vector<StressCap>& caps) {
  json list = json::array();
  for (const StressCap& cap : caps)
    list.push_back({{"until", number(cap.until)}, {"stress", cap.stress}, {"text", cap.text}});
  return list;
}

std::vector<StressCap> stress_caps_from_json(const json& list) {
  std::vector<StressCap> caps;
  for (const json& one : list) {
    const json& until = one.at("until");
    caps.push_back({until.is_null() ? std::numeric_limits<double>::infinity() : until.get<double>(),
                    one.at("stress").get<double>(), one.at("text").get<std::string>()});
  }
  return caps;
}

}  // namespace perfora::results
