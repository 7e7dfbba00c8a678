// What is here: whole files in and out, the rule for outputs that exist, CRC-32; the steps of writing a file whole.
// What is not: the journal (journal.h), HDF5 (hdf5.h).
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <string_view>

namespace perfora::io {

/// "<path>.tmp-<pid>": beside the file, so that the rename stays within one file system.
std::filesystem::path temporary_name(const std::filesystem::path& path);
/// fsync of a file or folder. Throws std::system_error.
void sync_path(const std::filesystem::path& path);
/// rename(2), then sync of the folder. Throws std::system_error.
void rename_into_place(const std::filesystem::path& temporary, const std::filesystem::path& path);
/// Writes everything or returns false with errno set.
bool write_all(int descriptor, std::string_view text);

/// Writes text whole: temporary name beside it, fsync, rename.
void write_file(const std::filesystem::path& path, std::string_view text);
/// Reads a whole file; throws InputError when it cannot or when it is larger than `largest` bytes.
std::string read_file(const std::filesystem::path& path, std::size_t largest = std::size_t{1} << 32);
/// Refuses an output that exists unless `force` or `resume`; InputError says which flags there are. Also refuses when
/// its folder is missing or not writable.
void check_output(const std::filesystem::path& path, bool force, bool resume);
std::uint32_t crc32(std::string_view text);

}  // namespace perfora::io
