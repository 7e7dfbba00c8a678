// What is here: the ladder of fidelities of a study. What is not: what a run at one of them costs (study_plan.h).
#include "optimize/search/study_fidelities.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "io/text.h"
#include "io/units.h"
#include "optimize/evaluate/request.h"

namespace perfora::optimize {
namespace {

struct Step {
  std::vector<DesignChange> changes;
  double cost = 0.0;  // s
};
using Ladder = std::map<std::string, Step>;

/// Why a fidelity may not change a key; empty: it may.
std::string reason_to_keep(const std::string& key) {
  if (key.starts_with("seeds.")) return "the replicate says which seeds a run has";
  if (key == "material.grade") return "it multiplies the result and costs nothing";
  if (key == "loading.until") return "the study says how far runs go, for all of them: study.until";
  if (!changes_path(key)) return "it changes no run";
  return {};
}

Ladder ladder_of(Study& study, const std::vector<TableEntry>& entries) {
  Ladder ladder;
  DesignFile scratch(study.start->design());
  for (const TableEntry& entry : entries) {
    if (entry.table != "fidelity") continue;
    const std::size_t dot = entry.key.find('.');
    if (dot == std::string::npos)
      throw io::InputError(entry.origin(), "a fidelity has a name and keys",
                           "[fidelity.coarse] with \"packing.mean_diameter\" = \"1 mm\"", "write it as a table");
    const std::string name = entry.key.substr(0, dot), given = entry.key.substr(dot + 1);
    Step& step = ladder[name];
    if (given == "cost") {
      step.cost = io::parse_quantity(entry.value, io::Dimension::time, entry.origin());
      if (!(step.cost > 0.0))
        throw io::InputError(entry.origin(), "a run takes some time", "a time > 0, such as \"150 s\"",
                             "leave it out: it is estimated then");
      continue;
    }
    const std::string key = scratch.schema().name_today(given);
    if (!scratch.schema().find(key)) {
      for (const io::Key& other : scratch.schema().keys())
        if (other.name == key)
          throw io::InputError(entry.origin(), "a fidelity names the keys of the design with their sections", "",
                               fmt::format("write \"{}\"", other.full_name()));
      static_cast<void>(scratch.schema().at(key, entry.origin()));
    }
    if (const std::string reason = reason_to_keep(key); !reason.empty())
      throw io::InputError(entry.origin(), "a fidelity cannot change this key: " + reason, "", "leave it out");
    scratch.schema().set(key, entry.value, entry.origin());
    step.changes.push_back({key, entry.value});
    study.ladder["fidelity." + name + "." + key] = io::value_text(scratch.schema().find(key)->get());
  }
  return ladder;
}

/// The place of a fidelity among those that the study uses; added where it is new. "": the design as it stands.
std::size_t place_of(Study& study, const Ladder& ladder, const std::string& name, const std::string& key, double until,
                     const OriginOf& origin) {
  for (std::size_t k = 0; k < study.fidelities.size(); ++k)
    if (study.fidelities[k].name == name) return k;
  Fidelity fidelity{name, {}, until};
  double cost = 0.0;
  if (!name.empty()) {
    const auto found = ladder.find(name);
    if (found == ladder.end()) {
      std::vector<std::string> names;
      for (const auto& [known, step] : ladder) names.push_back(known);
      const std::string nearest = io::nearest_name(name, names);
      throw io::InputError(
          origin(key), fmt::format("there is no fidelity \"{}\"", name),
          names.empty() ? "no [fidelity.NAME] is given" : fmt::format("fidelities are {}", fmt::join(names, ", ")),
          nearest.empty() ? fmt::format("add [fidelity.{}] with the keys that it changes", name)
                          : fmt::format("did you mean \"{}\"?", nearest));
    }
    fidelity.changes = found->second.changes;
    cost = found->second.cost;
  }
  for (const DesignChange& change : changes_without_output()) fidelity.changes.push_back(change);
  study.fidelities.push_back(std::move(fidelity));
  study.costs.push_back(cost);
  return study.fidelities.size() - 1;
}

}  // namespace

void set_fidelities(Study& study, const std::vector<TableEntry>& entries, double until, const OriginOf& origin) {
  const Ladder ladder = ladder_of(study, entries);
  const StudyKeys& keys = study.keys;
  static_cast<void>(place_of(study, ladder, keys.fidelity, "study.fidelity", until, origin));
  if (!keys.map.fidelity.empty())
    study.map_fidelity = place_of(study, ladder, keys.map.fidelity, "map.fidelity", until, origin);
  study.verify_fidelity = place_of(study, ladder, keys.verify.fidelity, "verify.fidelity", until, origin);
}

}  // namespace perfora::optimize
