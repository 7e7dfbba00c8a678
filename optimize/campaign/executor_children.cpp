// What is here: evaluations in child processes, one line of JSON each way. What is not: the loop of such a child
// (app/worker.cpp).
#include <fcntl.h>
#include <poll.h>
#include <sys/prctl.h>
#include <sys/socket.h>
#include <sys/wait.h>
#include <unistd.h>

#include <fmt/format.h>
#include <algorithm>
#include <cerrno>
#include <csignal>
#include <cstring>
#include <deque>
#include <set>
#include <stdexcept>
#include <thread>

#include "io/progress.h"
#include "optimize/campaign/executor.h"

namespace perfora::optimize {
namespace {

using Clock = std::chrono::steady_clock;

/// Time a child has to end after SIGTERM before it is killed.
constexpr auto grace = std::chrono::milliseconds(2000);
/// An answer longer than this is not one: a full curve takes some 100 kB.
constexpr std::size_t longest_answer = std::size_t{64} << 20;
/// Exit code of a child whose program could not be started, as shells have it.
constexpr int cannot_start = 127;

struct Job {
  std::string key;
  Request request;
  int attempts = 0;
};

struct Child {
  pid_t pid = -1;
  int socket = -1;
  std::string received;
  std::optional<Job> job;
  Clock::time_point since;
  std::set<int> replicates;  ///< whose packings it has made already
};

std::string signal_name(int signal) {
  const char* text = strsignal(signal);
  return fmt::format("signal {} ({})", signal, text ? text : "?");
}

std::string death_text(int status) {
  if (WIFSIGNALED(status)) return "the worker was ended by " + signal_name(WTERMSIG(status));
  return fmt::format("the worker ended with exit code {}", WIFEXITED(status) ? WEXITSTATUS(status) : -1);
}

/// In the child, between fork and exec: only async-signal-safe calls.
[[noreturn]] void become_worker(char* const* arguments, int socket, pid_t parent) {
  ::prctl(PR_SET_PDEATHSIG, SIGKILL);
  if (::getppid() != parent) ::_exit(cannot_start);  // The parent died before the line above.
  ::setpgid(0, 0);                                   // Ctrl-C in a terminal is the parent's business.
  ::dup2(socket, STDIN_FILENO);
  ::dup2(socket, STDOUT_FILENO);
  ::execvp(arguments[0], arguments);
  ::_exit(cannot_start);
}

class ChildExecutor final : public Executor {
 public:
  explicit ChildExecutor(ChildOptions options) : options_(std::move(options)) {
    children_.resize(static_cast<std::size_t>(std::max(1, options_.workers)));
  }

  ~ChildExecutor() override { stop(); }

  int workers() const override { return static_cast<int>(children_.size()); }

  void submit(const std::string& key, const Request& request) override { queue_.push_back({key, request, 0}); }

  std::optional<Answer> next(std::chrono::milliseconds timeout) override {
    const auto end = Clock::now() + timeout;
    while (!stopped_) {
      hand_out();
      if (!answers_.empty()) {
        Answer answer = std::move(answers_.front());
        answers_.pop_front();
        return answer;
      }
      const auto left = std::chrono::duration_cast<std::chrono::milliseconds>(end - Clock::now()).count();
      if (!receive(std::max<std::int64_t>(left, 0)) || (left <= 0 && answers_.empty())) return std::nullopt;
    }
    return std::nullopt;
  }

  void stop() override {
    stopped_ = true;
    queue_.clear();
    for (const Child& child : children_)
      if (child.pid > 0) ::kill(child.pid, SIGTERM);
    const auto end = Clock::now() + grace;
    for (Child& child : children_) {
      while (child.pid > 0 && Clock::now() < end) {
        if (::waitpid(child.pid, nullptr, WNOHANG) == child.pid)
          child.pid = -1;
        else
          std::this_thread::sleep_for(std::chrono::milliseconds(5));
      }
      if (child.pid > 0) reap(child);
      if (child.socket >= 0) ::close(child.socket);
      child.socket = -1;
    }
  }

 private:
  void start(Child& child) {
    int pair[2];
    if (::socketpair(AF_UNIX, SOCK_STREAM | SOCK_CLOEXEC, 0, pair) != 0)
      throw std::runtime_error(fmt::format("no socket for a worker: {}", std::strerror(errno)));
    std::vector<char*> arguments;
    for (std::string& text : options_.command) arguments.push_back(text.data());
    arguments.push_back(nullptr);
    const pid_t parent = ::getpid();
    const pid_t pid = ::fork();
    if (pid == 0) become_worker(arguments.data(), pair[1], parent);
    ::close(pair[1]);
    if (pid < 0) {
      ::close(pair[0]);
      throw std::runtime_error(fmt::format("a worker could not be started: {}", std::strerror(errno)));
    }
    child = Child{pid, pair[0], {}, std::nullopt, {}, {}};
  }

  /// Kills and waits; returns the exit status.
  static int reap(Child& child) {
    int status = 0;
    ::kill(child.pid, SIGKILL);
    while (::waitpid(child.pid, &status, 0) < 0 && errno == EINTR) {
    }
    child.pid = -1;
    return status;
  }

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
      if (child->pid < 0) start(*child);
      ++job.attempts;
      child->replicates.insert(job.request.replicate);
      child->job = std::move(job);
      child->since = Clock::now();
      if (!send(*child, to_json(child->job->request).dump() + "\n")) lose(*child, "");
    }
  }

  static bool send(const Child& child, const std::string& line) {
    std::size_t sent = 0;
    while (sent < line.size()) {
      const ssize_t n = ::send(child.socket, line.data() + sent, line.size() - sent, MSG_NOSIGNAL);
      if (n < 0 && errno == EINTR) continue;
      if (n <= 0) return false;
      sent += static_cast<std::size_t>(n);
    }
    return true;
  }

  /// A child is of no use any more: its job is asked again or fails. `why` empty: what its exit status says.
  void lose(Child& child, const std::string& why) {
    // A child that closed its socket is about to end by itself; its own status says more than our SIGKILL.
    int status = 0;
    bool ended = false;
    for (int k = 0; why.empty() && k < 100 && !ended; ++k) {
      ended = ::waitpid(child.pid, &status, WNOHANG) == child.pid;
      if (!ended) std::this_thread::sleep_for(std::chrono::milliseconds(2));
    }
    if (ended)
      child.pid = -1;
    else
      status = reap(child);
    if (ended && WIFEXITED(status) && WEXITSTATUS(status) == cannot_start)
      throw std::runtime_error(fmt::format("the worker program {} could not be started", options_.command.front()));
    ::close(child.socket);
    std::optional<Job> job = std::move(child.job);
    const double seconds = std::chrono::duration<double>(Clock::now() - child.since).count();
    child = Child{};
    if (!job) return;
    if (job->attempts < options_.attempts) {
      queue_.push_front(std::move(*job));
      return;
    }
    const std::string reason =
        fmt::format("{}, {} times in a row", why.empty() ? death_text(status) : why, job->attempts);
    answers_.push_back({job->key, failed_evaluation(reason, job->request.replicate), job->attempts, seconds});
  }

  /// Waits for bytes; false after a signal or when nothing runs.
  bool receive(std::int64_t milliseconds) {
    std::vector<pollfd> polls;
    std::vector<Child*> owners;
    for (Child& child : children_)
      if (child.pid > 0) {
        polls.push_back({child.socket, POLLIN, 0});
        owners.push_back(&child);
      }
    const int ready = ::poll(polls.data(), polls.size(), static_cast<int>(limited(milliseconds)));
    if (ready < 0) return false;
    for (std::size_t k = 0; k < polls.size(); ++k)
      if (polls[k].revents != 0) take(*owners[k]);
    for (Child* child : owners) check_time(*child);
    return true;
  }

  std::int64_t limited(std::int64_t milliseconds) const {
    constexpr std::int64_t look_again = 100;  // For the time limit.
    return options_.time_limit > 0.0 ? std::min(milliseconds, look_again) : milliseconds;
  }

  void check_time(Child& child) {
    if (options_.time_limit <= 0.0 || !child.job) return;
    const double seconds = std::chrono::duration<double>(Clock::now() - child.since).count();
    if (seconds > options_.time_limit)
      lose(child, fmt::format("the worker took more than {:g} s", options_.time_limit));
  }

  void take(Child& child) {
    char buffer[65536];
    const ssize_t n = ::recv(child.socket, buffer, sizeof buffer, MSG_DONTWAIT);
    if (n < 0 && (errno == EINTR || errno == EAGAIN)) return;
    if (n <= 0) return lose(child, "");
    child.received.append(buffer, static_cast<std::size_t>(n));
    const auto line_end = child.received.find('\n');
    if (line_end == std::string::npos) {
      if (child.received.size() > longest_answer) lose(child, "the worker's answer has no end");
      return;
    }
    const std::string line = child.received.substr(0, line_end);
    child.received.erase(0, line_end + 1);
    accept(child, line);
  }

  void accept(Child& child, const std::string& line) {
    if (!child.job) return lose(child, "the worker sent a line although no request was open");
    Evaluation evaluation;
    try {
      evaluation = results::evaluation_from_json(nlohmann::json::parse(line));
    } catch (const std::exception& error) {
      return lose(child, fmt::format("the worker's answer cannot be read ({})", error.what()));
    }
    // No request led to that: treated as a kill.
    if (evaluation.status == results::RunStatus::stopped) return lose(child, "the worker was told to stop");
    const double seconds = std::chrono::duration<double>(Clock::now() - child.since).count();
    answers_.push_back({child.job->key, std::move(evaluation), child.job->attempts, seconds});
    child.job.reset();
  }

  ChildOptions options_;
  std::vector<Child> children_;
  std::deque<Job> queue_;
  std::deque<Answer> answers_;
  bool stopped_ = false;
};

}  // namespace

std::unique_ptr<Executor> make_child_executor(ChildOptions options) {
  return std::make_unique<ChildExecutor>(std::move(options));
}

std::function<std::unique_ptr<Executor>()> worker_processes(const std::filesystem::path& program, int workers,
                                                            int threads) {
  const int each = std::max(1, threads / workers);
  return [program, workers, each] {
    ChildOptions children;
    children.command = {program.string(), "worker", "--quiet", "--threads", std::to_string(each)};
    children.workers = workers;
    io::log_info(
        fmt::format("{} worker{} of {} thread{}", workers, workers == 1 ? "" : "s", each, each == 1 ? "" : "s"));
    return make_child_executor(std::move(children));
  };
}

}  // namespace perfora::optimize
