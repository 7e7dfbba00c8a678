// What is here: files that must not stay when this process ends early: a list that a signal handler may clear, and the
// temporaries that processes left which were killed. What is not: who writes such files (files.h, hdf5.h, lock.h).
#pragma once

#include <cstddef>
#include <filesystem>
#include <string>

namespace perfora::io {

/// While it lives, remove_litter() removes the file at its path. It removes nothing itself. Paths of 4096 bytes or
/// more, and more than 64 at once, are not kept: then a signal may leave the file.
class Litter {
 public:
  Litter() = default;
  explicit Litter(const std::filesystem::path& path);
  ~Litter();
  Litter(Litter&& other) noexcept;
  Litter& operator=(Litter&& other) noexcept;
  Litter(const Litter&) = delete;
  Litter& operator=(const Litter&) = delete;

 private:
  int slot_ = -1;
};

/// Removes every file that is registered now. Safe in a signal handler, which calls it before _exit(); nothing happens
/// in a child process made by fork().
void remove_litter() noexcept;

/// Removes the temporaries (files.h, temporary_name) of `folder` whose names begin with `start` and whose process, of this
/// host, has ended. Errors are passed over: what stays does no harm.
void remove_dead_temporaries(const std::filesystem::path& folder, const std::string& start = "") noexcept;

}  // namespace perfora::io
