// What is here: whole files in and out, the rule for outputs that exist, CRC-32.
// What is not: the journal (journal.cpp), HDF5 (hdf5_*.cpp).
#include "io/files.h"

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>
#include <zlib.h>

#include <algorithm>
#include <cerrno>
#include <system_error>

#include "io/error.h"

namespace perfora::io {
namespace {

[[noreturn]] void fail(const std::filesystem::path& path, const char* what) {
  throw std::system_error(errno, std::generic_category(), path.string() + ": " + what);
}

/// A descriptor that closes itself.
class Descriptor {
 public:
  explicit Descriptor(int descriptor) : descriptor_(descriptor) {}
  ~Descriptor() {
    if (descriptor_ >= 0) ::close(descriptor_);
  }
  Descriptor(const Descriptor&) = delete;
  Descriptor& operator=(const Descriptor&) = delete;
  int get() const { return descriptor_; }
  bool valid() const { return descriptor_ >= 0; }

 private:
  int descriptor_;
};

std::filesystem::path folder_of(const std::filesystem::path& path) {
  const std::filesystem::path folder = path.parent_path();
  return folder.empty() ? std::filesystem::path(".") : folder;
}

}  // namespace

std::filesystem::path temporary_name(const std::filesystem::path& path) {
  std::filesystem::path temporary = path;
  temporary += ".tmp-" + std::to_string(::getpid());
  return temporary;
}

void sync_path(const std::filesystem::path& path) {
  const Descriptor file(::open(path.c_str(), O_RDONLY | O_CLOEXEC));
  // Some file systems cannot sync a folder (EINVAL); nothing more can be done there.
  if (!file.valid() || (::fsync(file.get()) != 0 && errno != EINVAL)) fail(path, "cannot be synced to disk");
}

void rename_into_place(const std::filesystem::path& temporary, const std::filesystem::path& path) {
  if (::rename(temporary.c_str(), path.c_str()) != 0) fail(path, "cannot be renamed into place");
  sync_path(folder_of(path));
}

bool write_all(int descriptor, std::string_view text) {
  while (!text.empty()) {
    const ssize_t written = ::write(descriptor, text.data(), text.size());
    if (written < 0 && errno == EINTR) continue;
    if (written < 0) return false;
    text.remove_prefix(static_cast<std::size_t>(written));
  }
  return true;
}

void write_file(const std::filesystem::path& path, std::string_view text) {
  const std::filesystem::path temporary = temporary_name(path);
  try {
    const Descriptor file(::open(temporary.c_str(), O_WRONLY | O_CREAT | O_TRUNC | O_CLOEXEC, 0666));
    if (!file.valid()) fail(path, "cannot be written");
    if (!write_all(file.get(), text) || ::fsync(file.get()) != 0) fail(path, "cannot be written");
    rename_into_place(temporary, path);
  } catch (...) {
    ::unlink(temporary.c_str());
    throw;
  }
}

std::string read_file(const std::filesystem::path& path, std::size_t largest) {
  const Origin origin{path.string(), 0, ""};
  const Descriptor file(::open(path.c_str(), O_RDONLY | O_CLOEXEC));
  struct stat status {};
  if (!file.valid() && errno == ENOENT) throw InputError(origin, "does not exist", "", "check the path");
  if (!file.valid() && errno == EACCES) throw InputError(origin, "may not be read", "", "check its permissions");
  if (!file.valid() || ::fstat(file.get(), &status) != 0)
    throw InputError(origin, "cannot be opened: " + std::generic_category().message(errno), "", "check the path");
  if (S_ISDIR(status.st_mode)) throw InputError(origin, "is a folder", "a file is wanted", "check the path");
  constexpr std::size_t block = std::size_t{1} << 16;
  std::string text;
  for (;;) {
    const std::size_t filled = text.size();
    text.resize(filled + block);
    const ssize_t got = ::read(file.get(), text.data() + filled, block);
    text.resize(filled + static_cast<std::size_t>(std::max<ssize_t>(got, 0)));
    if (got < 0 && errno == EINTR) continue;
    if (got < 0)
      throw InputError(origin, "cannot be read: " + std::generic_category().message(errno), "", "check the disk");
    if (text.size() > largest)
      throw InputError(origin, "is larger than " + std::to_string(largest >> 20) + " MB", "",
                       "check that it is the right file");
    if (got == 0) return text;
  }
}

void check_output(const std::filesystem::path& path, bool force, bool resume) {
  const Origin origin{path.string(), 0, ""};
  if (path.empty()) throw InputError(origin, "the output has no name", "", "give one with -o");
  std::error_code ignored;
  const std::filesystem::path folder = folder_of(path.has_filename() ? path : path.parent_path());
  if (!std::filesystem::is_directory(folder, ignored))
    throw InputError(origin, "its folder " + folder.string() + " does not exist", "",
                     "make the folder or choose another output");
  if (::access(folder.c_str(), W_OK | X_OK) != 0)
    throw InputError(origin, "its folder " + folder.string() + " is not writable", "", "choose another output");
  if (!force && !resume && std::filesystem::exists(std::filesystem::symlink_status(path, ignored)))
    throw InputError(origin, "already exists", "", "choose another output, --force to replace it or --resume to go on");
}

std::uint32_t crc32(std::string_view text) {
  uLong sum = ::crc32_z(0, nullptr, 0);
  sum = ::crc32_z(sum, reinterpret_cast<const Bytef*>(text.data()), text.size());
  return static_cast<std::uint32_t>(sum);
}

}  // namespace perfora::io
