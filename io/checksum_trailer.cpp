// What is here: the trailer made and checked. What is not: what a reader does about one that does not fit.
#include "io/checksum_trailer.h"

#include <unistd.h>

#include <algorithm>

#include "io/descriptor.h"
#include "io/files.h"

namespace perfora::io {
namespace {

constexpr std::string_view magic = "\x89PFCRC1\n";
constexpr std::size_t trailer_size = 24, proved_size = 20;

void put(std::string& text, std::uint64_t value, int bytes) {
  for (int k = 0; k < bytes; ++k) text.push_back(static_cast<char>(value >> (8 * k) & 0xffU));
}

std::string trailer_of(std::uint64_t length, std::uint32_t sum) {
  std::string trailer(magic);
  put(trailer, length, 8);
  put(trailer, sum, 4);
  put(trailer, crc32(trailer), 4);
  return trailer;
}

}  // namespace

std::string checksum_trailer(std::string_view content) {
  return trailer_of(content.size(), crc32(content));
}

Trailer check_trailer(int descriptor, std::uint64_t size, const std::filesystem::path& path) {
  if (size < trailer_size) return Trailer::absent;
  const std::uint64_t length = size - trailer_size;
  std::string found(trailer_size, '\0');
  ::lseek(descriptor, static_cast<off_t>(length), SEEK_SET);
  found.resize(read_block(descriptor, found.data(), found.size(), path));
  const bool marked = found.starts_with(magic);
  std::string proof;
  put(proof, crc32(std::string_view(found).substr(0, std::min(found.size(), proved_size))), 4);
  if (!marked && !found.ends_with(proof)) return Trailer::absent;
  ::lseek(descriptor, 0, SEEK_SET);
  std::string block(std::size_t{1} << 20, '\0');
  std::uint32_t sum = 0;
  for (std::uint64_t at = 0; at < length;) {
    const std::size_t got = read_block(
        descriptor, block.data(), static_cast<std::size_t>(std::min<std::uint64_t>(block.size(), length - at)), path);
    if (got == 0) return Trailer::damaged;  // it became shorter meanwhile
    sum = crc32(std::string_view(block).substr(0, got), sum);
    at += got;
  }
  return found == trailer_of(length, sum) ? Trailer::fits : Trailer::damaged;
}

}  // namespace perfora::io
