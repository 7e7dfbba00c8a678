// What is here: heads of journals held against a study. What is not: what follows from a difference (study_run.cpp,
// map_import.cpp).
#include "optimize/search/study_space.h"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <optional>
#include <set>
#include <sstream>

#include "io/numbers.h"
#include "io/text.h"
#include "optimize/evaluate/request.h"
#include "results/history.h"

namespace perfora::optimize {
namespace {

using nlohmann::json;

/// Arms are compared by name; their parts of maxeval may grow with it.
std::string arm_names(const Study& study) {
  std::string names;
  for (const Arm& arm : study.arms) names += (names.empty() ? "" : "; ") + arm.name;
  return names;
}

std::string changes_text(const Study& study, const Fidelity& fidelity) {
  std::string text;
  const std::string begin = "fidelity." + fidelity.name + ".";
  for (const auto& [key, value] : study.ladder)
    if (!fidelity.name.empty() && key.starts_with(begin)) text += key.substr(begin.size()) + "=" + value + "; ";
  return text;
}

/// Keys of the design that a study varies.
std::set<std::string> varied(const Study& study) {
  std::set<std::string> keys;
  for (const Variable& variable : study.variables) keys.insert(variable.key.substr(0, variable.key.find('[')));
  for (const Arm& arm : study.arms)
    for (const DesignChange& choice : arm.choices) keys.insert(choice.key);
  return keys;
}

bool of_target(const std::string& key) {
  return key.starts_with("target.") || key.starts_with("design.target.") || key.starts_with("design.measures.");
}

bool of_space(const std::string& key, const std::set<std::string>& varied) {
  if (key.starts_with("variables.") || key == "arms") return true;
  if (!key.starts_with("design.")) return false;
  const std::string name = key.substr(std::string("design.").size());
  // Of a list of which an element varies nothing is compared here: the keys of the requests tell.
  return changes_path(name) && name != "material.grade" && !varied.contains(name);
}

/// Names of arms without where their searches begin.
std::set<std::string> designs_of_arms(const std::string& names) {
  std::set<std::string> found;
  std::istringstream text(names);
  for (std::string name; std::getline(text, name, ';');) {
    name.erase(0, name.find_first_not_of(' '));
    if (const std::size_t start = name.rfind("start="); start != std::string::npos)
      name.erase(start == 0 ? 0 : start - 1);
    found.insert(name.empty() ? "all" : name);
  }
  return found;
}

/// A study may have fewer arms than a map.
bool among_arms(const Difference& one) {
  const auto there = designs_of_arms(one.there), here = designs_of_arms(one.here);
  return std::includes(there.begin(), there.end(), here.begin(), here.end());
}

}  // namespace

std::string shown(const std::string& value) {
  std::string text;
  for (std::size_t at = 0; at < value.size();) {
    const bool begins =
        std::isdigit(static_cast<unsigned char>(value[at])) != 0 &&
        (at == 0 || (std::isalnum(static_cast<unsigned char>(value[at - 1])) == 0 && value[at - 1] != '_'));
    std::string_view rest = std::string_view(value).substr(at);
    const std::optional<double> number = begins ? io::take_number(rest) : std::nullopt;
    text += number ? fmt::format("{:g}", *number) : std::string(1, value[at]);
    at = number ? value.size() - rest.size() : at + 1;
  }
  return text;
}

json study_identity(const Study& study) {
  auto resolved = study.resolved();
  resolved["arms"] = arm_names(study);
  json fidelities = json::array();
  for (const Fidelity& one : study.fidelities) fidelities.push_back(changes_text(study, one));
  return {{"resolved", resolved}, {"fidelities", fidelities}, {"file", study.file.filename().string()}};
}

/// Keys of the design that heads of earlier programs have and that no search goes by. Places of files whose content
/// both know; of a head that does not know it the place and the content, where the study names the same place.
bool counts_for_nothing(const Study& study, const std::string& key, const json& there) {
  constexpr std::string_view design = "design.", suffix = io::checksum_suffix;
  if (!key.starts_with(design)) return false;
  if (!changes_search(key.substr(design.size()))) return true;
  const std::string place = key.ends_with(suffix) ? key.substr(0, key.size() - suffix.size()) : key;
  const io::Schema& schema = study.start->schema();
  const io::Key* file = schema.find(place.substr(design.size()));
  if (!file || !schema.find(place.substr(design.size()) + io::checksum_suffix)) return false;
  if (there.contains(place + io::checksum_suffix)) return key == place && there.at(place + io::checksum_suffix) != "";
  return there.value(place, "") == io::value_text(file->get());
}

std::string name_today(const Study& study, const std::string& key) {
  for (const std::string table : {"design.", "variables."})
    if (key.starts_with(table)) return table + study.start->schema().name_today(key.substr(table.size()));
  return key;
}

std::vector<Difference> differences(const Study& study, const json& head) {
  const auto text = [](const json& object, const std::string& key) {
    const auto found = object.find(key);
    return found == object.end() ? std::string("nothing")
           : found->is_string()  ? found->get<std::string>()
                                 : found->dump();
  };
  json there = json::object();
  for (const auto& [key, value] : head.at("resolved").items()) there[name_today(study, key)] = value;
  json here = study_identity(study).at("resolved");
  std::set<std::string> keys;
  for (const json* object : {&there, &here})
    for (const auto& entry : object->items()) keys.insert(entry.key());
  const std::set<std::string> at_default = study.at_default();
  std::vector<Difference> found;
  for (const std::string& key : keys) {
    if (!there.contains(key) && at_default.contains(key)) continue;
    if (counts_for_nothing(study, key, there)) continue;
    Difference one{key, text(there, key), text(here, key)};
    if (one.there != one.here) found.push_back(std::move(one));
  }
  return found;
}

Difference difference_in_space(const Study& study, const json& head) {
  const std::set<std::string> keys = varied(study);
  for (Difference& one : differences(study, head))
    if (of_space(one.key, keys) && !(one.key == "arms" && among_arms(one))) return std::move(one);
  const json& resolved = head.at("resolved");
  const double until = io::number_from(resolved.value("design.loading.until", "")).value_or(0.0);
  if (until < study.until() - results::strain_rounding)
    return {"loading.until", resolved.value("design.loading.until", "nothing"), io::shortest(study.until())};
  const std::string own = changes_text(study, study.fidelities[study.map_fidelity]);
  const json known = head.value("fidelities", json::array({""}));
  if (std::find(known.begin(), known.end(), json(own)) == known.end())
    return {study.keys.map.fidelity.empty() ? "study.fidelity" : "map.fidelity", known.dump(),
            own.empty() ? "the design as it stands" : own};
  return {};
}

bool same_target(const Study& study, const json& head) {
  const std::vector<Difference> found = differences(study, head);
  return std::none_of(found.begin(), found.end(), [](const Difference& one) { return of_target(one.key); });
}

}  // namespace perfora::optimize
