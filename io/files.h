// What is here: whole files in and out, folders made, the rules for outputs that exist, CRC-32; the steps of writing a
// file whole. Everything the program writes goes through here or through the journal.
// What is not: the journal (journal.h), HDF5 (hdf5.h).
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <string>
#include <string_view>

#include "io/error.h"

namespace perfora::io {

/// Where a file called `path` is written: `path`, or, where that is a symbolic link, what the link names, whether that
/// is there yet or not. Throws InputError for links that lead in a circle.
std::filesystem::path output_target(const std::filesystem::path& path);
/// "<path>.tmp-<pid>-<host>": beside the file, so that the rename stays within one file system.
std::filesystem::path temporary_name(const std::filesystem::path& path);

/// Throws SurroundingsError: one sentence that names the file, the error of the system and what to do.
[[noreturn]] void fail_writing(const std::filesystem::path& path, int error);
/// fsync of a file or folder. Throws SurroundingsError.
void sync_path(const std::filesystem::path& path);
/// Writes everything or returns false with errno set.
bool write_all(int descriptor, std::string_view text);

/// Writes text whole: temporary name beside it, fsync, rename, fsync of the folder. Symbolic links are followed, other
/// than regular files are not replaced, and what killed processes left of earlier tries is removed. Throws
/// SurroundingsError; then nothing of the new file is left and an older one is as it was.
void write_file(const std::filesystem::path& path, std::string_view text);
/// The folder and those above it. Throws SurroundingsError.
void make_folders(const std::filesystem::path& folder);
/// Removes a file, where a symbolic link leads and not the link; nothing happens where there is none. Throws
/// SurroundingsError.
void remove_output(const std::filesystem::path& path);

/// Reads a whole file; throws InputError when it cannot, is no regular file or is larger than `largest` bytes.
std::string read_file(const std::filesystem::path& path, std::size_t largest = std::size_t{1} << 32);
/// The first bytes of a file, at most `size`; throws InputError as read_file does.
std::string read_beginning(const std::filesystem::path& path, std::size_t size);

/// Refuses a name that leaves no room for what is written beside it (R.xdmf.h5, R.part, temporary files). InputError.
void check_name_length(const std::filesystem::path& path);
/// Refuses an output that exists unless `force` or `resume`; InputError says which flags there are. Also refuses what
/// exists and is no regular file, a name that is too long, and a folder that is not writable. A folder that is missing
/// is made by the lock. Symbolic links are followed.
void check_output(const std::filesystem::path& path, bool force, bool resume);
/// Gives the finished file `temporary` the name `path` unless there is one: by a link, or by renaming where the disk
/// has no links. 0, EEXIST or another errno; `temporary` may be left.
int name_exclusively(const std::filesystem::path& temporary, const std::filesystem::path& path);
std::uint32_t crc32(std::string_view text);
/// Throws InputError where a key, set at `origin`, names a file or folder that does not exist.
void require_existing(const std::filesystem::path& path, const Origin& origin);
/// "crc32:01234567" of what a file holds. Throws InputError as read_file() does.
std::string content_checksum(const std::filesystem::path& path);
/// Goes on from the CRC-32 of what stands before `text`.
std::uint32_t crc32(std::string_view text, std::uint32_t before);

}  // namespace perfora::io
