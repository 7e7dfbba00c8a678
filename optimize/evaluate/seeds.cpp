// What is here: how the four random streams follow from one seed. What is not: the streams themselves (each room's own
// generator).
#include "optimize/evaluate/design.h"

namespace perfora::optimize {

namespace {

/// SplitMix64's output function (Steele, Lea, Flood, "Fast splittable pseudorandom number generators", OOPSLA 2014).
std::uint64_t splitmix64(std::uint64_t value) {
  value += 0x9E3779B97F4A7C15ULL;
  value = (value ^ (value >> 30)) * 0xBF58476D1CE4E5B9ULL;
  value = (value ^ (value >> 27)) * 0x94D049BB133111EBULL;
  return value ^ (value >> 31);
}

// Names of the streams as numbers: the first eight letters in ASCII.
constexpr std::uint64_t packing_stream = 0x7061636B696E6700ULL;  // "packing"
constexpr std::uint64_t noise_stream = 0x6E6F697365000000ULL;    // "noise"
constexpr std::uint64_t layout_stream = 0x6C61796F75740000ULL;   // "layout"
constexpr std::uint64_t search_stream = 0x7365617263680000ULL;   // "search"

/// Seeds are whole numbers in [1, Seeds::largest], so that they are valid as --packing-seed and the like.
std::uint64_t to_seed(std::uint64_t value) {
  value &= std::uint64_t{Seeds::largest};  // 53 bits, all set
  return value == 0 ? 1 : value;
}

std::uint64_t stream_seed(std::int64_t given, std::int64_t seed, std::uint64_t stream) {
  if (given > 0) return static_cast<std::uint64_t>(given);
  return to_seed(splitmix64(splitmix64(static_cast<std::uint64_t>(seed)) + stream));
}

std::uint64_t replicate_seed(std::uint64_t first, int replicate) {
  if (replicate == 0) return first;
  return to_seed(splitmix64(splitmix64(first) + static_cast<std::uint64_t>(replicate)));
}

}  // namespace

Seeds::Effective Seeds::effective(int replicate) const {
  Effective result;
  result.packing = replicate_seed(stream_seed(packing, seed, packing_stream), replicate);
  result.noise = replicate_seed(stream_seed(noise, seed, noise_stream), replicate);
  result.layout = stream_seed(layout, seed, layout_stream);
  result.search = stream_seed(search, seed, search_stream);
  return result;
}

}  // namespace perfora::optimize
