// What is here: lock files: made, renewed, judged, taken over, removed. What is not: who needs one.
#include "io/lock.h"

#include <fcntl.h>
#include <fmt/chrono.h>
#include <fmt/format.h>
#include <signal.h>
#include <sys/socket.h>
#include <sys/stat.h>
#include <sys/un.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <chrono>
#include <condition_variable>
#include <cstddef>
#include <cstdio>
#include <ctime>
#include <fstream>
#include <iterator>
#include <mutex>
#include <nlohmann/json.hpp>
#include <optional>
#include <set>
#include <sstream>
#include <thread>

#include "io/error.h"
#include "io/files.h"
#include "io/litter.h"

namespace perfora::io {
namespace {

namespace fs = std::filesystem;
using nlohmann::json;
using namespace std::chrono_literals;

constexpr auto renewal = 10s;
/// s without a renewal after which a lock of this host from before its last start belongs to nobody.
constexpr std::int64_t silence = 60;
constexpr std::size_t largest_lock = std::size_t{1} << 20;

std::string first_line(const fs::path& path) {
  std::ifstream file(path);
  std::string line;
  std::getline(file, line);
  return line;
}

/// What of /proc/PID/stat stands behind the name of the program, which may hold anything: state, parent, ...
std::vector<std::string> process_facts(pid_t pid) {
  const std::string line = first_line(fmt::format("/proc/{}/stat", pid));
  const auto name_end = line.rfind(')');
  if (name_end == std::string::npos) return {};
  std::istringstream rest(line.substr(name_end + 1));
  return {std::istream_iterator<std::string>(rest), {}};
}

constexpr std::size_t place_of_state = 0, place_of_start = 19;  // fields 3 and 22 of proc(5)

std::string start_of(pid_t pid) {
  const auto facts = process_facts(pid);
  return facts.size() > place_of_start ? facts[place_of_start] : std::string();
}

/// A process that was killed and not yet collected by its parent does nothing any more, once its last thread is gone.
bool has_ended(pid_t pid, const std::string& start) {
  const auto facts = process_facts(pid);
  // The facts of other users may be hidden; that there is such a process is not.
  if (facts.size() <= place_of_start) return ::kill(pid, 0) != 0 && errno == ESRCH;
  if (facts[place_of_start] != start) return true;
  if (facts[place_of_state] != "Z" && facts[place_of_state] != "X") return false;
  std::error_code ignored;
  return std::distance(fs::directory_iterator(fmt::format("/proc/{}/task", pid), ignored), {}) <= 1;
}

std::string host_name() {
  char name[256] = "";
  ::gethostname(name, sizeof name - 1);
  return name;
}

/// Numbers of processes mean the same to all who share it.
std::string process_space() {
  std::error_code ignored;
  return fs::read_symlink("/proc/self/ns/pid", ignored).string();
}

std::string own_command() {
  std::ifstream file("/proc/self/cmdline");
  std::string text{std::istreambuf_iterator<char>(file), {}};
  while (!text.empty() && text.back() == '\0') text.pop_back();
  for (char& c : text)
    if (c == '\0') c = ' ';
  return text;
}

json own_record() {
  const std::time_t now = std::time(nullptr);
  return {{"host", host_name()},           {"boot", first_line("/proc/sys/kernel/random/boot_id")},
          {"space", process_space()},      {"process", ::getpid()},
          {"start", start_of(::getpid())}, {"since", static_cast<std::int64_t>(now)},
          {"command", own_command()}};
}

/// A lock file as it is found.
struct Found {
  json record;
  std::int64_t age = 0;  ///< s since it was renewed, by the clock of its file system
};

std::int64_t age_of(const struct stat& lock, std::time_t now) {
  return std::max<std::int64_t>(0, static_cast<std::int64_t>(now) - lock.st_mtime);
}

/// nothing: there is none any more. `now`: by the clock of the file system.
std::optional<Found> found_at(const fs::path& path, std::time_t now) {
  struct stat status {};
  if (::lstat(path.c_str(), &status) != 0) return std::nullopt;
  Found found;
  found.age = age_of(status, now);
  try {
    found.record = json::parse(read_file(path, largest_lock), nullptr, false);
  } catch (const InputError&) {  // It went in between, or is no file.
    if (::lstat(path.c_str(), &status) != 0) return std::nullopt;
  }
  return found;
}

template <class T>
T field(const json& record, const char* name, T otherwise) {
  try {
    return record.is_object() ? record.value(name, otherwise) : otherwise;
  } catch (const json::exception&) {
    return otherwise;
  }
}

bool is_nobodys(const Found& found) {
  static const json here = own_record();
  const json& there = found.record;
  if (!there.is_object() || there.value("host", json()) != here.at("host")) return false;
  if (there.value("boot", json()) != here.at("boot")) return found.age > silence;
  if (there.value("space", json()) != here.at("space")) return false;
  const int process = field(there, "process", 0);
  return process > 0 && has_ended(process, field<std::string>(there, "start", ""));
}

[[noreturn]] void refuse(const fs::path& output, const fs::path& lock, const Found& found) {
  const std::string host = field<std::string>(found.record, "host", "");
  const auto since = static_cast<std::time_t>(field<std::int64_t>(found.record, "since", 0));
  if (host.empty())
    throw InputError({output.string(), 0, ""}, "is in use: " + lock.string() + " stands beside it and cannot be read",
                     "", "remove that file if no process writes this output");
  const bool here = host == host_name();
  throw InputError({output.string(), 0, ""},
                   fmt::format("is in use by process {} on host {} since {:%H:%M} (`{}`), last sign of life {} s ago",
                               field(found.record, "process", 0), host, fmt::localtime(since),
                               field<std::string>(found.record, "command", "?"), found.age),
                   "",
                   here
                       ? "wait for it to end, stop it, or name another output with -o"
                       : fmt::format("wait for it to end, or remove {} if that process no longer runs", lock.string()));
}

[[noreturn]] void refuse_write(const fs::path& output, int error) {
  if (error == ENOSPC || error == EDQUOT || error == EIO || error == ENOMEM || error == ENFILE || error == EMFILE)
    fail_writing(lock_file(output), error);
  throw InputError({output.string(), 0, ""}, "cannot be locked: " + std::generic_category().message(error), "",
                   "name an output in a folder that can be written");
}

/// One process of this host at a time judges locks and removes those of the dead. A name in the kernel's own space of
/// addresses goes with its process and needs nothing of the file system.
class Judge {
 public:
  explicit Judge(const fs::path& lock) : socket_(::socket(AF_UNIX, SOCK_STREAM | SOCK_CLOEXEC, 0)) {
    const fs::path folder = lock.parent_path();
    struct stat status {};
    ::stat(folder.empty() ? "." : folder.c_str(), &status);
    const std::string name =
        fmt::format("perfora-lock-{:x}-{:x}-{:08x}", status.st_dev, status.st_ino, crc32(lock.filename().string()));
    sockaddr_un address{};
    address.sun_family = AF_UNIX;
    name.copy(address.sun_path + 1, sizeof address.sun_path - 1);  // A leading zero: no file.
    const auto size = static_cast<socklen_t>(offsetof(sockaddr_un, sun_path) + 1 + name.size());
    for (int k = 0; k < 2000; ++k) {
      if (::bind(socket_, reinterpret_cast<const sockaddr*>(&address), size) == 0) return;
      if (errno != EADDRINUSE) break;
      std::this_thread::sleep_for(1ms);
    }
    const int error = errno;
    ::close(socket_);
    throw SurroundingsError(fmt::format("{}: whose lock this is cannot be judged: {}; try again", lock.string(),
                                        std::generic_category().message(error)));
  }
  ~Judge() { ::close(socket_); }
  Judge(const Judge&) = delete;
  Judge& operator=(const Judge&) = delete;

 private:
  int socket_;
};

/// Renews the locks of this process from a thread that lives as long as there are any.
class Renewal {
 public:
  static Renewal& instance() {
    static auto* one = new Renewal;  // never destroyed: locks may be held until the very end
    return *one;
  }

  void add(const fs::path& lock) {
    const std::lock_guard guard(mutex_);
    locks_.insert(lock);
    if (thread_.joinable()) return;
    sigset_t all, before;  // Signals are the business of other threads.
    sigfillset(&all);
    ::pthread_sigmask(SIG_SETMASK, &all, &before);
    try {
      thread_ = std::thread([this] { work(); });
    } catch (const std::system_error&) {  // Without threads to spare the lock holds, it only shows no sign of life.
    }
    ::pthread_sigmask(SIG_SETMASK, &before, nullptr);
  }

  void remove(const fs::path& lock) {
    std::thread last;
    {
      const std::lock_guard guard(mutex_);
      locks_.erase(lock);
      if (!locks_.empty()) return;
      last.swap(thread_);
      changed_.notify_all();
    }
    if (last.joinable()) last.join();
  }

 private:
  void work() {
    std::unique_lock guard(mutex_);
    while (!changed_.wait_for(guard, renewal, [this] { return locks_.empty(); }))
      for (const fs::path& lock : locks_) ::utimensat(AT_FDCWD, lock.c_str(), nullptr, 0);
  }

  std::mutex mutex_;
  std::condition_variable changed_;
  std::set<fs::path> locks_;
  std::thread thread_;
};

}  // namespace

fs::path lock_file(const fs::path& output) {
  fs::path lock = output_target(output);
  lock += ".lock";
  return lock;
}

class OutputLock::Held {
 public:
  explicit Held(const fs::path& output) : path_(fs::absolute(lock_file(output))), folders_(path_.parent_path()) {
    while (!link_own(output)) {
      const std::optional<Found> there = found_at(path_, now_);
      if (!there) continue;
      if (!is_nobodys(*there)) refuse(output, path_, *there);
      const Judge judge(path_);
      const std::optional<Found> still = found_at(path_, now_);
      if (still && is_nobodys(*still)) ::unlink(path_.c_str());
    }
    litter_ = Litter(path_);
    // What a killed writer of this output left: "R.h5.tmp-123", "R.csv.tmp-123".
    remove_dead_temporaries(path_.parent_path(), output.stem().string() + ".");
    Renewal::instance().add(path_);
  }

  ~Held() {
    Renewal::instance().remove(path_);
    struct stat status {};
    // The user may have removed it, and another process may hold one in its place.
    if (::lstat(path_.c_str(), &status) == 0 && status.st_ino == inode_ && status.st_dev == device_)
      ::unlink(path_.c_str());
  }
  Held(const Held&) = delete;
  Held& operator=(const Held&) = delete;

 private:
  /// A folder and those above it, made where they are missing; the ones that are empty at the end are removed.
  class MadeFolders {
   public:
    /// Throws SurroundingsError.
    explicit MadeFolders(const fs::path& folder) {
      std::error_code ignored;
      for (fs::path one = folder; !one.empty() && !fs::exists(one, ignored); one = one.parent_path())
        made_.push_back(one);
      if (!made_.empty()) make_folders(folder);
    }
    ~MadeFolders() {
      for (const fs::path& one : made_)
        if (::rmdir(one.c_str()) != 0) break;
    }
    MadeFolders(const MadeFolders&) = delete;
    MadeFolders& operator=(const MadeFolders&) = delete;

   private:
    std::vector<fs::path> made_;  ///< the innermost first
  };

  /// True: the lock is ours.
  bool link_own(const fs::path& output) {
    const fs::path temporary = temporary_name(path_);
    const Litter litter(temporary);
    const int file = ::open(temporary.c_str(), O_WRONLY | O_CREAT | O_TRUNC | O_CLOEXEC | O_NOFOLLOW, 0666);
    if (file < 0) refuse_write(output, errno);
    bool ok = write_all(file, own_record().dump() + "\n") && ::fsync(file) == 0;
    int error = errno;
    if (ok) {
      error = name_exclusively(temporary, path_);
      struct stat status {};
      ok = ::fstat(file, &status) == 0 && error == 0;
      inode_ = status.st_ino;
      device_ = status.st_dev;
      now_ = status.st_mtime;
    }
    ::close(file);
    ::unlink(temporary.c_str());
    if (!ok && error != EEXIST) refuse_write(output, error);
    return ok;
  }

  fs::path path_;
  MadeFolders folders_;  ///< outlives the lock file
  Litter litter_;
  ino_t inode_ = 0;
  dev_t device_ = 0;
  std::time_t now_ = 0;  ///< when the temporary was written, by the clock of the file system
};

OutputLock::OutputLock() = default;
OutputLock::OutputLock(const fs::path& output) : held_(std::make_unique<Held>(output)) {}
OutputLock::~OutputLock() = default;
OutputLock::OutputLock(OutputLock&&) noexcept = default;
OutputLock& OutputLock::operator=(OutputLock&&) noexcept = default;

}  // namespace perfora::io
