// What is here: the kept inputs of the fuzzers, each given to its target once, with any compiler.
// What is not: the search for new ones (README.md says how).
#include <gtest/gtest.h>

#include <filesystem>

#include "fuzz_targets.h"
#include "io/files.h"

namespace perfora::test {
namespace {

/// Gives every file of a folder to the target. Returns how many there are.
int feed_folder(const FuzzTarget& target, const std::filesystem::path& folder) {
  int inputs = 0;
  for (const auto& entry : std::filesystem::directory_iterator(folder)) {
    SCOPED_TRACE(entry.path().string());
    feed(target, io::read_file(entry.path()));  // ends the program when it does what it may not
    ++inputs;
  }
  return inputs;
}

TEST(Corpus, EveryKeptInputIsAcceptedOrRefused) {
  const std::filesystem::path corpus = std::filesystem::path(PERFORA_SOURCE_DIR) / "tests/fuzz/corpus";
  for (const FuzzTarget& target : fuzz_targets())
    EXPECT_GT(feed_folder(target, corpus / target.name), 0) << target.name;
}

// What ten processor minutes of search found that reaches other code (found.tar.xz).
TEST(Corpus, EveryFoundInputIsAcceptedOrRefused) {
  int targets = 0;
  for (const FuzzTarget& target : fuzz_targets())
    if (const auto folder = std::filesystem::path(PERFORA_FOUND_INPUTS) / target.name;
        std::filesystem::exists(folder)) {
      EXPECT_GT(feed_folder(target, folder), 0) << target.name;
      ++targets;
    }
  EXPECT_GE(targets, 4);
}

}  // namespace
}  // namespace perfora::test
