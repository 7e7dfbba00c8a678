// What is here: the last bytes of our HDF5 files, which prove what stands before them. Readers of HDF5 do not look
// there: it is behind the end that the file's own head names. docs/user/formats.md describes them.
// What is not: HDF5 (hdf5.h).
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <string_view>

namespace perfora::io {

/// 24 bytes: the mark "\x89PFCRC1\n", then in little-endian order the number of bytes before it (64 bits), their CRC-32
/// and the CRC-32 of the 20 bytes of the trailer so far.
std::string checksum_trailer(std::string_view content);

enum class Trailer { absent, fits, damaged };
/// Reads the file behind `descriptor`, of `size` bytes, to its end. Throws InputError when it cannot be read.
Trailer check_trailer(int descriptor, std::uint64_t size, const std::filesystem::path& path);

}  // namespace perfora::io
