// What is here: evaluations in child processes, one line of JSON each way; those that died, hang or were stopped
// replaced. What is not: the loop of such a child (app/worker.cpp), whether a request is asked again
// (evaluation_queue.cpp).
#include <fmt/format.h>
#include <poll.h>
#include <sys/wait.h>

#include <algorithm>
#include <csignal>
#include <cstring>
#include <deque>
#include <memory>
#include <set>

#include "io/error.h"
#include "io/progress.h"
#include "optimize/campaign/executor.h"
#include "optimize/campaign/time_limit.h"
#include "optimize/campaign/worker_process.h"
#include "optimize/campaign/worker_record.h"

namespace perfora::optimize {
namespace {

using Clock = std::chrono::steady_clock;
using Seconds = std::chrono::duration<double>;

/// Time a child has to end after SIGTERM before it is killed.
constexpr auto grace = std::chrono::milliseconds(2000);
/// How often time limits and silent children are looked at.
constexpr auto look_again = std::chrono::milliseconds(100);
/// A child that was found stopped so often in a row is replaced: one may be seen so while everything wakes up.
constexpr int looks_until_replaced = 5;
/// A longer gap between two looks means that this process did not run: silence then tells nothing of the children.
constexpr auto own_gap = std::chrono::milliseconds(2000);

struct Job {
  std::string key;
  Request request;
};

struct Child {
  std::unique_ptr<WorkerProcess> process;  ///< nullptr: not started
  std::optional<Job> job;
  Clock::time_point since, last_sign;
  double time_limit = 0.0;     ///< s, of the job; 0: none
  results::Progress progress;  ///< of the job
  int seen_stopped = 0;
  std::set<int> replicates;  ///< whose packings it has made already
};

std::string death_text(std::optional<int> status) {
  if (!status) return "the worker cannot be ended";
  if (WIFSIGNALED(*status)) {
    const char* text = strsignal(WTERMSIG(*status));
    return fmt::format("the worker was ended by signal {} ({})", WTERMSIG(*status), text ? text : "?");
  }
  return fmt::format("the worker ended with exit code {}", WEXITSTATUS(*status));
}

class ChildExecutor final : public Executor {
 public:
  explicit ChildExecutor(ChildOptions options)
      : options_(std::move(options)), limits_(options_.threads), last_look_(Clock::now()) {
    children_.resize(static_cast<std::size_t>(std::max(1, options_.workers)));
  }

  ~ChildExecutor() override { stop(); }

  int workers() const override { return static_cast<int>(children_.size()); }

  void submit(const std::string& key, const Request& request) override { queue_.push_back({key, request}); }

  std::optional<Answer> next(std::chrono::milliseconds timeout) override {
    const auto end = Clock::now() + timeout;
    while (!stopped_) {
      hand_out();
      if (!answers_.empty()) {
        Answer answer = std::move(answers_.front());
        answers_.pop_front();
        return answer;
      }
      const auto left = std::chrono::duration_cast<std::chrono::milliseconds>(end - Clock::now());
      if (!receive(std::max(left, std::chrono::milliseconds(0))) || (left.count() <= 0 && answers_.empty()))
        return std::nullopt;
    }
    return std::nullopt;
  }

  std::vector<UnderWay> under_way() const override {
    std::vector<UnderWay> all;
    for (const Child& child : children_)
      if (child.job) all.push_back({child.job->key, seconds_of(child), child.progress});
    return all;
  }

  void stop() override {
    stopped_ = true;
    queue_.clear();
    for (const Child& child : children_)
      if (child.process) child.process->ask_to_end(child.job.has_value());
    const auto end = Clock::now() + grace;
    for (Child& child : children_) {
      if (!child.process) continue;
      const auto left = std::chrono::duration_cast<std::chrono::milliseconds>(end - Clock::now());
      if (!child.process->is_stopped()) child.process->wait(std::max(left, std::chrono::milliseconds(0)));
      child = Child{};
    }
  }

 private:
  /// An idle child for a job: one that knows its replicate where there is one.
  Child* idle(int replicate) {
    Child* found = nullptr;
    for (Child& child : children_) {
      if (child.job) continue;
      if (child.replicates.contains(replicate)) return &child;
      if (!found) found = &child;
    }
    return found;
  }

  void hand_out() {
    while (!queue_.empty()) {
      Child* child = idle(queue_.front().request.replicate);
      if (!child) return;
      Job job = std::move(queue_.front());
      queue_.pop_front();
      if (!child->process) child->process = std::make_unique<WorkerProcess>(options_.command);
      child->replicates.insert(job.request.replicate);
      child->time_limit = options_.time_limit.count() > 0.0 ? options_.time_limit.count() : limits_.of(job.request);
      child->job = std::move(job);
      child->since = child->last_sign = Clock::now();
      child->seen_stopped = 0;
      child->progress = {};
      if (!child->process->send(to_json(child->job->request).dump() + "\n")) lose(*child, "");
    }
  }

  double seconds_of(const Child& child) const { return Seconds(Clock::now() - child.since).count(); }

  /// A child is of no use any more. `why` empty: what its exit status says.
  void lose(Child& child, std::string why) {
    if (why.empty()) {
      // A child that closed its socket is about to end by itself; its own status says more than our SIGKILL.
      std::optional<int> status = child.process->wait(std::chrono::milliseconds(200));
      if (status && WIFEXITED(*status) && WEXITSTATUS(*status) == cannot_start)
        throw io::SurroundingsError(fmt::format("the worker program {} could not be started; check that it is there",
                                                options_.command.front()));
      why = status ? death_text(status) : "the worker closed its output";
    }
    const std::optional<Job> job = std::move(child.job);
    const double seconds = seconds_of(child);
    child = Child{};
    if (job) answers_.push_back({job->key, {}, seconds, std::move(why)});
  }

  /// Waits for bytes; false after a signal.
  bool receive(std::chrono::milliseconds longest) {
    std::vector<pollfd> polls;
    std::vector<Child*> owners;
    for (Child& child : children_)
      if (child.process) {
        polls.push_back({child.process->socket(), POLLIN, 0});
        owners.push_back(&child);
      }
    const int ready = ::poll(polls.data(), polls.size(), static_cast<int>(std::min(longest, look_again).count()));
    if (ready < 0) return false;
    const auto now = Clock::now();
    if (now - last_look_ > own_gap)
      for (Child* child : owners) child->last_sign = now;
    last_look_ = now;
    for (std::size_t k = 0; k < polls.size(); ++k)
      if (polls[k].revents != 0)
        take(*owners[k]);
      else
        look_at(*owners[k]);
    return true;
  }

  /// A child from which nothing has come.
  void look_at(Child& child) {
    if (!child.job) return;
    if (child.time_limit > 0.0 && seconds_of(child) > child.time_limit)
      return lose(child, fmt::format("the worker took more than {:.3g} s (time_limit)", child.time_limit));
    if (Clock::now() - child.last_sign < options_.silence) return;
    // A busy machine lets a worker wait, too; only one that is stopped will never answer.
    child.seen_stopped = child.process->is_stopped() ? child.seen_stopped + 1 : 0;
    if (child.seen_stopped >= looks_until_replaced)
      lose(child, fmt::format("the worker was stopped and gave no sign of life for {:.3g} s",
                              Seconds(Clock::now() - child.last_sign).count()));
  }

  void take(Child& child) {
    const bool open = child.process->receive();
    child.last_sign = Clock::now();
    while (child.process) {
      const std::optional<std::string> line = child.process->line();
      if (!line) break;
      accept(child, *line);
    }
    if (!child.process) return;
    if (!open) return lose(child, "");
    if (child.process->unread() > WorkerProcess::longest_line) return lose(child, "the worker's answer has no end");
    if (child.job && child.time_limit > 0.0 && seconds_of(child) > child.time_limit) look_at(child);
  }

  void accept(Child& child, const std::string& line) {
    nlohmann::json record = nlohmann::json::parse(line, nullptr, false);
    if (is_sign_of_life(record)) {
      child.progress = told_by(record);
      return;
    }
    if (!child.job) return lose(child, "it was not asked");
    Answer answer{child.job->key, {}, seconds_of(child)};
    try {
      take_record(record, answer);
    } catch (const std::exception& error) {
      return lose(child, fmt::format("the worker's answer cannot be read ({})", error.what()));
    }
    // No request led to that: treated as a kill.
    if (answer.trouble.empty() && answer.evaluation.status == results::RunStatus::stopped)
      return lose(child, "the worker was told to stop");
    if (answer.trouble.empty()) limits_.learn(child.job->request, answer.seconds);
    answers_.push_back(std::move(answer));
    child.job.reset();
  }

  ChildOptions options_;
  TimeLimits limits_;
  std::vector<Child> children_;
  std::deque<Job> queue_;
  std::deque<Answer> answers_;
  Clock::time_point last_look_;
  bool stopped_ = false;
};

}  // namespace

std::unique_ptr<Executor> make_child_executor(ChildOptions options) {
  return std::make_unique<ChildExecutor>(std::move(options));
}

std::function<std::unique_ptr<Executor>()> worker_processes(const WorkerProcesses& wanted) {
  return [wanted] {
    ChildOptions children;
    children.workers = wanted.workers;
    children.threads = std::max(1, wanted.threads / wanted.workers);
    children.command = {wanted.program.string(), "worker", "--quiet", "--threads", std::to_string(children.threads)};
    if (wanted.memory > 0.0)
      for (const std::string& text : {std::string("--memory"), fmt::format("{:.0f} B", wanted.memory / wanted.workers)})
        children.command.push_back(text);
    children.time_limit = Seconds(wanted.time_limit);
    io::log_info(fmt::format("{} worker{} of {} thread{}", children.workers, children.workers == 1 ? "" : "s",
                             children.threads, children.threads == 1 ? "" : "s"));
    return make_child_executor(std::move(children));
  };
}

}  // namespace perfora::optimize
