// What is here: what carries requests to evaluations: in this process, or in child processes whose crash costs one
// attempt. What is not: which requests (campaign.h), the journal (evaluation_queue.h).
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

/// What came of an attempt: an evaluation, or a failure of the surroundings.
struct Answer {
  std::string key;
  Evaluation evaluation;
  double seconds = 0.0;  ///< wall time of the attempt
  /// What kept the surroundings from evaluating (the worker was killed, the disk is full, ...): says nothing of the
  /// design, `evaluation` means nothing, and the same request may be asked again. Empty: there is an evaluation.
  std::string trouble = {};
  int attempts = 1;  ///< of this request in this session, this one included; counted by whoever asks
};

/// An evaluation that a worker is at.
struct UnderWay {
  std::string key;
  double seconds = 0.0;        ///< wall time so far
  results::Progress progress;  ///< no text: not known
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
  /// What the workers are at, where they tell.
  virtual std::vector<UnderWay> under_way() const { return {}; }
};

/// One evaluation. May throw: io::InputError becomes an evaluation with status `failed`, anything else a trouble. Must
/// be thread-safe when there is more than one worker.
using Evaluate = std::function<Evaluation(const Request&)>;

/// The answer to a request of this replicate: what `evaluate` gives, or what its exception means: a failed evaluation
/// (io::InputError), one that was stopped (io::Cancelled), or a trouble (anything else).
Answer answered(const std::string& key, int replicate, const std::function<Evaluation()>& evaluate);

/// Threads of this process. A crash is the end of all of it; for tests, small jobs and callers with an evaluation of
/// their own.
std::unique_ptr<Executor> make_in_process_executor(Evaluate evaluate, int workers);

/// One at a time, in next() and the calling thread. Exceptions of `evaluate` pass through: for work that is shown and
/// stopped by its caller.
std::unique_ptr<Executor> make_calling_executor(Evaluate evaluate);

/// Exit code of a worker whose program could not be started, as shells have it.
inline constexpr int cannot_start = 127;

struct ChildOptions {
  /// Program and arguments of a worker. It takes a Request a line on its input. On its output it gives a line for each:
  /// an Evaluation, or {"trouble": TEXT}; before it, while it computes, a sign of life every second (worker_record.h).
  std::vector<std::string> command;
  int workers = 1;
  int threads = 1;                                ///< of each
  std::chrono::duration<double> time_limit{0.0};  ///< wall time an evaluation may take; 0: from its estimate
  std::chrono::milliseconds silence{1500};  ///< after which a worker is looked at; one that is stopped is replaced
};

/// Child processes, started when first needed and kept (they remember packings). They die with their parent.
std::unique_ptr<Executor> make_child_executor(ChildOptions options);

/// Child processes of perfora, and what they share.
struct WorkerProcesses {
  std::filesystem::path program;
  int workers = 1;
  int threads = 1;          ///< of all together
  double time_limit = 0.0;  ///< s, as in ChildOptions
  double memory = 0.0;      ///< bytes of all together: a worker refuses what takes more than its part; 0: no limit
};
std::function<std::unique_ptr<Executor>()> worker_processes(const WorkerProcesses& wanted);

}  // namespace perfora::optimize
