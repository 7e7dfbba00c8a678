// What is here: one child process that takes lines on its input and gives lines on its output: started, watched, ended.
// What is not: what the lines say (executor_children.cpp).
#pragma once

#include <sys/types.h>

#include <chrono>
#include <optional>
#include <string>
#include <vector>

namespace perfora::optimize {

/// A child in a process group of its own, which dies with the thread that started it. Ended with the object.
class WorkerProcess {
 public:
  /// Longest line that is read, bytes: a full curve takes some 100 kB.
  static constexpr std::size_t longest_line = std::size_t{64} << 20;

  /// Program and arguments. Throws io::SurroundingsError when no process can be made.
  explicit WorkerProcess(const std::vector<std::string>& command);
  ~WorkerProcess();
  WorkerProcess(const WorkerProcess&) = delete;
  WorkerProcess& operator=(const WorkerProcess&) = delete;

  int socket() const { return socket_; }
  /// False: it takes nothing any more.
  bool send(const std::string& line) const;
  /// Takes what it has written, without waiting. False: it has closed its output.
  bool receive();
  /// The next whole line of what was received.
  std::optional<std::string> line();
  std::size_t unread() const { return received_.size(); }

  /// Whether SIGSTOP or the like keeps it from running.
  bool is_stopped() const;
  /// Its input ends, so that an idle one ends by itself; one at work gets SIGTERM, too.
  void ask_to_end(bool at_work) const;
  /// Waits for at most `longest`, throwing away what it writes; its wait status once it has ended.
  std::optional<int> wait(std::chrono::milliseconds longest);
  /// Ends it now. One that the system does not let go of (a dead network disk) is left behind.
  void kill();

 private:
  pid_t pid_ = -1;
  int socket_ = -1;
  std::string received_;
  std::optional<int> status_;
};

}  // namespace perfora::optimize
