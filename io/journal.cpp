// What is here: the append-only journal. What is not: what its events mean, files written whole (files.cpp).
#include "io/journal.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <unistd.h>

#include <cerrno>
#include <stdexcept>
#include <system_error>

#include "io/error.h"
#include "io/files.h"

namespace perfora::io {
namespace {

constexpr std::size_t checksum_digits = 8;

std::string journal_line(std::string_view json) {
  return fmt::format("{:08x} {}\n", crc32(json), json);
}

bool is_whole(std::string_view line) {
  if (line.size() <= checksum_digits || line[checksum_digits] != ' ') return false;
  return line.substr(0, checksum_digits) == fmt::format("{:08x}", crc32(line.substr(checksum_digits + 1)));
}

/// Appends the events of `text` to `events`; returns the length of the part that is whole.
std::size_t read_events(std::string_view text, const std::string& file, std::vector<std::string>& events) {
  std::size_t start = 0;
  for (int number = 1; start < text.size(); ++number) {
    const std::size_t end = text.find('\n', start);
    const bool last = end == std::string_view::npos || end + 1 == text.size();
    const std::string_view line = text.substr(start, end == std::string_view::npos ? end : end - start);
    if (end == std::string_view::npos || !is_whole(line)) {
      if (last) return start;
      throw InputError({file, number, ""}, "this line of the journal is damaged (its checksum does not fit)", "",
                       "restore the file from a copy, or delete this line and all after it to go on from there");
    }
    events.emplace_back(line.substr(checksum_digits + 1));
    start = end + 1;
  }
  return start;
}

int open_to_append(const std::filesystem::path& path) {
  const int descriptor = ::open(path.c_str(), O_RDWR | O_CREAT | O_APPEND | O_CLOEXEC, 0666);
  if (descriptor < 0 && (errno == ENOSPC || errno == EDQUOT || errno == EIO)) fail_writing(path, errno);
  if (descriptor < 0)
    throw InputError({path.string(), 0, ""}, "cannot be opened: " + std::generic_category().message(errno), "",
                     "check that its folder exists and is writable");
  return descriptor;
}

}  // namespace

std::vector<std::string> read_journal(const std::filesystem::path& path) {
  std::vector<std::string> events;
  read_events(read_file(path), path.string(), events);
  return events;
}

Journal::Journal(std::filesystem::path path) : path_(std::move(path)), descriptor_(open_to_append(path_)) {
  try {
    const std::string text = read_file(path_);
    size_ = read_events(text, path_.string(), events_);
    if (size_ < text.size() && (::ftruncate(descriptor_, static_cast<off_t>(size_)) != 0 || ::fsync(descriptor_) != 0))
      fail_writing(path_, errno);
    const std::filesystem::path folder = path_.parent_path();
    sync_path(folder.empty() ? "." : folder);
  } catch (...) {
    ::close(descriptor_);
    throw;
  }
}

Journal::~Journal() {
  ::close(descriptor_);
}

void Journal::append(std::string_view json) {
  if (json.find('\n') != std::string_view::npos) throw std::logic_error("a journal event holds a line break");
  const std::string line = journal_line(json);
  if (!write_all(descriptor_, line) || ::fsync(descriptor_) != 0) {
    const int error = errno;
    // What was written in part must not stand before the next event; if this fails too, the next opening cuts it.
    static_cast<void>(!::ftruncate(descriptor_, static_cast<off_t>(size_)));
    fail_writing(path_, error);
  }
  size_ += line.size();
  events_.emplace_back(json);
}

}  // namespace perfora::io
