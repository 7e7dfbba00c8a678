// What is here: what carries requests to evaluations: in this process, or in child processes whose crash costs one
// evaluation. What is not: which requests (campaign.h), the journal (evaluation_queue.h).
#pragma once

#include <chrono>
#include <filesystem>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "optimize/evaluate/request.h"

namespace perfora::optimize {

/// A finished evaluation.
struct Answer {
  std::string key;
  Evaluation evaluation;
  int attempts = 1;      ///< 2: the first one crashed
  double seconds = 0.0;  ///< wall time of the last attempt
};

/// Used from one thread, which must outlive it (children die with the thread that made them).
class Executor {
 public:
  virtual ~Executor() = default;
  virtual int workers() const = 0;
  /// Queues a request; taken in this order.
  virtual void submit(const std::string& key, const Request& request) = 0;
  /// The next finished one, waiting for at most `timeout`; nothing when none finished or a signal came.
  virtual std::optional<Answer> next(std::chrono::milliseconds timeout) = 0;
  /// Drops what is queued and ends what runs; afterwards next() gives nothing.
  virtual void stop() = 0;
};

/// One evaluation. May throw: an exception becomes an evaluation with status `failed`. Must be thread-safe when there
/// is more than one worker.
using Evaluate = std::function<Evaluation(const Request&)>;

/// Threads of this process. A crash is the end of all of it; for tests, small jobs and callers with an evaluation of
/// their own.
std::unique_ptr<Executor> make_in_process_executor(Evaluate evaluate, int workers);

/// One at a time, in next() and the calling thread. Exceptions of `evaluate` pass through: for work that is shown and
/// stopped by its caller.
std::unique_ptr<Executor> make_calling_executor(Evaluate evaluate);

struct ChildOptions {
  std::vector<std::string> command;  ///< program and arguments of a worker: one Request a line on its input, one
                                     ///< Evaluation a line on its output
  int workers = 1;
  int attempts = 2;  ///< a worker that dies, or answers something else, is replaced and asked again this often in all
  double time_limit = 0.0;  ///< s of wall time an evaluation may take before its worker is killed; 0: none
};

/// Child processes, started when first needed and kept (they remember packings). They die with their parent.
std::unique_ptr<Executor> make_child_executor(ChildOptions options);

/// Makes an executor of `workers` child processes of `program`, which is perfora, that share `threads` threads.
std::function<std::unique_ptr<Executor>()> worker_processes(const std::filesystem::path& program, int workers,
                                                            int threads);

}  // namespace perfora::optimize
