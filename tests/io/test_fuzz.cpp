// What is here: random text into every parser of io: it may only be accepted or refused with an InputError of one line.
// What is not: particular mistakes.
#include <gtest/gtest.h>

#include <cstdlib>
#include <random>

#include "example_options.h"
#include "io/csv.h"
#include "io/files.h"
#include "io/journal.h"
#include "io/units.h"
#include "io_support.h"

namespace perfora::io {
namespace {

using Random = std::mt19937_64;

std::size_t below(Random& random, std::size_t n) {
  return std::uniform_int_distribution<std::size_t>(0, n - 1)(random);
}

std::string random_bytes(Random& random, std::size_t longest) {
  std::string text(below(random, longest), ' ');
  for (char& c : text) c = static_cast<char>(random());
  return text;
}

/// Pieces of valid input in random order reach deeper than random bytes.
std::string random_pieces(Random& random, std::size_t most) {
  static const std::vector<std::string> pieces = {"[layout]", "[",
                                                  "]",        "\n",
                                                  "\n",       "\n",
                                                  "diameter", "holes",
                                                  "rows",     "a.b",
                                                  " = ",      "=",
                                                  "\"",       "\"20 mm\"",
                                                  "20",       " mm",
                                                  "%",        "1e",
                                                  "e9",       "-",
                                                  "+",        ".",
                                                  "1.5",      "nan",
                                                  "inf",      "true",
                                                  "{",        "}",
                                                  ",",        "#",
                                                  "'''",      "\"\"\"",
                                                  "\\",       "\\u00e9",
                                                  "\u00b5m",  "0x",
                                                  "1_0",      "2020-01-01",
                                                  "[[",       "]]",
                                                  "/s",       "1/s",
                                                  "\t",       "\r\n",
                                                  "\xff",     std::string(1, '\0'),
                                                  "title",    "x",
                                                  " ",        " "};
  std::string text;
  for (std::size_t k = below(random, most); k > 0; --k) text += pieces[below(random, pieces.size())];
  return text;
}

/// A valid file with a few bytes changed, removed or doubled.
std::string mutated(Random& random, std::string text) {
  for (std::size_t k = 1 + below(random, 4); k > 0 && !text.empty(); --k) {
    const std::size_t at = below(random, text.size());
    switch (below(random, 3)) {
      case 0:
        text[at] = static_cast<char>(random());
        break;
      case 1:
        text.erase(at, 1 + below(random, 5));
        break;
      default:
        text.insert(at, text.substr(at, 1 + below(random, 9)));
        break;
    }
  }
  return text;
}

/// PERFORA_FUZZ_FACTOR in the environment makes all of this that many times longer.
std::uint64_t rounds(std::uint64_t usual) {
  const char* factor = std::getenv("PERFORA_FUZZ_FACTOR");
  return factor == nullptr ? usual : usual * std::strtoull(factor, nullptr, 10);
}

template <class Code>
void accept_or_refuse(const std::string& input, const Code& code) {
  try {
    code();
  } catch (const InputError& error) {
    const std::string said = error.what();
    EXPECT_FALSE(said.empty());
    EXPECT_EQ(said.find('\n'), std::string::npos) << said;
  } catch (const std::exception& error) {
    ADD_FAILURE() << "not an InputError: " << error.what() << "\nfrom: " << testing::PrintToString(input);
  }
}

std::string next_text(Random& random, int kind, const std::string& valid) {
  if (kind == 0) return random_bytes(random, 80);
  if (kind == 1) return random_pieces(random, 40);
  return mutated(random, valid);
}

TEST(Fuzz, Toml) {
  const std::string valid = "title = \"x\"\n" + Example().schema.to_toml();
  for (std::uint64_t seed = 0; seed < rounds(6000); ++seed) {
    Random random(seed);
    const std::string text = next_text(random, static_cast<int>(seed % 3), valid);
    accept_or_refuse(text, [&] { Example().apply(text); });
  }
}

TEST(Fuzz, Quantities) {
  for (std::uint64_t seed = 0; seed < rounds(8000); ++seed) {
    Random random(seed);
    const std::string text = next_text(random, static_cast<int>(seed % 3), "-2.195e+7 N/m");
    for (int dimension = 0; dimension <= static_cast<int>(Dimension::angle); ++dimension)
      accept_or_refuse(text, [&] {
        EXPECT_TRUE(std::isfinite(parse_quantity({text}, static_cast<Dimension>(dimension), {"a.toml", 1, "k"})));
      });
  }
}

TEST(Fuzz, Overrides) {
  for (std::uint64_t seed = 0; seed < rounds(3000); ++seed) {
    Random random(seed);
    const std::string text = next_text(random, static_cast<int>(seed % 3), "layout.holes=[[\"1 mm\", 2, 3e-3]]");
    Example example;
    accept_or_refuse(text, [&] { example.schema.set_override(text); });
    accept_or_refuse(text, [&] { example.schema.set_override("packing.label=" + text); });
    accept_or_refuse(text, [&] { example.apply(example.schema.to_toml()); });
  }
}

TEST(Fuzz, Csv) {
  const std::string valid = "x, y, radius\n# comment\n1, 2, 3\n4.5, 5e-3, 6\n";
  for (std::uint64_t seed = 0; seed < rounds(2000); ++seed) {
    Random random(seed);
    const std::string text = next_text(random, static_cast<int>(seed % 3), valid);
    accept_or_refuse(text, [&] { (void)parse_csv(text, "a.csv", {"x", "y", "radius"}, 100); });
  }
}

TEST(Fuzz, Journal) {
  const TemporaryFolder folder;
  const auto path = folder / "journal.jsonl";
  std::string valid;
  {
    Journal journal(path);
    for (int k = 0; k < 4; ++k) journal.append("{\"event\":" + std::to_string(k) + "}");
    valid = read_file(path);
  }
  for (std::uint64_t seed = 0; seed < rounds(150); ++seed) {
    Random random(seed);
    const std::string text = next_text(random, static_cast<int>(seed % 3), valid);
    folder.file("journal.jsonl", text);
    accept_or_refuse(text, [&] { Journal journal(path); });
  }
}

}  // namespace
}  // namespace perfora::io
