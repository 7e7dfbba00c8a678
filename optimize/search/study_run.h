// What is here: a study carried out in a folder: journal, driver and executor put together; going on after a stop or a
// kill. What is not: what comes next (driver.h), how it is evaluated (executor.h), the result files (study_result.h).
#pragma once

#include <filesystem>
#include <functional>
#include <map>
#include <memory>
#include <optional>
#include <set>
#include <string>

#include "optimize/campaign/campaign.h"
#include "optimize/search/driver.h"
#include "optimize/search/study.h"
#include "optimize/search/study_plan.h"
#include "results/map_record.h"

namespace perfora::optimize {

/// One study. Plans point into it, so it must outlive them.
class StudyRun final : public Campaign {
 public:
  /// Opens the folder and its journal. Throws io::InputError when the folder holds a study and neither `resume` nor
  /// `force` is set, and when the study of the journal differs from this one (the key that differs and both values are
  /// named; how far to go and what is wished may change). `wall_time`, s: the search ends early, which the journal
  /// notes, so that race and verification are done by then, as far as the times of the runs tell; 0: no limit.
  StudyRun(Study study, WorkOptions options, double wall_time = 0.0);

  const Study& study() const { return study_; }
  const Plan& plan() const { return plan_; }
  CandidateBook& book() { return driver_.book(); }
  /// Evaluations of a candidate for replicates [first, first + count) that are known, in order.
  std::vector<const Evaluation*> known(const Candidate& candidate, int first, int count, std::size_t fidelity = 0);
  /// What the map tells, once it has a design; nothing without a map.
  std::optional<results::MapRecord> map();
  /// Evaluations that were not run for this study: of another folder, or before its target was changed.
  int taken_over() const { return taken_over_; }

  std::string kind() const override { return "study"; }
  std::vector<std::string> own_files() const override;
  nlohmann::json identity() const override;
  void check_same(const nlohmann::json& head, const std::filesystem::path& journal) const override;
  std::vector<Asked> pending(const Answers& answers) override;
  std::string on_answer(const Asked& asked, const Evaluation& evaluation) override;
  std::string standing() const override { return standing_; }
  std::int64_t remaining() const override;
  CampaignEnd finished() override;
  void write_results() override;

 private:
  /// Evaluations of another folder.
  struct Taken {
    std::vector<nlohmann::json> events;
    std::size_t designs = 0;
  };
  Taken read_map(const WorkOptions& options);
  void take_map(Taken taken);
  std::string standing_now();
  void end_early_if_late();

  Study study_;
  Driver driver_;
  Plan plan_;
  StudyPlan planned_;
  double wall_time_ = 0.0;  ///< s
  std::string standing_;
  int taken_over_ = 0;
  std::set<std::string> said_;                          ///< notes of the search
  std::map<std::string, const Candidate*> candidates_;  ///< by request key, of everything asked
};

/// How many evaluations can run at once: `asked`, or the study's workers, or one a processor, but not more than arms x
/// replicates.
int useful_workers(const Study& study, int asked);

}  // namespace perfora::optimize
