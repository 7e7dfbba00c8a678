// What is here: NLopt's derivative-free algorithms as a searcher. What is not: NLopt itself (nlopt_search.h).
#pragma once

#include <memory>

#include "optimize/search/searcher.h"

namespace perfora::optimize {

/// Search by replay: every task runs NLopt from the start, answers known points from the store and stops at the first
/// open one. Tasks are sequential searches: each has one open visit at most.
std::shared_ptr<const Searcher> make_nlopt_searcher();

}  // namespace perfora::optimize
