// What is here: evaluations for a folder of work that another process, perhaps on another host, carries out. What is
// not: the files between (shared_folder.h).
#pragma once

#include <chrono>
#include <filesystem>
#include <functional>
#include <string>

#include "io/cancellation.h"
#include "optimize/campaign/executor.h"

namespace perfora::optimize {

struct SharedWorkOptions {
  /// How long to wait for something to do before giving up: for a folder that is not there yet, too.
  std::chrono::duration<double> patience{600.0};
  io::Cancellation cancellation;  ///< requested: it ends after the evaluation that is under way has stopped
  /// How often the folder is told how far an evaluation has come.
  std::chrono::duration<double> between_signs{5.0};
  /// Hears how far the evaluation under way has come. May be empty.
  std::function<void(const std::string& key, const results::Progress& progress)> progress;
  /// Hears of every answer that was delivered. May be empty.
  std::function<void(const std::string& key, const Answer& answer)> delivered;
};

/// How it ended.
enum class SharedEnd {
  finished,   ///< the work is done: nobody asks any more
  idle,       ///< nothing came within the patience
  cancelled,  ///< cancellation was requested
};

/// An evaluation that tells how far it has come; otherwise as for executors.
using EvaluateAndTell = std::function<Evaluation(const Request&, const results::ProgressCallback&)>;

/// Evaluates what the folder asks, one after another, until there is nothing left. What `evaluate` throws as
/// io::InputError is a failed evaluation, anything else a trouble.
SharedEnd work_for(const std::filesystem::path& work, const EvaluateAndTell& evaluate,
                   const SharedWorkOptions& options);

}  // namespace perfora::optimize
