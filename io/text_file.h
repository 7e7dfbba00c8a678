// What is here: reading a whole text file, and telling what a file is that is none.
// What is not: files of other kinds (files.h, hdf5.h), what a text means (toml.h, csv.h).
#pragma once

#include <cstddef>
#include <filesystem>
#include <string>
#include <string_view>

namespace perfora::io {

/// What a file is that begins so: "an HDF5 file", "a PNG picture", ..., "no UTF-8 text" where a NUL byte stands in it;
/// empty for text.
std::string not_text(std::string_view beginning);
/// Reads a whole text file. Throws InputError as read_file() does, and where the file is no text; `wanted` says there
/// what should be in its place: "a TOML file".
std::string read_text_file(const std::filesystem::path& path, std::size_t largest, const std::string& wanted);

}  // namespace perfora::io
