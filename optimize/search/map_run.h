// What is here: the map of a study carried out alone in a folder. What is not: which designs (map_plan.h), the search
// behind it (study_run.h).
#pragma once

#include <map>
#include <string>

#include "optimize/campaign/campaign.h"
#include "optimize/search/driver.h"
#include "results/map_record.h"

namespace perfora::optimize {

/// One map. A study takes it by map.from, whatever it wishes.
class MapRun final : public Campaign {
 public:
  /// Opens the folder and its journal. Throws io::InputError as StudyRun does; the number of designs and what is wished
  /// may change.
  MapRun(Study study, WorkOptions options);

  const Study& study() const { return study_; }
  const Plan& plan() const { return plan_; }
  results::MapRecord record();

  std::string kind() const override { return "map"; }
  std::vector<std::string> own_files() const override;
  nlohmann::json identity() const override;
  void check_same(const nlohmann::json& head, const std::filesystem::path& journal) const override;
  std::vector<Asked> pending(const Answers& answers) override;
  std::string on_answer(const Asked& asked, const Evaluation& evaluation) override;
  std::string standing() const override { return standing_; }
  std::int64_t remaining() const override { return remaining_; }
  CampaignEnd finished() override;
  void write_results() override;

 private:
  Study study_;
  Driver driver_;
  Plan plan_;
  std::int64_t remaining_ = 0;
  std::string standing_;
};

}  // namespace perfora::optimize
