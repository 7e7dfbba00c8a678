// What is here: file descriptors that close themselves, and opening of regular files for reading without waiting.
// What is not: what is read from them (files.cpp, checksum_trailer.cpp).
#pragma once

#include <sys/stat.h>
#include <unistd.h>

#include <filesystem>
#include <string>
#include <utility>

namespace perfora::io {

/// A descriptor that closes itself; negative: none.
class Descriptor {
 public:
  explicit Descriptor(int descriptor) : descriptor_(descriptor) {}
  Descriptor(Descriptor&& other) noexcept : descriptor_(std::exchange(other.descriptor_, -1)) {}
  Descriptor& operator=(Descriptor&&) = delete;
  ~Descriptor() {
    if (descriptor_ >= 0) ::close(descriptor_);
  }
  int get() const { return descriptor_; }
  bool valid() const { return descriptor_ >= 0; }
  /// Closes now and says whether that went well: some file systems tell only then that the disk is full.
  bool close() { return ::close(std::exchange(descriptor_, -1)) == 0; }

 private:
  int descriptor_;
};

/// A file open for reading and what the system says of it.
struct OpenFile {
  Descriptor descriptor;
  struct stat status;
};

/// Opens a regular file. Throws InputError for what is not there, may not be read or is no regular file; a FIFO is not
/// waited for. `wanted` is said as what is allowed.
OpenFile open_regular(const std::filesystem::path& path, const std::string& wanted = {});

/// "a folder", "a FIFO", "a device", "a socket"; "" for a regular file.
std::string kind_of_file(mode_t mode);

/// Reads up to `size` bytes from where the descriptor stands; stops early only at the end of the file. Throws
/// InputError, which names `path`, when the disk fails.
std::size_t read_block(int descriptor, char* target, std::size_t size, const std::filesystem::path& path);

}  // namespace perfora::io
