// What is here: what a worker says for a request, as one JSON object: written where it is evaluated, read where it was
// asked for. What is not: the way between them (executor_children.cpp, executor_mpi.cpp, app/shared.cpp).
#pragma once

#include <nlohmann/json.hpp>

#include "io/cancellation.h"
#include "optimize/campaign/executor.h"

namespace perfora::optimize {

/// An Evaluation with its curve, or {"trouble": TEXT}, and whether the worker was told to stop: the record then stands
/// for nothing.
struct WorkerRecord {
  nlohmann::json record;
  bool stopped = false;
};

/// Evaluates a request in its JSON form (request.h). A design that this program cannot read is a failed evaluation like
/// one that cannot be evaluated; what is not the design's fault is a trouble. `memory`, `progress`: as for
/// evaluate_request().
WorkerRecord evaluate_record(const nlohmann::json& request, int threads, const io::Cancellation& cancellation,
                             double memory, const results::ProgressCallback& progress = {});

/// A sign of life: {"alive": true}, with "fraction" and "text" of `progress` once there are any.
nlohmann::json sign_of_life(const results::Progress& progress);
/// Whether a record is one.
bool is_sign_of_life(const nlohmann::json& record);
/// What it tells; no text where it tells nothing.
results::Progress told_by(const nlohmann::json& sign);

/// Takes the evaluation or the trouble of a record into `answer`. Throws std::exception for what is neither.
void take_record(const nlohmann::json& record, Answer& answer);

}  // namespace perfora::optimize
