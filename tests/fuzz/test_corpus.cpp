// What is here: the kept inputs of the fuzzers, each given to its target once, with any compiler.
// What is not: the search for new ones (README.md says how).
#include <gtest/gtest.h>

#include <filesystem>

#include "fuzz_targets.h"
#include "io/files.h"

namespace perfora::test {
namespace {

TEST(Corpus, EveryKeptInputIsAcceptedOrRefused) {
  const std::filesystem::path corpus = std::filesystem::path(PERFORA_SOURCE_DIR) / "tests/fuzz/corpus";
  for (const FuzzTarget& target : fuzz_targets()) {
    int inputs = 0;
    for (const auto& entry : std::filesystem::directory_iterator(corpus / target.name)) {
      SCOPED_TRACE(entry.path().string());
      feed(target, io::read_file(entry.path()));  // ends the program when it does what it may not
      ++inputs;
    }
    EXPECT_GT(inputs, 0) << target.name;
  }
}

}  // namespace
}  // namespace perfora::test
