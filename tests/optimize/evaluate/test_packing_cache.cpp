// What is here: packings kept in memory. Expected: counts of how often one is made.
#include "optimize/evaluate/packing_cache.h"

#include <gtest/gtest.h>

#include <atomic>
#include <thread>
#include <vector>

namespace perfora::optimize {
namespace {

geometry::PackingKey key_of(std::uint64_t seed) {
  geometry::PackingKey key;
  key.seed = seed;
  key.protocol = "dilate";
  return key;
}

geometry::Packing packing_of(std::size_t discs) {
  geometry::Packing packing;
  packing.x.assign(discs, 0.0);
  packing.y.assign(discs, 0.0);
  packing.radius.assign(discs, 1.0);
  return packing;
}

class PackingCache : public ::testing::Test {
 protected:
  void SetUp() override { clear_packing_cache(); }
  void TearDown() override { clear_packing_cache(); }
};

TEST_F(PackingCache, MakesEachKeyOnce) {
  int made = 0;
  const auto make = [&] {
    ++made;
    return packing_of(10);
  };
  const auto first = cached_packing(key_of(1), make);
  EXPECT_EQ(cached_packing(key_of(1), make), first);
  EXPECT_EQ(made, 1);
  cached_packing(key_of(2), make);
  EXPECT_EQ(made, 2);
}

TEST_F(PackingCache, ThreadsWaitForTheOneThatMakes) {
  std::atomic<int> made = 0;
  std::vector<std::thread> threads;
  for (int k = 0; k < 8; ++k)
    threads.emplace_back([&] {
      cached_packing(key_of(3), [&] {
        ++made;
        std::this_thread::sleep_for(std::chrono::milliseconds(20));
        return packing_of(5);
      });
    });
  for (auto& thread : threads) thread.join();
  EXPECT_EQ(made, 1);
}

TEST_F(PackingCache, AnExceptionLeavesNothingBehind) {
  EXPECT_THROW(cached_packing(key_of(4), []() -> geometry::Packing { throw std::runtime_error("no"); }),
               std::runtime_error);
  EXPECT_EQ(cached_packing(key_of(4), [] { return packing_of(7); })->size(), 7);
}

TEST_F(PackingCache, LetsTheOldestGo) {
  // Three of four million discs each are more than are kept; the one used last but one stays.
  constexpr std::size_t many = 4'000'000;
  const auto make = [] { return packing_of(many); };
  cached_packing(key_of(1), make);
  cached_packing(key_of(2), make);
  cached_packing(key_of(1), make);
  cached_packing(key_of(3), make);
  int made = 0;
  const auto again = [&] {
    ++made;
    return packing_of(1);
  };
  cached_packing(key_of(1), again);
  EXPECT_EQ(made, 0);
  cached_packing(key_of(2), again);
  EXPECT_EQ(made, 1);
}

}  // namespace
}  // namespace perfora::optimize
