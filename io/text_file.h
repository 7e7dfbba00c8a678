// What is here: reading a whole text file, and saying what a file is that is not text.
// What is not: files of other kinds (files.h, hdf5.h), what a text means (toml.h, csv.h).
#pragma once

#include <cstddef>
#include <filesystem>
#include <string>
#include <string_view>

namespace perfora::io {

/// Whether a file that begins so is one of HDF5; its first eight bytes tell.
bool is_hdf5(std::string_view beginning);
/// Reads a whole text file. Throws InputError as read_file() does, and where the file is not text; `wanted` says what
/// should be in its place: "a TOML file".
std::string read_text_file(const std::filesystem::path& path, std::size_t largest, const std::string& wanted);

}  // namespace perfora::io
