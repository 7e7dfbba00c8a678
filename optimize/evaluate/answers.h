// What is here: evaluations that are known, and which of them answers a request. What is not: where they are kept
// (campaign/evaluation_queue.h), scores.
#pragma once

#include <cstddef>
#include <functional>
#include <map>
#include <optional>
#include <string>

#include "optimize/evaluate/request.h"
#include "results/history_file.h"

namespace perfora::optimize {

/// The full history of the longest evaluation of a key; nothing where none was kept.
using Histories = std::function<std::optional<results::StoredHistory>(const std::string& key)>;

/// Evaluations by the key of their request. A key may have several, of other strains and windows. Pointers to them stay
/// valid until one of the same key, strain and window replaces it.
class Answers {
 public:
  using Stored = std::multimap<std::string, Evaluation>;
  /// Keeps an evaluation; one of the same key, strain and window before it is dropped.
  void add(const std::string& key, Evaluation evaluation);
  std::size_t size() const { return stored_.size(); }
  bool empty() const { return stored_.empty(); }
  Stored::const_iterator begin() const { return stored_.begin(); }
  Stored::const_iterator end() const { return stored_.end(); }
  std::pair<Stored::const_iterator, Stored::const_iterator> of(const std::string& key) const {
    return stored_.equal_range(key);
  }

  /// Where histories come from, so that one evaluation answers for other windows and smaller strains.
  void set_histories(Histories histories) { histories_ = std::move(histories); }
  /// The evaluation that a stored one of `key` gives for the grade, the window and the strain of `request`, without a
  /// run; nullptr where what is kept does not tell. It is remembered.
  const Evaluation* derived(const Request& request, const std::string& key) const;

 private:
  std::optional<Evaluation> at_grade_of(const Request& request, const std::string& key) const;
  std::optional<Evaluation> measured_anew(const Request& request, const std::string& key) const;

  Stored stored_;
  Histories histories_;
  mutable Stored derived_;  ///< from a stored one: what was found once costs nothing
};

/// Whether an evaluation of the request's key is what the request asks for, but for its grade: its run ended with the
/// same row, and its curve was measured as the design says. A failed one is, unless it failed beyond the strain
/// that is asked for. A material test is one in any case.
bool is_answer(const Evaluation& evaluation, const Request& request);

/// The evaluation that answers `request`, whose key is `key`: a stored one, or one derived from it; nullptr where none
/// does, so that it has to be evaluated.
const Evaluation* answer_for(const Request& request, const std::string& key, const Answers& known);

}  // namespace perfora::optimize
