// What is here: a study in words and curves. What is not: its numbers for programs (study_result.cpp).
#include "optimize/search/study_record.h"

#include <fmt/format.h>

#include "geometry/layout.h"
#include "io/text.h"
#include "optimize/search/study_parts.h"
#include "optimize/search/study_result.h"
#include "results/curve_file.h"

namespace perfora::optimize {
namespace {

geometry::PerforationLayout layout_of(const DesignFile& design) {
  return geometry::place_perforations(design.design().layout, design.design().seeds.effective(0).layout);
}

/// Evaluations on the first `count` seeds of the verification where they were run, otherwise of the search.
std::vector<const Evaluation*> shown(StudyRun& run, const Candidate& candidate, int count) {
  const Finals& finals = run.plan().finals;
  const auto fresh = run.known(candidate, finals.first, count, finals.fidelity);
  return fresh.empty() ? run.known(candidate, 0, run.study().keys.replicates) : fresh;
}

/// ", searched at fidelity coarse"; empty where the design is searched as it stands.
std::string fidelity_text(const Study& study) {
  const std::string& searched = study.fidelities.front().name;
  const std::string& verified = study.fidelities[study.verify_fidelity].name;
  if (searched == verified) return searched.empty() ? "" : ", fidelity " + searched;
  return fmt::format(", searched at {}, verified at {}", searched.empty() ? "the design as it stands" : searched,
                     verified.empty() ? "the design as it stands" : verified);
}

std::vector<results::Curve> curves(const std::vector<const Evaluation*>& evaluations) {
  std::vector<results::Curve> curves;
  for (const auto* evaluation : evaluations)
    if (usable(*evaluation)) curves.push_back({evaluation->curve.strain_yy, evaluation->curve.stress_yy});
  return curves;
}

void add_points(results::StudyRecord& record, const StudyRun& run) {
  const auto add = [&](const Visit& visit, const std::string& arm) {
    results::StudyPoint point;
    point.number = static_cast<int>(record.points.size()) + 1;
    point.arm = arm;
    point.values = visit.candidate->values;
    point.feasible = visit.candidate->violation <= 0.0;
    if (visit.detail.valid) point.score = visit.score;
    if (visit.candidate == run.plan().best && record.best_number == 0) record.best_number = point.number;
    record.points.push_back(std::move(point));
  };
  const auto name = [&](int arm) { return run.study().arms[static_cast<std::size_t>(arm)].name; };
  for (const Trace& trace : run.plan().traces)
    for (const Visit& visit : trace.visits)
      if (visit.answered) add(visit, name(trace.arm) + (trace.refine ? " (refine)" : ""));
  if (const auto best = best_beside_search(run.plan())) add(*best, name(best->candidate->arm) + " (map)");
}

void add_facts(results::StudyRecord& record, const StudyRun& run, const Score& best_score, const Score& start_score) {
  const Study& study = run.study();
  const Candidate& best = *run.plan().best;
  const Candidate& start = *run.plan().start.candidate;
  const auto& schema = study.start->schema();
  for (const DesignChange& choice : study.arms[static_cast<std::size_t>(best.arm)].choices)
    record.facts.push_back(
        {io::after_section(choice.key), io::readable(choice.value), io::readable(schema.find(choice.key)->get())});
  for (std::size_t k = 0; k < study.variables.size(); ++k) {
    const auto& variable = study.variables[k];
    record.facts.push_back({io::after_section(variable.key), io::quantity(best.values[k], variable.dimension),
                            io::quantity(start.values[k], variable.dimension)});
  }
  record.facts.push_back({"thinnest wall", io::quantity(best.layout.thinnest_wall, io::Dimension::length),
                          io::quantity(start.layout.thinnest_wall, io::Dimension::length)});
  record.facts.push_back({"porosity", io::quantity(best.layout.porosity, io::Dimension::ratio),
                          io::quantity(start.layout.porosity, io::Dimension::ratio)});
  const auto seeds = [](const Score& score) { return io::count(score.replicates); };
  record.facts.push_back({run.plan().finals.best.replicates > 0 ? "fresh seeds" : "seeds of the search",
                          seeds(best_score), seeds(start_score)});
  record.facts.push_back(
      {"score", io::number(best_score.value), start_score.valid ? io::number(start_score.value) : ""});
  const auto kept = [](const Score& score) {
    return score.valid ? fmt::format("{} of {}", score.wishes - score.not_kept, score.wishes) : std::string();
  };
  if (best_score.wishes > 0) record.facts.push_back({"wishes kept", kept(best_score), kept(start_score)});
}

}  // namespace

results::StudyRecord study_record(StudyRun& run) {
  const Study& study = run.study();
  const Plan& plan = run.plan();
  results::StudyRecord record;
  record.title = study.title;
  record.subtitle =
      fmt::format("{}, {} replicate{} a candidate{}, {} evaluations; {}", study.keys.algorithm, study.keys.replicates,
                  study.keys.replicates == 1 ? "" : "s", fidelity_text(study), run.answers().size(), run.reason());
  if (study.target.plateau_stress > 0.0) {
    record.target = study.target.plateau_stress;
    record.target_tolerance = study.target.tolerance * study.target.plateau_stress;
  }
  for (std::size_t k = 0; k + 1 < study.target.curve_points.size(); k += 2) {
    record.target_curve.strain.push_back(study.target.curve_points[k]);
    record.target_curve.stress.push_back(study.target.curve_points[k + 1]);
  }
  const results::MeasureOptions& measures = study.start->design().measures;
  if (measures.plateau == results::PlateauPlace::window) {
    record.window_start = measures.plateau_start;
    record.window_end = measures.plateau_end;
  }
  const std::filesystem::path& measured = study.start->design().solver.output.curve;
  if (!measured.empty()) record.measured.push_back(results::read_curve(measured));
  add_points(record, run);
  if (const auto verdict = verdict_of(run)) {
    record.verdict = verdict->text;
    record.outcome = results::outcome_name(verdict->outcome);
    record.caps = verdict->caps;
  }
  if (!plan.best) return record;
  const auto best = shown(run, *plan.best, plan.finals.replicates);
  const auto start = shown(run, *plan.start.candidate, plan.finals.start_replicates);
  const auto best_score = score_of(study.target, best), start_score = score_of(study.target, start);
  record.best = curves(best);
  record.start = curves(start);
  record.best_plateau = best_score.plateau_mean;
  if (best_score.replicates > 1) record.best_plateau_deviation = best_score.plateau_std;
  if (start_score.replicates > start_score.failed) record.start_plateau = start_score.plateau_mean;
  if (record.start_plateau && start_score.replicates > 1) record.start_plateau_deviation = start_score.plateau_std;
  record.best_layout = layout_of(design_of(study, *plan.best));
  record.start_layout = layout_of(*study.start);
  add_facts(record, run, best_score, start_score);
  return record;
}

}  // namespace perfora::optimize
