// What is here: the lock on an output: one process at a time writes, replaces or removes it, on one host or on many.
// What is not: which outputs there are, what may be replaced (files.h).
#pragma once

#include <filesystem>
#include <memory>
#include <string>

namespace perfora::io {

/// Holds "NAME.lock" beside the output NAME (a file, or the journal of a folder) from its making to its end. Whoever
/// makes, replaces or removes an output holds its lock first, --force or not.
///
/// The lock is a file made by an exclusive link(2), which is atomic on network file systems, too; no flock is needed.
/// It says who holds it (JSON: host, boot, process space, process, when that began, since when, command), and its time
/// of change is renewed every ten seconds. A lock that stands already is
///  - taken over where its process has ended: it ran on this host, and no process of that number and start is left, or
///    the host was started anew since then and the lock shows no sign of life for a minute;
///  - respected otherwise. Of a process on another host nothing can be known for certain, so the user decides.
/// A folder that is missing is made, and goes again with the object where nothing was put into it.
/// The file goes with the object, and by remove_litter() (litter.h) where a signal handler ends the process.
class OutputLock {
 public:
  /// Holds nothing.
  OutputLock();
  /// Throws InputError when the output is in use (says by whom) or its folder cannot be written, SurroundingsError when
  /// the disk is full.
  explicit OutputLock(const std::filesystem::path& output);
  ~OutputLock();
  OutputLock(OutputLock&&) noexcept;
  OutputLock& operator=(OutputLock&&) noexcept;
  OutputLock(const OutputLock&) = delete;
  OutputLock& operator=(const OutputLock&) = delete;

 private:
  class Held;
  std::unique_ptr<Held> held_;
};

/// Takes an output that cannot be resumed: holds its lock. Throws InputError where it exists and `force` is not given,
/// where another process uses it, and where its folder is not writable.
[[nodiscard]] OutputLock claim_new_output(const std::filesystem::path& output, bool force);

/// "R.h5.lock", beside what the output is written to where that is a symbolic link (files.h).
std::filesystem::path lock_file(const std::filesystem::path& output);

}  // namespace perfora::io
