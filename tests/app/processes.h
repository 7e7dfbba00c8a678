// What is here: the program started as a user starts it, watched, killed. What is not: tests.
#pragma once

#include <fcntl.h>
#include <gtest/gtest.h>
#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

#include <filesystem>
#include <string>
#include <vector>

extern char** environ;  // NOLINT: POSIX declares it nowhere

namespace perfora {

/// Starts perfora with these arguments; what it writes goes to the files, or nowhere.
inline pid_t start(const std::vector<std::string>& arguments, const std::filesystem::path& errors = "/dev/null") {
  std::vector<std::string> texts{PERFORA_PROGRAM};
  texts.insert(texts.end(), arguments.begin(), arguments.end());
  std::vector<char*> argv;
  for (std::string& text : texts) argv.push_back(text.data());
  argv.push_back(nullptr);
  posix_spawn_file_actions_t quiet;
  posix_spawn_file_actions_init(&quiet);
  posix_spawn_file_actions_addopen(&quiet, STDOUT_FILENO, "/dev/null", O_WRONLY, 0);
  posix_spawn_file_actions_addopen(&quiet, STDERR_FILENO, errors.c_str(), O_WRONLY | O_CREAT | O_TRUNC, 0600);
  pid_t pid = -1;
  EXPECT_EQ(posix_spawn(&pid, PERFORA_PROGRAM, &quiet, nullptr, argv.data(), environ), 0);
  posix_spawn_file_actions_destroy(&quiet);
  return pid;
}

/// Exit code of a process once it has ended, minus the signal that ended it.
inline int finish(pid_t pid) {
  int status = 0;
  waitpid(pid, &status, 0);
  return WIFEXITED(status) ? WEXITSTATUS(status) : -WTERMSIG(status);
}

/// The same, without waiting; `running` while it has not ended.
constexpr int running = 1000;
inline int finished(pid_t pid) {
  int status = 0;
  if (waitpid(pid, &status, WNOHANG) != pid) return running;
  return WIFEXITED(status) ? WEXITSTATUS(status) : -WTERMSIG(status);
}

}  // namespace perfora
