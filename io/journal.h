// What is here: the append-only journal (one line an event, checksum, fsync, torn last line dropped). What is not: what
// the events mean, whole files (files.h).
#pragma once

#include <cstddef>
#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

namespace perfora::io {

/// The events of a journal that somebody else may be writing; a torn last line is left out. Throws InputError when an
/// earlier line fails its checksum.
std::vector<std::string> read_journal(const std::filesystem::path& path);

/// Reads and appends DIR/journal.jsonl. Each line is `<crc32 of the text, 8 hex digits> <JSON text>`.
class Journal {
 public:
  /// Opens or creates the file; a torn last line is cut off. Whoever opens it holds its lock (lock.h).
  /// Throws InputError when an earlier line fails its checksum (names the line).
  explicit Journal(std::filesystem::path path);
  ~Journal();
  Journal(const Journal&) = delete;
  Journal& operator=(const Journal&) = delete;

  /// All events so far, oldest first (JSON texts).
  const std::vector<std::string>& events() const { return events_; }
  /// Appends one event (no newline inside) and returns after fsync.
  void append(std::string_view json);

 private:
  std::filesystem::path path_;
  std::vector<std::string> events_;
  std::size_t size_ = 0;  ///< bytes of whole lines
  int descriptor_ = -1;
};

}  // namespace perfora::io
