// What is here: the search that learns: batches where a model expects the largest improvement. What is not: the model
// (study_model.h), sampling (sampling_searcher.h).
#pragma once

#include <memory>

#include "optimize/search/searcher.h"

namespace perfora::optimize {

/// "model": one search over all arms in batches of SearchStage::batch points. Scrambled Sobol points of all arms first,
/// where the designs that are told do not suffice for a model; then the points with the largest expected improvement of
/// the score (TargetAnswers), which NLopt's GN_DIRECT_L looks for in every arm and LN_SBPLX refines, one after the
/// other, each as if those before it had given what the model expects of them. Only points that keep the constraints
/// are asked for. It ends at maxeval points, or when twice running hardly any improvement is expected. Where left-out
/// designs show that the model deserves no trust, the batch is the next points of NLopt's GN_DIRECT_L instead, and the
/// trace says so.
std::shared_ptr<const Searcher> make_model_searcher();

}  // namespace perfora::optimize
