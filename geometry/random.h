// What is here: counter-based random numbers of this room: a number depends on (seed, stream, index) only, never on
// threads or call order. What is not: std:: distributions (their results differ between standard libraries).
#pragma once

#include <Random123/philox.h>

#include <array>
#include <cstdint>

namespace perfora::geometry {

/// Independent sequences drawn from one seed.
enum class RandomStream : std::uint32_t {
  disc_size = 1,
  disc_place,
  disc_order,
  hole_place,
  hole_jitter,
  hole_move,
  hole_size,
  hole_angle,
  row_shift
};

/// Two numbers, uniform in [0, 1) with 53 bits each: Philox4x32-10 (Salmon et al. 2011), key = seed, counter = (index,
/// stream, round).
inline std::array<double, 2> uniform_pair(std::uint64_t seed, RandomStream stream, std::uint64_t index,
                                          std::uint32_t round = 0) {
  const r123::Philox4x32::ctr_type counter{{static_cast<std::uint32_t>(index), static_cast<std::uint32_t>(index >> 32),
                                            static_cast<std::uint32_t>(stream), round}};
  const r123::Philox4x32::key_type key{{static_cast<std::uint32_t>(seed), static_cast<std::uint32_t>(seed >> 32)}};
  const r123::Philox4x32::ctr_type bits = r123::Philox4x32{}(counter, key);
  constexpr double two_to_minus_53 = 1.0 / 9007199254740992.0;
  const auto to_unit = [](std::uint32_t high, std::uint32_t low) {
    const std::uint64_t mantissa = (static_cast<std::uint64_t>(high) << 21) | (low >> 11);
    return static_cast<double>(mantissa) * two_to_minus_53;
  };
  return {to_unit(bits[0], bits[1]), to_unit(bits[2], bits[3])};
}

}  // namespace perfora::geometry
