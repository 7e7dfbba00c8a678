// What is here: one compression from a clipped packing to its response, with its run file: what evaluate calls.
// What is not: designs, layouts, packings (other rooms), the time loop itself (simulation.h).
#pragma once

#include "solver/run_request.h"

namespace perfora::solver {

/// Bonds, compresses, measures, writes. A stop (request.cancellation, the wall time) writes a checkpoint and gives
/// summary.status = stopped. Numerical trouble is summary.status = failed with its reason; bad input throws
/// io::InputError.
Response run_compression(const RunRequest& request);

}  // namespace perfora::solver
