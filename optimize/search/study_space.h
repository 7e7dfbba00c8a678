// What is here: which studies ask for the same evaluations, whatever they wish: their space. What is not: taking
// evaluations of another folder (map_import.h).
#pragma once

#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "optimize/search/study.h"

namespace perfora::optimize {

/// What the head of a journal says of a study: "resolved" (Study::resolved(), with the names of the arms alone),
/// "fidelities" (the changes of each that is used, as text) and "file".
nlohmann::json study_identity(const Study& study);

/// A key in the head of a journal ("design.layout.diameter", "variables.layout.diameter") by its name of today.
std::string name_today(const Study& study, const std::string& key);

/// The first key in which a head differs from a study, with both values as text.
struct Difference {
  std::string key, there, here;
};
/// One of these values for people: numbers in it with six digits (SI, as they stand in the journal).
std::string shown(const std::string& value);
/// Of the keys that decide what is simulated: variables, arms, the design but for what varies, wishes and window, how
/// far runs go (the other must go as far), and the fidelity of the map. Key empty: none.
Difference difference_in_space(const Study& study, const nlohmann::json& head);
/// Whether wishes, weights and window of a head are those of the study.
bool same_target(const Study& study, const nlohmann::json& head);
/// Every key in which the two differ; keys that the head lacks count as at their defaults.
std::vector<Difference> differences(const Study& study, const nlohmann::json& head);

}  // namespace perfora::optimize
