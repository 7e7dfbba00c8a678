// What is here: what plot_sweep draws, from the record of a sweep or an ensemble. What is not: drawing (plot_sweep.h),
// files (results/sweep_record.h).
#pragma once

#include "report/plot_sweep.h"
#include "results/sweep_record.h"

namespace perfora::report {

/// Cases grouped as the record says; `record` has its runs.
SweepPicture sweep_picture(const results::SweepRecord& record);

}  // namespace perfora::report
