// What is here: a table of paths without locks for its reader, so that a signal handler can walk it. What is not: who
// registers paths.
#include "io/litter.h"

#include <signal.h>
#include <unistd.h>

#include <array>
#include <atomic>
#include <cerrno>
#include <cstdlib>
#include <cstring>
#include <utility>
#include <vector>

#include "io/files.h"

namespace perfora::io {
namespace {

constexpr std::size_t longest_path = 4096;
constexpr int slots = 64;

enum State : int { empty, being_written, set };

struct Slot {
  std::atomic<int> state{empty};
  pid_t owner = 0;  ///< a child made by fork() has a copy of the table and must not clean for its parent
  std::array<char, longest_path> path{};
};
static_assert(std::atomic<int>::is_always_lock_free, "a signal handler reads it");

std::array<Slot, slots>& table() {
  static std::array<Slot, slots> all;
  return all;
}

/// Made before any handler can run, so that the first use of the table is not in one.
const bool made = !table().empty();  // NOLINT(cert-err58-cpp): nothing in it throws

constexpr const char* temporary_mark = ".tmp-";

/// The process of this host that a temporary's name tells of; 0: it is none.
pid_t process_of(const std::string& name) {
  const std::string own = temporary_name("").string(), of_this_host = own.substr(own.rfind('-'));
  const auto at = name.rfind(temporary_mark);
  if (at == std::string::npos || !name.ends_with(of_this_host)) return 0;
  char* end = nullptr;
  const long pid = std::strtol(name.c_str() + at + std::strlen(temporary_mark), &end, 10);
  return pid > 0 && end == name.c_str() + name.size() - of_this_host.size() ? static_cast<pid_t>(pid) : 0;
}

}  // namespace

Litter::Litter(const std::filesystem::path& path) {
  // Absolute: the handler may run after the working folder has changed.
  std::error_code failed;
  const std::string name = std::filesystem::absolute(path, failed).string();
  if (failed || name.size() >= longest_path) return;
  for (int k = 0; k < slots; ++k) {
    Slot& slot = table()[static_cast<std::size_t>(k)];
    int expected = empty;
    if (!slot.state.compare_exchange_strong(expected, being_written)) continue;
    std::memcpy(slot.path.data(), name.c_str(), name.size() + 1);
    slot.owner = ::getpid();
    slot.state.store(set);
    slot_ = k;
    return;
  }
}

Litter::~Litter() {
  if (slot_ >= 0) table()[static_cast<std::size_t>(slot_)].state.store(empty);
}

Litter::Litter(Litter&& other) noexcept : slot_(std::exchange(other.slot_, -1)) {}

Litter& Litter::operator=(Litter&& other) noexcept {
  std::swap(slot_, other.slot_);
  return *this;
}

void remove_litter() noexcept {
  const int error = errno;
  for (Slot& slot : table())
    if (slot.state.load() == set && slot.owner == ::getpid()) ::unlink(slot.path.data());
  errno = error;
}

void remove_dead_temporaries(const std::filesystem::path& folder, const std::string& start) noexcept {
  try {
    std::error_code ignored;
    std::vector<std::filesystem::path> dead;
    for (const auto& entry :
         std::filesystem::directory_iterator(folder.empty() ? std::filesystem::path(".") : folder, ignored)) {
      const std::string name = entry.path().filename().string();
      const pid_t pid = process_of(name);
      if (pid > 0 && name.starts_with(start) && ::kill(pid, 0) != 0 && errno == ESRCH) dead.push_back(entry.path());
    }
    for (const auto& path : dead) std::filesystem::remove(path, ignored);
  } catch (const std::exception&) {  // What stays does no harm.
  }
}

}  // namespace perfora::io
