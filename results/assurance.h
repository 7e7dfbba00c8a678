// What is here: what a few blocks say of the next one: how likely it keeps all wishes, and where it will lie; what a
// run gives for a wish. What is not: the verdict (verdict.h), intervals of means (interval.h).
#pragma once

#include <nlohmann/json.hpp>
#include <span>
#include <string>
#include <vector>

#include "results/evaluation.h"
#include "results/interval.h"
#include "results/target.h"

namespace perfora::results {

/// With probability `confidence` it holds the probability of something that happened in `count` of `trials` (Clopper
/// and Pearson 1934: never less often than that).
Interval binomial_interval(int count, int trials);

/// With probability `confidence` the next value lies in it: mean +- t s sqrt(1 + 1/n), on the logarithms where all
/// values are positive. Two values at least.
Interval prediction_interval(const std::vector<double>& values);

/// What a run gives for a wish of this measure or for its term in a score; NaN where it was not reached. Where the
/// stress did not leave the plateau before the end of the run, the plateau is at least as long as the run.
double wished_value(const Measure& measure, const Evaluation& evaluation);

struct Assurance {
  int blocks = 0, keeping = 0;  ///< blocks, and those that keep every wish
  Interval probability;         ///< that a block keeps all of them: binomial_interval()
  struct Next {
    const Measure* measure = nullptr;
    int count = 0;      ///< blocks that have the measure
    Interval interval;  ///< of the next block that has it
  };
  std::vector<Next> next;  ///< a wish each; those of the packing, and with fewer than two values, are left out
};
/// Of blocks of one design (no null pointers) on seeds that did not choose it. A failed one keeps nothing.
Assurance assurance_of(const Target& target, std::span<const Evaluation* const> blocks);

/// "8 of 8 single blocks keep all wishes (95 %: 63 to 100 % of all blocks); the next block: plateau stress 310 to
/// 430 kPa"
std::string in_words(const Assurance& assurance);
nlohmann::json to_json(const Assurance& assurance);

}  // namespace perfora::results
