// What is here: the life of a child process. What is not: what is asked of it.
#include "optimize/campaign/worker_process.h"

#include <fmt/format.h>
#include <poll.h>
#include <signal.h>
#include <sys/prctl.h>
#include <sys/socket.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <fstream>

#include "io/error.h"
#include "optimize/campaign/executor.h"

namespace perfora::optimize {
namespace {

using Clock = std::chrono::steady_clock;

/// Time that a killed process has to go: it takes milliseconds unless the system does not let it.
constexpr auto to_go = std::chrono::milliseconds(2000);

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

}  // namespace

WorkerProcess::WorkerProcess(const std::vector<std::string>& command) {
  int pair[2];
  if (::socketpair(AF_UNIX, SOCK_STREAM | SOCK_CLOEXEC, 0, pair) != 0)
    throw io::SurroundingsError(fmt::format("no socket for a worker: {}; --resume goes on", std::strerror(errno)));
  std::vector<std::string> texts = command;
  std::vector<char*> arguments;
  for (std::string& text : texts) arguments.push_back(text.data());
  arguments.push_back(nullptr);
  const pid_t parent = ::getpid();
  pid_ = ::fork();
  if (pid_ == 0) become_worker(arguments.data(), pair[1], parent);
  const int error = errno;
  ::close(pair[1]);
  if (pid_ < 0) {
    ::close(pair[0]);
    throw io::SurroundingsError(
        fmt::format("a worker could not be started: {}; take fewer --workers; --resume goes on", std::strerror(error)));
  }
  socket_ = pair[0];
}

WorkerProcess::~WorkerProcess() {
  kill();
  ::close(socket_);
}

bool WorkerProcess::send(const std::string& line) const {
  std::size_t sent = 0;
  while (sent < line.size()) {
    const ssize_t n = ::send(socket_, line.data() + sent, line.size() - sent, MSG_NOSIGNAL);
    if (n < 0 && errno == EINTR) continue;
    if (n <= 0) return false;
    sent += static_cast<std::size_t>(n);
  }
  return true;
}

bool WorkerProcess::receive() {
  char buffer[65536];
  const ssize_t n = ::recv(socket_, buffer, sizeof buffer, MSG_DONTWAIT);
  if (n < 0) return errno == EINTR || errno == EAGAIN;
  received_.append(buffer, static_cast<std::size_t>(n));
  return n > 0;
}

std::optional<std::string> WorkerProcess::line() {
  const auto end = received_.find('\n');
  if (end == std::string::npos) return std::nullopt;
  std::string line = received_.substr(0, end);
  received_.erase(0, end + 1);
  return line;
}

bool WorkerProcess::is_stopped() const {
  std::ifstream file(fmt::format("/proc/{}/stat", pid_));
  std::string text;
  std::getline(file, text);
  const auto name_end = text.rfind(')');  // the name before it may hold anything
  return name_end != std::string::npos && text.substr(name_end).starts_with(") T");
}

void WorkerProcess::ask_to_end(bool at_work) const {
  ::shutdown(socket_, SHUT_WR);
  if (at_work && !status_) ::kill(pid_, SIGTERM);
}

std::optional<int> WorkerProcess::wait(std::chrono::milliseconds longest) {
  const auto end = Clock::now() + longest;
  while (!status_) {
    int status = 0;
    const pid_t got = ::waitpid(pid_, &status, WNOHANG);
    if (got == pid_ || (got < 0 && errno == ECHILD)) {
      status_ = status;
      break;
    }
    if (Clock::now() >= end) break;
    // It must not wait for a reader of its last words.
    pollfd words{socket_, POLLIN, 0};
    const bool open = ::poll(&words, 1, 2) <= 0 || receive();
    received_.clear();
    if (!open) ::usleep(1000);
  }
  return status_;
}

void WorkerProcess::kill() {
  if (status_) return;
  ::kill(pid_, SIGKILL);
  wait(to_go);
}

}  // namespace perfora::optimize
