// What is here: a candidate of a study, its constraints and its requests, each worked out once.
// What is not: which candidate comes next (driver.h).
#pragma once

#include <map>
#include <optional>
#include <span>
#include <string>
#include <tuple>
#include <utility>
#include <vector>

#include "optimize/evaluate/request.h"
#include "optimize/search/study.h"

namespace perfora::optimize {

/// One design of the search.
struct Candidate {
  int arm = -1;                ///< index in Study::arms; -1: the start design, where no arm holds it
  std::vector<double> values;  ///< of the variables, SI
  std::string label;           ///< "rows=2 columns=2, diameter 16.2 mm"
  LayoutMeasure layout;
  std::vector<double> limits;     ///< constraint values, kept where <= 0
  double violation = 0.0;         ///< > 0: costs no simulation
  std::string problem;            ///< why it cannot be simulated; empty otherwise
  std::vector<Request> requests;  ///< for replicate 0, one a fidelity of the study; empty where it cannot be simulated

  Request request(int replicate, std::size_t fidelity = 0) const {
    Request one = requests.at(fidelity);
    one.replicate = replicate;
    return one;
  }
};

/// Candidates by arm and values. A memory only: the same question always has the same answer.
class CandidateBook {
 public:
  explicit CandidateBook(const Study& study) : study_(study) {}
  /// References stay valid as long as the book.
  const Candidate& at(int arm, std::span<const double> values);
  /// Key of the request for one replicate at one fidelity, worked out once.
  const std::string& key(const Candidate& candidate, int replicate, std::size_t fidelity = 0);
  /// The start design: the candidate of the arm and bounds that hold it, or one of its own with arm -1.
  const Candidate& start();

 private:
  const Study& study_;
  std::map<std::pair<int, std::vector<double>>, Candidate> candidates_;
  std::map<std::tuple<const Candidate*, int, std::size_t>, std::string> keys_;
};

/// The design a candidate stands for, with output options of the start design: what best.toml holds.
DesignFile design_of(const Study& study, const Candidate& candidate);

}  // namespace perfora::optimize
