// What is here: one call of Driver::plan(): what is known and what it collects, for driver.cpp and driver_end.cpp
// alone. What is not: what a plan is (driver.h).
#pragma once

#include <set>
#include <string>
#include <vector>

#include "optimize/search/driver.h"

namespace perfora::optimize {

struct Driver::View {
  const Study& study;
  CandidateBook& book;
  const Driver& driver;
  CandidateStore store;
  Plan plan = {};
  std::set<std::string> asked = {};
  /// Designs with all replicates of the search, in the order in which they were met; the start only inside the bounds.
  struct Known {
    const Candidate* candidate;
    Score score;
  };
  std::vector<Known> pool = {};
  std::set<const Candidate*> pooled = {};

  /// The evaluations of a candidate for replicates [first, first + count); empty, with the missing ones added to
  /// `wanted`, when some are unknown.
  std::vector<const Evaluation*> evaluations(const Candidate& candidate, int first, int count,
                                             std::size_t fidelity = 0);

  // driver.cpp
  void tell(const Candidate& candidate);
  void take(const Visit& visit);
  void consider(const Visit& visit);
  bool run_map();
  bool run(const Searcher& searcher, SearchStage stage, const char* name);
  bool run_best_of_map();
  bool run_refine();
  /// Where a local search of an arm begins: the best design of the map, where there is one.
  void start_from_map(SearchStage& stage) const;
  std::string end_reason() const;

  // driver_end.cpp
  void rank_pool();
  bool run_race();
  bool run_verification();

 private:
  std::vector<Visit> best_of_map() const;
  void cut(Trace& trace, bool in_batches, std::size_t known_batches) const;
  void note_batch(const std::vector<Trace>& traces, const SearchStage& stage, const char* name);
  std::vector<std::string> ranked_by_model();
  Score raced(const Candidate& candidate, int rounds, bool& complete);
  bool compare_with_start(int first);
};

}  // namespace perfora::optimize
