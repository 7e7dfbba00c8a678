// What is here: one function for each kind of input, given any bytes: it may be refused with io::InputError of one
// line, nothing else may happen. What is not: who calls them (fuzz_entry.cpp for libFuzzer, test_corpus.cpp for the
// corpus).
#pragma once

#include <span>
#include <string>
#include <string_view>

namespace perfora::test {

struct FuzzTarget {
  const char* name;  ///< of the folder of its corpus, too
  void (*run)(std::string_view input);
};

/// All of them.
std::span<const FuzzTarget> fuzz_targets();

/// Gives `input` to one target. Ends the program with a message when what it does is not allowed.
void feed(const FuzzTarget& target, std::string_view input);

}  // namespace perfora::test
