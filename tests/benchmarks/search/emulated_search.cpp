// What is here: the searchers of the program on a study whose runs another process answers, over lines of JSON on
// standard input and output (run.py): what recorded designs look like, searches, scores. What is not: the emulators.
//
// A command is a line; its answer is the line with "result". Before that the program may write a line with "ask"
// (descriptors, family, seed, replicates) and reads one with "curves": a curve a replicate on the strains of "begin".
#include <iostream>
#include <set>

#include "io/error.h"
#include "io/journal.h"
#include "optimize/model/descriptors.h"
#include "optimize/search/searcher.h"
#include "optimize/search/study_model.h"
#include "results/json.h"
#include "results/measures.h"

namespace {

using nlohmann::json;
using namespace perfora;
using namespace perfora::optimize;

void write(const json& line) {
  std::cout << line.dump() << "\n" << std::flush;
}

json read() {
  std::string line;
  if (!std::getline(std::cin, line)) throw std::runtime_error("the other side has gone");
  return json::parse(line);
}

/// Every evaluation of a journal with the descriptors of its design.
json describe(const std::string& path) {
  DesignTexts designs;
  json found = json::array();
  int unread = 0;
  for (const std::string& text : io::read_journal(path)) {
    const json record = json::parse(text);
    if (record.value("event", "") != "evaluation" || !record.contains("request")) continue;
    try {
      const Request request = request_from_json(record.at("request"), &designs);
      const Evaluation run = results::evaluation_from_json(record.at("evaluation"));
      const model::Descriptors described = model::describe_design(*request.design);
      found.push_back({{"descriptors", described.values},
                       {"family", described.family},
                       {"replicate", request.replicate},
                       {"completed", run.status == results::RunStatus::completed},
                       {"strain", run.curve.strain_yy},
                       {"stress", run.curve.stress_yy},
                       {"first_peak_stress", run.summary.first_peak_stress},
                       {"first_peak_strain", run.summary.first_peak_strain},
                       {"stress_drop_ratio", run.summary.stress_drop_ratio},
                       {"seconds", record.value("seconds", 0.0)}});
    } catch (const io::InputError&) {
      ++unread;
    }
  }
  json names = json::array();
  for (const model::Descriptor& one : model::descriptor_list()) names.push_back(one.name);
  return {{"runs", found}, {"unread", unread}, {"names", names}};
}

/// Points a wanted candidate that an algorithm of NLopt may spend on broken walls.
constexpr int walls_allowance = 20;

/// One study with its evaluations, for one search.
class Trial {
 public:
  Trial(const std::string& file, const json& command, const std::vector<double>& strain)
      : study_(read_study(file, overrides_of(command))),
        book_(study_),
        strain_(strain),
        frame_(study_.start->design().measuring_frame()),
        noise_seed_(command.value("seed", 1)) {}

  /// Runs that were asked for.
  int runs() const { return runs_; }

  Score score(const Candidate& candidate, int first, int count) {
    evaluate(candidate, first, count);
    std::vector<const Evaluation*> all;
    for (int replicate = first; replicate < first + count; ++replicate)
      all.push_back(answer_for(candidate.request(replicate), book_.key(candidate, replicate), answers_));
    return score_of(study_.target, all);
  }

  const Candidate& at(int arm, const std::vector<double>& point) {
    return book_.at(arm, study_.values_at(on_grid(point)));
  }

  json search(const json& command) {
    const int map = command.value("map", 0), map_replicates = command.value("map_replicates", 1);
    const int budget = command.at("runs"), replicates = study_.keys.replicates;
    take_map(map, map_replicates);
    SearchStage stage;
    stage.algorithm = study_.keys.algorithm;
    const int candidates = std::max(1, (budget - runs_) / replicates);
    for (std::size_t k = 0; k < study_.arms.size(); ++k) {
      const Arm& arm = study_.arms[k];
      int share = candidates / static_cast<int>(study_.arms.size()) +
                  (static_cast<int>(k) < candidates % static_cast<int>(study_.arms.size()) ? 1 : 0);
      // NLopt's points that break a wall cost no run: it goes on until the runs are spent.
      if (study_.searcher->library().name == "nlopt") share = walls_allowance * candidates;
      if (share > 0) stage.tasks.push_back({static_cast<int>(k), share, arm.seed, start_of(static_cast<int>(k), arm)});
    }
    for (;;) {
      CandidateStore store(study_, book_, answers_);
      for (const Candidate* candidate : mapped_) store.observe(*candidate);
      std::vector<Trace> traces = study_.searcher->ask(stage, store);
      bool finished = true;
      for (std::size_t k = 0; k < traces.size(); ++k) {
        finished = finished && traces[k].finished;
        give_back(traces[k], stage.tasks[k]);
      }
      if (finished || runs_ >= budget) return recommended(traces);
      for (const Trace& trace : traces)
        for (const Visit& visit : trace.visits)
          if (!visit.answered && runs_ < budget) evaluate(*visit.candidate, 0, replicates);
    }
  }

 private:
  static std::vector<std::string> overrides_of(const json& command) {
    std::vector<std::string> overrides{"study.final_replicates=0", "study.maxeval=1000", "study.allocation=equal"};
    overrides.push_back("study.algorithm=" + command.value("algorithm", std::string("sobol")));
    overrides.push_back("study.replicates=" + std::to_string(command.value("replicates", 1)));
    overrides.push_back("seeds.search=" + std::to_string(command.value("seed", 1)));
    if (command.contains("target"))
      overrides.push_back("target.plateau_stress=" + std::to_string(command.at("target").get<double>()));
    return overrides;
  }

  /// Points of the batches that a trace holds, as a journal would give them back.
  void give_back(const Trace& trace, SearchTask& task) const {
    task.batches.clear();
    std::size_t next = 0;
    for (const int size : trace.batches) {
      Points& points = task.batches.emplace_back();
      for (int k = 0; k < size; ++k) points.push_back(on_grid(study_.point_of(trace.visits[next++].candidate->values)));
    }
  }

  void evaluate(const Candidate& candidate, int first, int count) {
    json wanted = json::array();
    for (int replicate = first; replicate < first + count; ++replicate)
      if (!answer_for(candidate.request(replicate), book_.key(candidate, replicate), answers_))
        wanted.push_back(replicate);
    if (wanted.empty()) return;
    const model::Descriptors described = model::describe_design(*candidate.requests.front().design);
    write({{"ask",
            {{"descriptors", described.values},
             {"family", described.family},
             {"seed", noise_seed_},
             {"replicates", wanted}}}});
    const json curves = read().at("curves");
    for (std::size_t k = 0; k < wanted.size(); ++k) {
      const int replicate = wanted[k];
      answers_.add(book_.key(candidate, replicate), evaluation(candidate.request(replicate), curves.at(k)));
      ++runs_;
    }
  }

  Evaluation evaluation(const Request& request, const json& curve) const {
    Evaluation run;
    run.status = results::RunStatus::completed;
    run.reason = results::reached_text(request.strain());
    run.replicate = request.replicate;
    for (const auto& column : results::History::columns()) (run.curve.*column.values).assign(strain_.size(), 0.0);
    run.curve.strain_yy = strain_;
    run.curve.stress_yy = curve.at("stress").get<std::vector<double>>();
    run.curve.time = strain_;
    run.summary.first_peak_stress = curve.at("first_peak_stress");
    run.summary.first_peak_strain = curve.at("first_peak_strain");
    run.summary.impact_stress_per_rate = 0.0;
    run.summary.final_strain = request.strain();
    results::measure_curve(run.curve, frame_, run.summary);
    return run;
  }

  /// Sobol points of all arms, each with `replicates` runs.
  void take_map(int designs, int replicates) {
    const auto arms = static_cast<int>(study_.arms.size());
    if (designs == 0) return;
    SearchStage stage;
    stage.algorithm = "sobol";
    for (int k = 0; k < arms; ++k) {
      const int share = designs / arms + (k < designs % arms ? 1 : 0);
      if (share > 0) stage.tasks.push_back({k, share, study_.arms[static_cast<std::size_t>(k)].seed, {}});
    }
    const CandidateStore store(study_, book_, answers_);
    for (const Trace& trace : choose_searcher(built_in_searchers(), "sobol").searcher->ask(stage, store))
      for (const Visit& visit : trace.visits) {
        mapped_.push_back(visit.candidate);
        map_scores_[visit.candidate] = score(*visit.candidate, 0, replicates).value;
      }
  }

  /// The best of the map in the arm; otherwise as the study says.
  std::vector<double> start_of(int arm, const Arm& given) const {
    const Candidate* best = nullptr;
    for (const Candidate* candidate : mapped_)
      if (candidate->arm == arm && (!best || map_scores_.at(candidate) < map_scores_.at(best))) best = candidate;
    return best ? study_.point_of(best->values) : given.start;
  }

  /// "model": by the model's mean; any other: the best that it saw.
  json recommended(const std::vector<Trace>& traces) {
    const Candidate* best = nullptr;
    double least = 0.0;
    const auto consider = [&](const Candidate* candidate, double score) {
      if (candidate->violation > 0.0 || (best && score >= least)) return;
      best = candidate;
      least = score;
    };
    for (const Candidate* candidate : mapped_) consider(candidate, map_scores_.at(candidate));
    std::vector<const Candidate*> visited;
    for (const Trace& trace : traces)
      for (const Visit& visit : trace.visits) {
        visited.push_back(visit.candidate);
        if (visit.answered) consider(visit.candidate, visit.score);
      }
    std::string note = traces.front().note;
    if (study_.keys.algorithm == "model") {
      CandidateStore store(study_, book_, answers_);
      for (const Candidate* candidate : mapped_) store.observe(*candidate);
      StudyModel model(store, visited, study_.keys.replicates);
      note = model.in_words();
      if (model.trusted()) best = model.ranked().front().candidate;
    }
    if (!best) return {{"runs", runs_}, {"note", "no candidate keeps the constraints"}};
    return {{"arm", best->arm}, {"point", study_.point_of(best->values)}, {"runs", runs_}, {"note", note}};
  }

  Study study_;
  CandidateBook book_;
  Answers answers_;
  std::vector<double> strain_;
  results::MeasuringFrame frame_;
  int noise_seed_ = 1, runs_ = 0;
  std::vector<const Candidate*> mapped_;
  std::map<const Candidate*, double> map_scores_;
};

}  // namespace

int main(int argc, char** argv) {
  const std::string file = argc > 1 ? argv[1] : "";
  std::vector<double> strain;
  std::unique_ptr<Trial> scoring;
  try {
    for (;;) {
      const json command = read();
      const std::string what = command.at("do");
      if (what == "end") return 0;
      if (what == "describe") write({{"result", describe(command.at("journal"))}});
      if (what == "begin") {
        strain = command.at("strain").get<std::vector<double>>();
        const Study study = read_study(file);
        write({{"result", {{"arms", study.arms.size()}, {"variables", study.variables.size()}}}});
      }
      if (what == "search") write({{"result", Trial(file, command, strain).search(command)}});
      if (what == "score") {  // with the seed of the command: a new seed forgets what is known
        if (command.value("fresh", true)) scoring = std::make_unique<Trial>(file, command, strain);
        const Candidate& candidate = scoring->at(command.at("arm"), command.at("point").get<std::vector<double>>());
        const bool kept = candidate.violation <= 0.0;
        const double value = kept ? scoring->score(candidate, command.at("first"), command.at("count")).value
                                  : violation_score(candidate.violation);
        write({{"result", {{"score", value}, {"kept", kept}}}});
      }
    }
  } catch (const std::exception& error) {
    std::cerr << "emulated_search: " << error.what() << "\n";
    return 1;
  }
}
