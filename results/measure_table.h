// What is here: the one table of measures: every number that a packing or a run is summed up by, with its key, unit and
// words. Summary texts, JSON, sweeps, ensembles, correlations, labels of pictures and the page of formats follow from
// it. What is not: how they are computed (measures.h, solver/run.cpp).
#pragma once

#include <span>
#include <string>
#include <string_view>
#include <variant>

#include "io/schema.h"
#include "results/evaluation.h"

namespace perfora::results {

/// Where a measure is printed; `hidden` ones stand in JSON and tables only.
enum class MeasureGroup { packing, curve, breakage, run, hidden };

/// Which side of a wish is kept where it gives one number.
enum class Sense { none, at_most, at_least, within };

/// What a measure of value x adds to the score of a candidate, times its weight.
enum class Term {
  none,
  square,           ///< x^2: best is 0
  logarithm,        ///< (ln x)^2: best is 1
  logarithm_above,  ///< (ln(x/target stress))^2 where x is above it
  logarithm_below,  ///< the same where x is below
  shortfall         ///< (1 - x)^2: best is 1, for strains
};

struct Measure {
  const char* key;  ///< in JSON and in the head of tables
  /// Where its value is kept; a function for what is no plain member.
  std::variant<double PackSummary::*, std::int64_t PackSummary::*, double (*)(const PackSummary&), double Summary::*,
               std::int64_t Summary::*>
      member;
  io::Dimension dimension;
  MeasureGroup group;
  const char* label;        ///< in summaries
  const char* help;         ///< one clause, in the page of formats
  int ensemble_column = 0;  ///< its place among the results of an ensemble, from 1; 0: none
  int sweep_column = 0;  ///< of a packing's measures: the place among the results of a sweep, which has all of a run's
  Sense sense = Sense::none;  ///< none: no wish can be made of it
  Term term = Term::none;     ///< none: it can have no weight in a score

  bool of_packing() const { return member.index() < 3; }
};

/// In the order of summaries.
std::span<const Measure> measures();
/// No table has more.
inline constexpr std::size_t most_measures = 96;
/// The measure of a key; nullptr for any other text.
const Measure* measure_called(std::string_view key);
/// SI; NaN where it was not reached.
double value_of(const Measure& measure, const PackSummary& pack, const Summary& summary);
double value_of(const Measure& measure, const Evaluation& evaluation);
/// Ensembles take statistics of these, in this order.
const std::vector<const Measure*>& ensemble_measures();
/// Sweeps take statistics of these, in this order: of the packing, then all of the run by their keys.
const std::vector<const Measure*>& sweep_measures();
/// The table as Markdown: key, unit, meaning (docs/user/formats.md).
std::string measure_reference();

}  // namespace perfora::results
