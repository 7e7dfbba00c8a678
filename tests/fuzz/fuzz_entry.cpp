// What is here: the entry of libFuzzer, compiled once for each target (FUZZ_TARGET is its name).
// What is not: the targets (fuzz_targets.cpp).
#include <algorithm>
#include <cstdint>

#include "fuzz_targets.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  static const auto target = *std::ranges::find_if(
      perfora::test::fuzz_targets(), [](const auto& one) { return std::string_view(one.name) == FUZZ_TARGET; });
  perfora::test::feed(target, {reinterpret_cast<const char*>(data), size});
  return 0;
}
