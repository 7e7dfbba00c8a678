// What is here: a sweep carried out in a folder: every case and replicate evaluated once, going on after a stop, a kill
// or a change of the sweep file. What is not: result files (sweep_result.h), how it is evaluated (executor.h).
#pragma once

#include <map>
#include <memory>
#include <string>
#include <vector>

#include "optimize/campaign/campaign.h"
#include "optimize/campaign/sweep.h"

namespace perfora::optimize {

class SweepRun final : public Campaign {
 public:
  /// Opens the folder and its journal. Throws io::InputError when the folder holds a sweep and neither `resume` nor
  /// `force` is set. A journal's evaluations are found by their request, so a resumed sweep may have other cases, other
  /// replicates, even another design: what was run already is not run again, what is no longer requested is not shown.
  SweepRun(Sweep sweep, WorkOptions options);

  const Sweep& sweep() const { return sweep_; }
  /// The evaluation of one run; nullptr while it is not known.
  const Evaluation* known(const SweepCase& one, int replicate) const;
  /// The same of a run that reached its strain; nullptr otherwise.
  const Evaluation* completed(const SweepCase& one, int replicate) const;

  std::string kind() const override { return "sweep"; }
  std::vector<std::string> own_files() const override;
  nlohmann::json identity() const override;
  /// Replicate 0 of every case, then replicate 1, ...
  std::vector<Asked> pending(const Answers& answers) override;
  std::string on_answer(const Asked& asked, const Evaluation& evaluation) override;
  std::int64_t remaining() const override { return remaining_; }
  CampaignEnd finished() override;
  void write_results() override;

 private:
  struct Run {
    Asked asked;
    std::string simulation;  ///< cases that come to the same one are one run
  };
  /// One replicate of a case that can be run.
  const Run& run_of(const SweepCase& one, int replicate) const;

  Sweep sweep_;
  std::vector<std::vector<Run>> runs_;  ///< by case and replicate; empty where a case cannot be run
  std::int64_t simulations_ = 0;        ///< Sweep::runs()
  std::int64_t remaining_ = 0;          ///< runs that are not known yet
};

}  // namespace perfora::optimize
