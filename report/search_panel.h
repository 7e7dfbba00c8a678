// What is here: the panel of a search: the score of every candidate over its number. What is not: pages.
#pragma once

#include "report/canvas.h"
#include "report/plot_study.h"

namespace perfora::report {

/// Dots by arm, the incumbent as steps, the best one ringed, candidates without a score at the upper rim, the key of
/// the arms above `box`.
void draw_search(Canvas& canvas, const results::StudyRecord& picture, const Box& box);

/// Smallest score so far at each evaluation (feasible, finite ones only); NaN before the first.
std::vector<double> incumbent_scores(const std::vector<results::StudyPoint>& evaluations);

}  // namespace perfora::report
