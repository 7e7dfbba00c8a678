// What is here: compression and encodings of the report's numbers. What is not: what they mean.
#include "report/html/packed.h"

#include <zlib.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstring>
#include <stdexcept>

namespace perfora::report {

static_assert(std::endian::native == std::endian::little, "the page reads little-endian numbers");

std::string base64(std::string_view bytes) {
  static constexpr char letters[] = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  std::string text;
  text.reserve((bytes.size() + 2) / 3 * 4);
  for (std::size_t at = 0; at < bytes.size(); at += 3) {
    const std::size_t count = std::min<std::size_t>(3, bytes.size() - at);
    std::uint32_t three = 0;
    for (std::size_t k = 0; k < 3; ++k)
      three = (three << 8) | (k < count ? static_cast<std::uint8_t>(bytes[at + k]) : 0u);
    for (std::size_t k = 0; k < 4; ++k) text += k <= count ? letters[(three >> (18 - 6 * k)) & 63u] : '=';
  }
  return text;
}

std::string packed(std::string_view bytes) {
  uLongf length = compressBound(static_cast<uLong>(bytes.size()));
  std::string result(length, '\0');
  const int code = compress2(reinterpret_cast<Bytef*>(result.data()), &length,
                             reinterpret_cast<const Bytef*>(bytes.data()), static_cast<uLong>(bytes.size()), 6);
  if (code != Z_OK) throw std::runtime_error("zlib could not compress the report's numbers");
  result.resize(length);
  return base64(result);
}

Steps in_steps(std::span<const double> values, double low, double high) {
  constexpr double most = 65535.0;
  Steps steps{low, (high - low) / most, {}};
  steps.codes.reserve(values.size());
  for (const double value : values) {
    const double code = steps.step > 0.0 ? std::round((value - low) / steps.step) : 0.0;
    steps.codes.push_back(static_cast<std::uint16_t>(std::clamp(std::isnan(code) ? 0.0 : code, 0.0, most)));
  }
  return steps;
}

std::string differences(std::span<const std::uint16_t> codes, std::size_t width) {
  const std::size_t count = codes.size();
  std::string bytes(2 * count, '\0');
  for (std::size_t k = 0; k < count; ++k) {
    const auto before = k >= width ? codes[k - width] : std::uint16_t{0};
    const auto difference = static_cast<std::uint16_t>(codes[k] - before);
    bytes[k] = static_cast<char>(difference & 0xffu);
    bytes[count + k] = static_cast<char>(difference >> 8);
  }
  return bytes;
}

std::string floats(std::span<const std::vector<double>> columns) {
  std::string bytes;
  for (const std::vector<double>& column : columns)
    for (const double value : column) {
      const auto single = static_cast<float>(value);
      char four[sizeof single];
      std::memcpy(four, &single, sizeof single);
      bytes.append(four, sizeof single);
    }
  return bytes;
}

}  // namespace perfora::report
