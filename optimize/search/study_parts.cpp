// What is here: parts of a study's record. What is not: its files (study_result.cpp).
#include "optimize/search/study_parts.h"

#include <fmt/format.h>

#include <algorithm>
#include <boost/math/distributions/students_t.hpp>
#include <cmath>

#include "io/csv.h"
#include "io/text.h"
#include "optimize/campaign/value_json.h"
#include "optimize/search/pareto.h"
#include "optimize/search/study_plan.h"
#include "optimize/search/study_result.h"
#include "results/json.h"
#include "results/judgement.h"
#include "results/statistic.h"

namespace perfora::optimize {
namespace {

using nlohmann::json;

/// More blocks than this nobody runs for one wish.
constexpr int most_blocks = 1000;

/// Half the interval that `blocks` blocks of this scatter would give, over their standard deviation.
double half_width(const results::Target& target, int blocks) {
  if (target.statement == results::Statement::block) return results::tolerance_factor(blocks, target.fraction);
  const boost::math::students_t law(blocks - 1.0);
  return boost::math::quantile(law, 0.5 * (1.0 + results::confidence)) / std::sqrt(static_cast<double>(blocks));
}

/// Blocks that would show a wish to be kept with the mean and the scatter of `values`; 0: none up to most_blocks. On
/// logarithms where results::block_interval() is.
int blocks_needed(const results::Target& target, const results::Wish& wish, std::vector<double> values) {
  const bool logarithms = target.statement == results::Statement::block &&
                          std::all_of(values.begin(), values.end(), [](double value) { return value > 0.0; });
  const auto on_scale = [&](double value) { return logarithms ? std::log(std::max(0.0, value)) : value; };
  for (double& value : values) value = on_scale(value);
  const results::Statistic of = results::statistic_of({}, values);
  const double room = std::min(of.mean - on_scale(wish.low), on_scale(wish.high) - of.mean);
  if (!(room > 0.0)) return 0;
  for (int blocks = results::fewest_replicates; blocks <= most_blocks; ++blocks)
    if (half_width(target, blocks) * of.standard_deviation <= room) return blocks;
  return 0;
}

/// Plateau of a design on the seeds of the search over that of its verification.
double bias_of_fidelity(const Score& searched, const Score& verified) {
  return searched.valid && verified.valid && verified.plateau_mean > 0.0 ? searched.plateau_mean / verified.plateau_mean
                                                                         : std::nan("");
}

/// Whether a search at another fidelity than the verification gave the recommended design another plateau: by more than
/// a fifth and by more than twice the standard error of the difference; blocks of the search scatter as those of the
/// verification do.
bool is_biased(const Study& study, const Plan& plan) {
  if (study.verify_fidelity == 0) return false;
  constexpr double much = 1.2, errors = 2.0;
  const Score &searched = plan.best_score, &verified = plan.finals.best;
  const double ratio = bias_of_fidelity(searched, verified);
  if (!(ratio > much || ratio < 1.0 / much)) return false;
  const double error = verified.plateau_std * std::sqrt(1.0 / searched.replicates + 1.0 / verified.replicates);
  return std::abs(searched.plateau_mean - verified.plateau_mean) > errors * error;
}

/// The designs of the race, best first.
json race_json(const StudyRun& run) {
  json designs = json::array();
  for (const Finalist& one : run.plan().finalists)
    designs.push_back({{"label", one.candidate->label},
                       {"design", design_values(run.study(), *one.candidate)},
                       {"rounds", one.rounds},
                       {"kept", one.kept},
                       {"score", score_json(one.score)}});
  return designs;
}

/// Each verified design with its verdict and what is sure of single blocks.
json verified_json(StudyRun& run) {
  const Study& study = run.study();
  json designs = json::array();
  for (const Verified& one : run.plan().verified) {
    const auto blocks = run.known(*one.candidate, one.first, one.count, study.verify_fidelity);
    json entry = {{"label", one.candidate->label},
                  {"design", design_values(study, *one.candidate)},
                  {"recommended", one.candidate == run.plan().best},
                  {"fidelity", study.fidelities[study.verify_fidelity].name},
                  {"score", score_json(one.score)}};
    if (const auto judgement = results::judgement_on(study.target, blocks)) entry.update(to_json(*judgement));
    designs.push_back(std::move(entry));
  }
  return designs;
}

/// What the map says of the wishes.
json map_json(StudyRun& run) {
  const auto map = run.map();
  if (!map) return nullptr;
  json ranges = json::object();
  for (const results::Measure* measure : results::recorded_measures(run.study().target)) {
    const results::MappedRange range = results::mapped_range(*map, *measure);
    if (range.designs > 0)
      ranges[measure->key] = {{"designs", range.designs}, {"low", number(range.low)}, {"high", number(range.high)}};
  }
  return {{"designs", map->designs.size()},
          {"taken_over", run.taken_over()},
          {"fidelity", map->fidelity},
          {"ranges", ranges},
          {"out_of_reach", results::out_of_reach(*map)}};
}

std::string csv_row(StudyRun& run, const std::string& stage, std::size_t number, const Visit& visit, int replicates,
                    std::size_t fidelity) {
  const Study& study = run.study();
  const Candidate& candidate = *visit.candidate;
  const auto runs = run.known(candidate, 0, replicates, fidelity);
  std::string reason = candidate.problem;
  int failed = 0;
  for (const Evaluation* one : runs)
    if (!usable(*one) && failed++ == 0) reason = one->reason.empty() ? "no plateau in the window" : one->reason;
  const char* status = candidate.violation > 0.0 ? "not run"
                       : !visit.answered         ? "open"
                       : visit.detail.valid      ? "completed"
                                                 : "failed";
  const std::string arm = candidate.arm < 0 ? "start" : study.arms[static_cast<std::size_t>(candidate.arm)].name;
  std::string line = fmt::format("{},{},{}", stage, io::csv_quoted(arm), number);
  for (const double value : candidate.values) line += fmt::format(",{}", value);
  line += fmt::format(",{},{},{}", io::csv_quoted(status), runs.size(), failed);
  const auto add = [&](double value) { line += std::isfinite(value) ? fmt::format(",{}", value) : ","; };
  add(visit.answered ? visit.score : std::nan(""));
  add(visit.detail.valid ? visit.detail.not_kept : std::nan(""));
  for (const results::Measure& measure : results::measures()) {
    std::vector<double> values;
    for (const Evaluation* one : runs)
      if (usable(*one)) values.push_back(results::value_of(measure, *one));
    const results::Statistic of = results::statistic_of({}, values);
    add(of.count > 0 ? of.mean : std::nan(""));
    add(of.standard_deviation);
  }
  return line + "," + io::csv_quoted(reason) + "\n";
}

}  // namespace

json score_json(const Score& score) {
  if (score.replicates == 0) return nullptr;
  const bool any = score.failed < score.replicates;
  return {{"score", score.valid ? number(score.value) : json(nullptr)},
          {"wishes_not_kept", score.valid ? json(score.not_kept) : json(nullptr)},
          {"mean", any ? number(score.plateau_mean) : json(nullptr)},
          {"standard_deviation", any ? number(score.plateau_std) : json(nullptr)},
          {"undulation", any ? number(score.undulation_mean) : json(nullptr)},
          {"first_peak_stress", any ? number(score.first_peak_mean) : json(nullptr)},
          {"count", score.replicates - score.failed},
          {"failed", score.failed}};
}

json design_values(const Study& study, const Candidate& candidate) {
  json values = json::object();
  if (candidate.arm >= 0)
    for (const DesignChange& choice : study.arms[static_cast<std::size_t>(candidate.arm)].choices)
      values[choice.key] = value_json(choice.value);
  for (std::size_t k = 0; k < candidate.values.size(); ++k) values[study.variables[k].key] = candidate.values[k];
  return values;
}

json end_json(StudyRun& run) {
  const Study& study = run.study();
  const Plan& plan = run.plan();
  json parts = json::object();
  if (!plan.finalists.empty()) parts["race"] = race_json(run);
  const auto blocks = fresh_blocks(run);
  const bool enough = static_cast<int>(blocks.size()) >= results::fewest_replicates;
  if (enough && !results::wishes(study.target).empty())
    parts["single_blocks"] = to_json(results::assurance_of(study.target, blocks));
  if (plan.verified.size() > 1) parts["verified"] = verified_json(run);
  if (json set = plan.finished ? pareto_json(study, plan) : json(); !set.is_null()) parts["pareto"] = std::move(set);
  if (!plan.map.empty()) parts["map"] = map_json(run);
  if (plan.finished)
    if (const auto told = remarks(run); !told.empty()) parts["remarks"] = told;
  if (plan.finished && enough) parts["what_more_would_buy"] = what_more_would_buy(run);
  if (!is_plain(study.keys)) parts["plan"] = planned(study);
  return parts;
}

std::string candidates_csv(StudyRun& run) {
  const Study& study = run.study();
  const Plan& plan = run.plan();
  std::string text = "stage,arm,number";
  for (const Variable& variable : study.variables) text += "," + variable.key;
  text += ",status,replicates,failed,score,wishes_not_kept";
  for (const results::Measure& measure : results::measures()) text += fmt::format(",{0},{0}_std", measure.key);
  text += ",reason\n";
  for (std::size_t k = 0; k < plan.map.size(); ++k)
    text += csv_row(run, "map", k + 1, plan.map[k], study.keys.map.replicates, study.map_fidelity);
  if (plan.start.candidate) text += csv_row(run, "start", 0, plan.start, study.keys.replicates, 0);
  for (const Trace& trace : plan.traces)
    for (std::size_t k = 0; k < trace.visits.size(); ++k)
      text += csv_row(run, trace.refine ? "refine" : "search", k + 1, trace.visits[k], study.keys.replicates, 0);
  return text;
}

std::optional<Visit> best_beside_search(const Plan& plan) {
  if (!plan.best || plan.best == plan.start.candidate) return std::nullopt;
  for (const Trace& trace : plan.traces)
    for (const Visit& visit : trace.visits)
      if (visit.candidate == plan.best) return std::nullopt;
  return Visit{plan.best, true, plan.best_score.value, plan.best_score};
}

std::vector<const Evaluation*> fresh_blocks(StudyRun& run) {
  const Plan& plan = run.plan();
  if (!plan.best || plan.finals.replicates == 0) return {};
  auto blocks = run.known(*plan.best, plan.finals.first, plan.finals.replicates, plan.finals.fidelity);
  if (static_cast<int>(blocks.size()) < plan.finals.replicates) blocks.clear();
  return blocks;
}

std::vector<std::string> remarks(StudyRun& run) {
  std::vector<std::string> sentences;
  const Study& study = run.study();
  const Plan& plan = run.plan();
  const Finals& finals = plan.finals;
  if (finals.best.replicates == 0) return sentences;
  if (plan.best == plan.start.candidate)
    sentences.emplace_back(
        finals.first == first_confirming_replicate
            ? "the start itself is recommended: on fresh seeds it keeps more of the wishes than what was found"
            : "the start itself is recommended: nothing that was found scores better");
  else if (finals.start_keeps_more())
    sentences.push_back(fmt::format("the start keeps {} of {} wishes on fresh seeds, the recommended design {}",
                                    finals.start.wishes - finals.start.not_kept, finals.start.wishes,
                                    finals.best.wishes - finals.best.not_kept));
  if (is_biased(study, plan)) {
    const double bias = bias_of_fidelity(plan.best_score, finals.best);
    const double at_start = bias_of_fidelity(plan.start.detail, finals.start);
    const std::string of_start = std::isfinite(at_start) && plan.best != plan.start.candidate
                                     ? fmt::format(" ({:.2g} times of the start)", at_start)
                                     : "";
    sentences.push_back(fmt::format(
        "the fidelity of the search{} gives {:.2g} times the verified plateau of the recommended design{}: it "
        "searched for another stress than is wished; search at a finer one",
        study.fidelities.front().name.empty() ? "" : ", " + study.fidelities.front().name + ",", bias, of_start));
  }
  return sentences;
}

std::vector<std::string> what_more_would_buy(StudyRun& run) {
  std::vector<std::string> sentences;
  const Study& study = run.study();
  const auto verdict = verdict_of(run);
  if (!verdict) return sentences;
  const auto blocks = fresh_blocks(run);
  const double each = run_seconds(study, study.verify_fidelity);
  const bool biased = is_biased(study, run.plan());
  // More blocks help only where every mean keeps its wish.
  const bool means_keep = std::all_of(verdict->wishes.begin(), verdict->wishes.end(), [](const auto& one) {
    return one.mean >= one.wish.low && one.mean <= one.wish.high;
  });
  for (const results::WishVerdict& one : verdict->wishes) {
    if (one.outcome != results::Outcome::not_shown || blocks.empty()) continue;
    std::vector<double> values;
    for (const Evaluation* block : blocks)
      if (block->status == results::RunStatus::completed)
        values.push_back(results::wished_value(*one.wish.measure, *block));
    const results::Statistic of = results::statistic_of({}, values);
    if (of.count < 2) continue;
    const std::string name = results::name_of(*one.wish.measure);
    const int needed = blocks_needed(study.target, one.wish, values);
    const int further = needed - static_cast<int>(blocks.size());
    if (!(of.mean > one.wish.low && of.mean < one.wish.high))
      sentences.push_back(fmt::format("{}: its mean does not keep the wish; {} needed, not more blocks", name,
                                      biased ? "a finer fidelity of the search is" : "more candidates are"));
    else if (needed == 0)
      sentences.push_back(fmt::format("{}: with this scatter not even {} blocks would show that it keeps the wish",
                                      name, io::count(most_blocks)));
    else if (further > 0 && means_keep)
      sentences.push_back(
          fmt::format("{}: {} more block{} (study.final_replicates = {}, some {} of one processor) would show that it "
                      "keeps the wish, if mean and scatter stay as they are",
                      name, further, further == 1 ? "" : "s", needed, io::duration(each * further)));
  }
  if (verdict->outcome == results::Outcome::out_of_reach)
    sentences.emplace_back(
        "other bounds, other variables or another family are needed: all designs tried lie on one side of the wish");
  else if (verdict->outcome == results::Outcome::missed)
    sentences.push_back(
        fmt::format("each further candidate takes some {} of one processor; raise study.maxeval or "
                    "study.budget and go on with --resume",
                    io::duration(run_seconds(study, 0) * study.keys.replicates)));
  return sentences;
}

}  // namespace perfora::optimize
