// What is here: evaluations taken from other folders, and from before a change of the target. What is not: the map's
// own designs (map_plan.h).
#include "optimize/search/map_import.h"

#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <set>
#include <tuple>

#include "io/text.h"
#include "optimize/campaign/evaluation_queue.h"
#include "optimize/search/map_plan.h"
#include "optimize/search/study_space.h"
#include "results/campaign_folder.h"
#include "results/record_reading.h"

namespace perfora::optimize {
namespace {

using nlohmann::json;
namespace fs = std::filesystem;

bool is(const json& event, const char* name) {
  return event.value("event", "") == name;
}

/// Whether a design has the choices of an arm, but for keys that a fidelity changes.
bool may_be_of(const Arm& arm, const DesignFile& design, const Fidelity& fidelity, const Study& study) {
  DesignFile other(study.start->design());
  return std::all_of(arm.choices.begin(), arm.choices.end(), [&](const DesignChange& choice) {
    const bool changed = std::any_of(fidelity.changes.begin(), fidelity.changes.end(),
                                     [&](const DesignChange& change) { return change.key == choice.key; });
    if (changed) return true;
    other.schema().set(choice.key, choice.value, {});
    return io::value_text(other.schema().find(choice.key)->get()) ==
           io::value_text(design.schema().find(choice.key)->get());
  });
}

/// The candidate whose request, at some fidelity, is this one; nullptr: none.
const Candidate* candidate_of(const Request& request, const Study& study, CandidateBook& book) {
  const DesignFile design(*request.design);
  std::vector<double> values;
  for (const Variable& variable : study.variables) {
    if (!design.schema().is_number(variable.key)) return nullptr;
    values.push_back(design.schema().get_number(variable.key));
    constexpr double rounding = 1e-12;
    const double slack = rounding * (variable.high - variable.low);
    if (values.back() < variable.low - slack || values.back() > variable.high + slack) return nullptr;
  }
  const std::string key = request.key();
  for (std::size_t arm = 0; arm < study.arms.size(); ++arm)
    for (std::size_t fidelity = 0; fidelity < study.fidelities.size(); ++fidelity) {
      if (!may_be_of(study.arms[arm], design, study.fidelities[fidelity], study)) continue;
      const Candidate& candidate = book.at(static_cast<int>(arm), values);
      if (candidate.violation <= 0.0 && book.key(candidate, request.replicate, fidelity) == key) return &candidate;
    }
  return nullptr;
}

[[noreturn]] void refuse_folder(const io::Origin& origin, const std::string& problem) {
  throw io::InputError(origin, problem, "the folder of a map or a study of the same variables, arms and design",
                       "name another folder, or leave it out");
}

}  // namespace

std::vector<json> evaluations_of(const fs::path& folder, const Study& study, const io::Origin& origin) {
  const std::string kind = results::kind_in_journal(folder);
  if (kind != "map" && kind != "study")
    refuse_folder(
        origin, fmt::format("{} holds {}", folder.string(), kind.empty() ? "no map" : "another kind of work: " + kind));
  std::vector<json> taken;
  return results::read_from(folder / "journal.jsonl", 0, "name another folder", [&] {
    for (json& event : results::journal_events(folder)) {
      if (is(event, kind.c_str())) {
        if (const int version = event.value("results_version", 0); version != results_version)
          refuse_folder(origin,
                        fmt::format("{} holds results of version {}, and this program makes those of version {}",
                                    folder.string(), version, results_version));
        const Difference one = difference_in_space(study, event);
        if (!one.key.empty())
          refuse_folder(origin, fmt::format("{} is of another space: {} is {} there and {} here", folder.string(),
                                            one.key, shown(one.there), shown(one.here)));
      }
      if (is(event, "evaluation")) taken.push_back(std::move(event));
    }
    return std::move(taken);
  });
}

std::vector<const Candidate*> designs_of(const std::vector<json>& events, const Study& study, CandidateBook& book) {
  std::vector<const Candidate*> found;
  DesignTexts designs;
  std::map<const Design*, const Candidate*> known;  // replicates share theirs
  for (const json& event : events) {
    if (!event.contains("request")) continue;
    const Request request = request_from_json(event.at("request"), &designs);
    const auto [place, is_new] = known.try_emplace(request.design.get());
    if (is_new) place->second = candidate_of(request, study, book);
    const Candidate* one = place->second;
    if (one && std::find(found.begin(), found.end(), one) == found.end()) found.push_back(one);
  }
  std::sort(found.begin(), found.end(), [](const Candidate* a, const Candidate* b) {
    return std::tie(a->arm, a->values) < std::tie(b->arm, b->values);
  });
  return found;
}

TakenMap taken_map(const Study& study, const io::Origin& origin) {
  const std::vector<json> events = evaluations_of(study.keys.map.from, study, origin);
  CandidateBook book(study);
  TakenMap taken;
  taken.designs = static_cast<int>(designs_of(events, study, book).size());
  taken.evaluations = static_cast<int>(events.size());
  std::set<std::string> known;
  DesignTexts designs;
  for (const json& event : events) {
    taken.seconds += event.value("seconds", 0.0);
    if (event.contains("request")) known.insert(request_from_json(event.at("request"), &designs).key());
  }
  const MapKeys& keys = study.keys.map;
  for (const BatchPoint& one : choose_map(study, book, keys.designs).points) {
    const Candidate& candidate = book.at(one.arm, study.values_at(one.point));
    for (int replicate = 0; replicate < keys.replicates; ++replicate)
      taken.map_runs += known.contains(book.key(candidate, replicate, study.map_fidelity));
  }
  return taken;
}

int tell_driver(Driver& driver, const Study& study, const std::vector<json>& events, const std::string& kind) {
  std::size_t begin = 0;  // what stands before was asked for another target
  bool other = false;
  for (std::size_t k = 0; k < events.size(); ++k) {
    if (!is(events[k], kind.c_str())) continue;
    const bool same = kind == "map" || same_target(study, events[k]);
    if (same && other) begin = k;
    other = !same;
  }
  std::vector<json> known;
  for (std::size_t k = 0; k < events.size(); ++k) {
    const json& event = events[k];
    if (is(event, "evaluation") && (k < begin || event.value(taken_over_name, false))) known.push_back(event);
    if (is(event, "batch") && (k >= begin || event.value("stage", "") == "map"))
      driver.take(batch_from_json(event, study));
    if (is(event, "early_end") && k >= begin) {
      std::set<const Candidate*> dropped;
      for (const json& one : event.at("dropped"))
        dropped.insert(&driver.book().at(one.at("arm").get<int>(), one.at("values").get<std::vector<double>>()));
      driver.end_search(event.at("reason").get<std::string>(), std::move(dropped));
    }
  }
  for (const Candidate* one : designs_of(known, study, driver.book())) driver.observe(*one);
  return static_cast<int>(known.size());
}

}  // namespace perfora::optimize
