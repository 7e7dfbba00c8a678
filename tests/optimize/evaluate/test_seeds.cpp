// What is here: the four streams and their replicates. Expected numbers: the documented hash written again here, held
// to published values of SplitMix64.
#include <gtest/gtest.h>

#include <set>

#include "optimize/evaluate/design.h"

namespace perfora::optimize {
namespace {

std::uint64_t splitmix64(std::uint64_t state) {
  std::uint64_t z = state + 0x9e3779b97f4a7c15ULL;
  z = (z ^ (z >> 30)) * 0xbf58476d1ce4e5b9ULL;
  z = (z ^ (z >> 27)) * 0x94d049bb133111ebULL;
  return z ^ (z >> 31);
}

constexpr std::uint64_t mask = (std::uint64_t{1} << 53) - 1;

std::uint64_t name_as_number(const char* name) {
  std::uint64_t number = 0;
  bool ended = false;
  for (int k = 0; k < 8; ++k) {
    ended = ended || name[k] == '\0';
    number = number << 8 | (ended ? 0u : static_cast<unsigned char>(name[k]));
  }
  return number;
}

TEST(SplitMix64, HasThePublishedOutputs) {
  // Outputs for state 1234567 (Rosetta Code, "Pseudo-random numbers/Splitmix64"), state advanced by the golden gamma.
  constexpr std::uint64_t gamma = 0x9e3779b97f4a7c15ULL;
  const std::uint64_t published[] = {6457827717110365317ULL, 3203168211198807973ULL, 9817491932198370423ULL,
                                     4593380528125082431ULL, 16408922859458223821ULL};
  std::uint64_t state = 1234567;
  for (const std::uint64_t value : published) {
    EXPECT_EQ(splitmix64(state), value);
    state += gamma;
  }
}

TEST(Seeds, FollowTheDocumentedHash) {
  for (const std::int64_t seed : {0, 1, 2, 77, 123456789}) {
    Seeds seeds;
    seeds.seed = seed;
    const std::uint64_t base = splitmix64(static_cast<std::uint64_t>(seed));
    const auto effective = seeds.effective(0);
    EXPECT_EQ(effective.packing, splitmix64(base + name_as_number("packing")) & mask);
    EXPECT_EQ(effective.noise, splitmix64(base + name_as_number("noise")) & mask);
    EXPECT_EQ(effective.layout, splitmix64(base + name_as_number("layout")) & mask);
    EXPECT_EQ(effective.search, splitmix64(base + name_as_number("search")) & mask);
  }
}

TEST(Seeds, ReplicatesChangePackingAndNoiseOnly) {
  const Seeds seeds;
  const auto first = seeds.effective(0);
  std::set<std::uint64_t> packings{first.packing}, noises{first.noise};
  for (int replicate = 1; replicate < 200; ++replicate) {
    const auto other = seeds.effective(replicate);
    EXPECT_EQ(other.layout, first.layout);
    EXPECT_EQ(other.search, first.search);
    EXPECT_EQ(other.packing, splitmix64(splitmix64(first.packing) + static_cast<std::uint64_t>(replicate)) & mask);
    packings.insert(other.packing);
    noises.insert(other.noise);
  }
  EXPECT_EQ(packings.size(), 200u);
  EXPECT_EQ(noises.size(), 200u);
}

TEST(Seeds, OneSetApartIsTakenAsItIs) {
  Seeds seeds;
  const auto derived = seeds.effective(0);
  seeds.packing = 77;
  const auto effective = seeds.effective(0);
  EXPECT_EQ(effective.packing, 77u);
  EXPECT_EQ(effective.noise, derived.noise);
  EXPECT_EQ(effective.layout, derived.layout);
  EXPECT_NE(seeds.effective(1).packing, 77u);
}

TEST(Seeds, ThoseAResultNamesGiveItAgain) {
  Seeds first;
  first.seed = 5;
  const auto named = first.effective(3);
  Seeds again;
  again.packing = static_cast<std::int64_t>(named.packing);
  again.noise = static_cast<std::int64_t>(named.noise);
  again.layout = static_cast<std::int64_t>(named.layout);
  again.search = static_cast<std::int64_t>(named.search);
  EXPECT_EQ(again.effective(0), named);
}

TEST(Seeds, StayWholeInJson) {
  for (std::int64_t seed = 0; seed < 2000; ++seed) {
    Seeds seeds;
    seeds.seed = seed;
    const auto effective = seeds.effective(static_cast<int>(seed % 5));
    for (const std::uint64_t value : {effective.packing, effective.noise, effective.layout, effective.search}) {
      EXPECT_GE(value, 1u);
      EXPECT_LE(value, mask);
      EXPECT_EQ(static_cast<std::uint64_t>(static_cast<double>(value)), value);
    }
  }
}

}  // namespace
}  // namespace perfora::optimize
