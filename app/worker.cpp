// What is here: the hidden subcommand `worker`: one Request (JSON) a line on standard input, one Evaluation (JSON, with
// its curve) or trouble a line on standard output, until standard input ends; signs of life in between. What is not:
// who starts workers (optimize/campaign/executor.h).
#include <signal.h>

#include <chrono>
#include <condition_variable>
#include <iostream>
#include <mutex>
#include <string>
#include <thread>

#include "app/commands.h"
#include "app/common.h"
#include "io/error.h"
#include "optimize/campaign/worker_record.h"

namespace perfora::app {

namespace {

/// Lines on standard output, one at a time, and a sign of life every second from begin() to end(), with how far the
/// work has come: from a thread, so that it comes from long steps, too, and stops when the process is stopped.
class LineWriter {
 public:
  LineWriter() {
    sigset_t all, before;  // Signals are the business of the thread that computes.
    sigfillset(&all);
    ::pthread_sigmask(SIG_SETMASK, &all, &before);
    thread_ = std::thread([this] { tell(); });
    ::pthread_sigmask(SIG_SETMASK, &before, nullptr);
  }
  ~LineWriter() {
    {
      const std::lock_guard guard(mutex_);
      ended_ = true;
      changed_.notify_all();
    }
    thread_.join();
  }
  LineWriter(const LineWriter&) = delete;
  LineWriter& operator=(const LineWriter&) = delete;

  void begin() {
    const std::lock_guard guard(mutex_);
    computing_ = true;
    progress_ = {};
  }
  void note(const results::Progress& progress) {
    const std::lock_guard guard(mutex_);
    progress_ = progress;
  }
  /// Ends the signs of life with an answer.
  void end(const nlohmann::json& answer) {
    const std::lock_guard guard(mutex_);
    computing_ = false;
    print_text(answer.dump(-1, ' ', false, nlohmann::json::error_handler_t::replace) + "\n");
  }

 private:
  void tell() {
    std::unique_lock guard(mutex_);
    try {
      while (!changed_.wait_for(guard, std::chrono::seconds(1), [this] { return ended_; }))
        if (computing_) print_text(optimize::sign_of_life(progress_).dump() + "\n");
    } catch (const io::SurroundingsError&) {  // Nobody listens; the answer will not arrive either.
    }
  }

  std::mutex mutex_;
  std::condition_variable changed_;
  bool computing_ = false, ended_ = false;
  results::Progress progress_;
  std::thread thread_;
};

int work(int threads, double memory) {
  LineWriter lines;
  std::string line;
  while (std::getline(std::cin, line)) {
    if (line.empty()) continue;
    const nlohmann::json request = nlohmann::json::parse(line, nullptr, false);
    if (!request.is_object())
      throw io::InputError({"standard input", 0, ""}, "is no request", "a line that `perfora ask` printed is wanted",
                           "give it such a line");
    lines.begin();
    const auto [said, stopped] = optimize::evaluate_record(
        request, threads, stop_token(), memory, [&lines](const results::Progress& progress) { lines.note(progress); });
    lines.end(said);
    // Stopped in the middle: that evaluation stands for nothing, whoever started the worker sees its status and the
    // exit code.
    if (stopped) return exit_stopped;
  }
  return exit_ok;
}

}  // namespace

void add_worker(CLI::App& program, int& exit_code) {
  auto flags = std::make_shared<CommonFlags>();
  CLI::App* command = program.add_subcommand("worker", "Evaluate requests from standard input")->group("");
  add_common_flags(*command, *flags, Uses::files_only);
  command->callback([flags, &exit_code] {
    flags->apply();
    exit_code = work(flags->thread_count(1), flags->memory_allowed());
  });
}

}  // namespace perfora::app
