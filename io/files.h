// What is here: the steps of writing a file whole (temporary name, sync, rename), used inside io.
// What is not: the public file functions (journal.h).
#pragma once

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

}  // namespace perfora::io
