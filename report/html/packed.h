// What is here: numbers as the report's page holds them: 16-bit integers, sorted by byte, zlib, base64. What is not:
// reading them (data.js), which numbers (run_part.h).
#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace perfora::report {

/// zlib, then base64 without line breaks. Throws std::runtime_error where zlib has no memory.
std::string packed(std::string_view bytes);
/// Base64 of RFC 4648 with padding.
std::string base64(std::string_view bytes);

/// Numbers on a ladder of 65,536 steps: value = offset + step x code.
struct Steps {
  double offset = 0.0, step = 0.0;
  std::vector<std::uint16_t> codes;
};
/// The ladder spans `low` to `high` (values outside stand at its ends), so a value is off by half a step at most: the
/// range over 131,070. `low` = `high`: the step is 0.
Steps in_steps(std::span<const double> values, double low, double high);

/// The codes' differences to those `width` places before (modulo 65,536; the first `width` as they are), all low bytes
/// and then all high bytes: what compresses well where frames follow each other.
std::string differences(std::span<const std::uint16_t> codes, std::size_t width);
/// The columns as 32-bit floats (little-endian), one after the other.
std::string floats(std::span<const std::vector<double>> columns);

}  // namespace perfora::report
