// What is here: whole files in and out, CRC-32.
// What is not: which outputs may be written (output_rules.cpp), the journal (journal.cpp), HDF5 (hdf5_*.cpp).
#include "io/files.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/stat.h>
#include <unistd.h>
#include <zlib.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <climits>
#include <cstdio>
#include <system_error>

#include "io/descriptor.h"
#include "io/error.h"
#include "io/litter.h"

namespace perfora::io {
namespace {

std::filesystem::path folder_of(const std::filesystem::path& path) {
  const std::filesystem::path folder = path.parent_path();
  return folder.empty() ? std::filesystem::path(".") : folder;
}

/// Four digits for this host: a process id means nothing on another one, and folders may be shared.
const std::string& host_tag() {
  static const std::string tag = [] {
    std::array<char, HOST_NAME_MAX + 1> name{};
    ::gethostname(name.data(), name.size() - 1);
    return fmt::format("{:04x}", crc32(name.data()) & 0xffffU);
  }();
  return tag;
}

/// Some file systems sync neither files nor folders (EINVAL, ENOTSUP); nothing more can be done there.
bool synced(int descriptor) {
  return ::fsync(descriptor) == 0 || errno == EINVAL || errno == ENOTSUP;
}

void write_whole(const std::filesystem::path& temporary, std::string_view text) {
  Descriptor file(::open(temporary.c_str(), O_WRONLY | O_CREAT | O_TRUNC | O_CLOEXEC | O_NOFOLLOW, 0666));
  if (!file.valid() || !write_all(file.get(), text) || !synced(file.get()) || !file.close())
    throw std::system_error(errno, std::generic_category());
}

}  // namespace

std::filesystem::path temporary_name(const std::filesystem::path& path) {
  std::filesystem::path temporary = path;
  temporary += fmt::format(".tmp-{}-{}", ::getpid(), host_tag());
  return temporary;
}

void fail_writing(const std::filesystem::path& path, int error) {
  const char* again = "run the command again (with --resume where it has that)";
  const std::string problem = path.string() + " cannot be written: " + std::generic_category().message(error);
  if (error == ENOSPC || error == EDQUOT)
    throw SurroundingsError(fmt::format("{} (the disk or a quota is full); make room and {}", problem, again));
  if (error == EFBIG)
    throw SurroundingsError(
        fmt::format("{} (a limit on the size of files is reached, see `ulimit -f`); raise it and {}", problem, again));
  throw SurroundingsError(fmt::format("{}; check the disk and the folder, and {}", problem, again));
}

void sync_path(const std::filesystem::path& path) {
  const Descriptor file(::open(path.c_str(), O_RDONLY | O_CLOEXEC));
  if (!file.valid() && errno == EACCES) return;  // a folder may be written to and not be read
  if (!file.valid() || !synced(file.get())) fail_writing(path, errno);
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
  const std::filesystem::path target = output_target(path);
  struct stat status {};
  if (::lstat(target.c_str(), &status) == 0)
    if (const std::string kind = kind_of_file(status.st_mode); !kind.empty())
      throw SurroundingsError(
          fmt::format("{} cannot be written: it became {}; remove it or name another output", path.string(), kind));
  remove_dead_temporaries(folder_of(target), target.filename().string() + ".tmp-");
  const std::filesystem::path temporary = temporary_name(target);
  const Litter litter(temporary);
  try {
    write_whole(temporary, text);
    if (::rename(temporary.c_str(), target.c_str()) != 0) throw std::system_error(errno, std::generic_category());
  } catch (const std::system_error& failure) {
    ::unlink(temporary.c_str());
    fail_writing(path, failure.code().value());
  }
  sync_path(folder_of(target));
}

void make_folders(const std::filesystem::path& folder) {
  std::error_code error;
  std::filesystem::create_directories(folder, error);
  if (error) fail_writing(folder, error.value());
}

void remove_output(const std::filesystem::path& path) {
  if (::unlink(output_target(path).c_str()) != 0 && errno != ENOENT) fail_writing(path, errno);
}

std::string kind_of_file(mode_t mode) {
  if (S_ISREG(mode)) return "";
  if (S_ISDIR(mode)) return "a folder";
  if (S_ISFIFO(mode)) return "a FIFO";
  if (S_ISSOCK(mode)) return "a socket";
  return S_ISLNK(mode) ? "a symbolic link" : "a device";
}

OpenFile open_regular(const std::filesystem::path& path, const std::string& wanted) {
  const Origin origin{path.string(), 0, ""};
  // Without O_NONBLOCK the opening of a FIFO would wait for somebody who writes to it.
  OpenFile file{Descriptor(::open(path.c_str(), O_RDONLY | O_CLOEXEC | O_NONBLOCK | O_NOCTTY)), {}};
  if (!file.descriptor.valid() && errno == ENOENT) throw InputError(origin, "does not exist", wanted, "check the path");
  if (!file.descriptor.valid() && errno == EACCES)
    throw InputError(origin, "may not be read", wanted, "check its permissions");
  if (!file.descriptor.valid() && errno == ENXIO)
    throw InputError(origin, "is a socket", wanted.empty() ? "a file is wanted" : wanted, "check the path");
  if (!file.descriptor.valid() || ::fstat(file.descriptor.get(), &file.status) != 0)
    throw InputError(origin, "cannot be opened: " + std::generic_category().message(errno), "", "check the path");
  if (const std::string kind = kind_of_file(file.status.st_mode); !kind.empty())
    throw InputError(origin, "is " + kind, wanted.empty() ? "a file is wanted" : wanted, "check the path");
  return file;
}

std::size_t read_block(int descriptor, char* target, std::size_t size, const std::filesystem::path& path) {
  std::size_t filled = 0;
  while (filled < size) {
    const ssize_t got = ::read(descriptor, target + filled, size - filled);
    if (got < 0 && errno == EINTR) continue;
    if (got < 0)
      throw InputError({path.string(), 0, ""}, "cannot be read: " + std::generic_category().message(errno), "",
                       "check the disk");
    if (got == 0) break;
    filled += static_cast<std::size_t>(got);
  }
  return filled;
}

std::string read_file(const std::filesystem::path& path, std::size_t largest) {
  const OpenFile file = open_regular(path);
  constexpr std::size_t block = std::size_t{1} << 16;
  std::string text;
  for (;;) {
    const std::size_t filled = text.size();
    text.resize(filled + block);
    const std::size_t got = read_block(file.descriptor.get(), text.data() + filled, block, path);
    text.resize(filled + got);
    if (text.size() > largest)
      throw InputError({path.string(), 0, ""}, "is larger than " + std::to_string(largest >> 20) + " MB", "",
                       "check that it is the right file");
    if (got < block) return text;
  }
}

std::string read_beginning(const std::filesystem::path& path, std::size_t size) {
  const OpenFile file = open_regular(path);
  std::string start(size, '\0');
  start.resize(read_block(file.descriptor.get(), start.data(), size, path));
  return start;
}

int name_exclusively(const std::filesystem::path& temporary, const std::filesystem::path& path) {
  if (::link(temporary.c_str(), path.c_str()) == 0) return 0;
  const int error = errno;
  if (error == EPERM || error == EOPNOTSUPP || error == ENOSYS) {  // no links: FAT, some others
    const int made = ::renameat2(AT_FDCWD, temporary.c_str(), AT_FDCWD, path.c_str(), RENAME_NOREPLACE);
    return made == 0 ? 0 : errno;
  }
  // Over a network link() may report a failure of what succeeded; the count of names tells.
  struct stat status {};
  return ::lstat(temporary.c_str(), &status) == 0 && status.st_nlink == 2 ? 0 : error;
}

std::uint32_t crc32(std::string_view text) {
  return crc32(text, 0);
}

void require_existing(const std::filesystem::path& path, const Origin& origin) {
  std::error_code hidden;  // what may not be looked at is told by whoever reads it
  if (path.empty() || std::filesystem::status(path, hidden).type() != std::filesystem::file_type::not_found) return;
  throw InputError(origin, path.string() + " does not exist", "",
                   "correct the path; a relative one begins at the folder of the file that names it");
}

std::string content_checksum(const std::filesystem::path& path) {
  return fmt::format("crc32:{:08x}", crc32(read_file(path)));
}

std::uint32_t crc32(std::string_view text, std::uint32_t before) {
  return static_cast<std::uint32_t>(::crc32_z(before, reinterpret_cast<const Bytef*>(text.data()), text.size()));
}

}  // namespace perfora::io
