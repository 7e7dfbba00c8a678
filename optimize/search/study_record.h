// What is here: what a picture of a study shows, worked out from its run. What is not: its file and form
// (results/study_record.h), drawing (report/).
#pragma once

#include "optimize/search/study_run.h"
#include "results/study_record.h"

namespace perfora::optimize {

/// The search as far as it has come; curves, layouts and facts once there is a best design.
results::StudyRecord study_record(StudyRun& run);

}  // namespace perfora::optimize
