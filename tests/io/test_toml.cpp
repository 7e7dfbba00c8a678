// What is here: TOML text into entries: order, lines, flattening, and files that cannot be read.
// What is not: values that their keys refuse (test_schema_errors.cpp).
#include <gmock/gmock.h>

#include "example_options.h"
#include "io/toml.h"
#include "io_support.h"

namespace perfora::io {
namespace {

using testing::AllOf;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::StartsWith;

std::vector<std::string> keys_of(const std::string& text) {
  std::vector<std::string> keys;
  for (const Entry& entry : parse_toml(text, "a.toml")) keys.push_back(entry.key);
  return keys;
}

TEST(Toml, KeepsTheOrderOfTheFile) {
  EXPECT_THAT(keys_of("[z]\nb = 1\na = 2\n[y]\nd = 3\nc.x = 4\n[m]\ni = {q = 1, p = 2}\n"),
              ElementsAre("z.b", "z.a", "y.d", "y.c.x", "m.i.q", "m.i.p"));
}

TEST(Toml, FlattensArraysOfTables) {
  EXPECT_THAT(keys_of("[[variables]]\nkey = \"a\"\n[[variables]]\nkey = \"b\"\n"),
              ElementsAre("variables.0.key", "variables.1.key"));
}

TEST(Toml, ValuesKeepTypeAndLine) {
  const auto entries = parse_toml("a = true\nb = 3\n\nc = 2.5\nd = \"x\"\ne = [1,\n [2.0, \"y\"]]\n", "a.toml");
  ASSERT_EQ(entries.size(), 5U);
  EXPECT_EQ(std::get<bool>(entries[0].value.data), true);
  EXPECT_EQ(std::get<std::int64_t>(entries[1].value.data), 3);
  EXPECT_EQ(std::get<double>(entries[2].value.data), 2.5);
  EXPECT_EQ(entries[2].value.line, 4);
  EXPECT_EQ(std::get<std::string>(entries[3].value.data), "x");
  const auto& list = std::get<ValueList>(entries[4].value.data);
  EXPECT_EQ(list[0].line, 6);
  EXPECT_EQ(list[1].line, 7);
  EXPECT_EQ(std::get<std::string>(std::get<ValueList>(list[1].data)[1].data), "y");
}

std::string error_of(const std::string& text) {
  return input_error([&] { (void)parse_toml(text, "a.toml"); });
}

TEST(Toml, DuplicatesNameTheLine) {
  EXPECT_THAT(error_of("[a]\nb = 1\nb = 2\n"), AllOf(StartsWith("a.toml:3: not valid TOML"), HasSubstr("once")));
  EXPECT_THAT(error_of("[a]\nb = 1\n[c]\n[a]\n"), AllOf(StartsWith("a.toml:4: not valid TOML"), HasSubstr("once")));
}

TEST(Toml, SyntaxErrorsNameTheLine) {
  EXPECT_THAT(error_of("[a]\nb = 20 mm\n"), AllOf(StartsWith("a.toml:2: "), HasSubstr("need quotes")));
  EXPECT_THAT(error_of("[a]\nb = \"x\n"), StartsWith("a.toml:2: "));
  EXPECT_THAT(error_of("[a\n"), StartsWith("a.toml:1: "));
  EXPECT_THAT(error_of("= 1\n"), StartsWith("a.toml:1: "));
  EXPECT_THAT(error_of("[.a]\n"), StartsWith("a.toml:1: "));
  EXPECT_THAT(error_of("a = 1e400\n"), StartsWith("a.toml:1: "));
  EXPECT_THAT(error_of("a = 99999999999999999999\n"), StartsWith("a.toml:1: "));
  EXPECT_THAT(error_of("a = \"\xff\"\n"), StartsWith("a.toml:1: "));
  EXPECT_THAT(error_of(std::string("a = 1\n\0b = 2\n", 13)), StartsWith("a.toml:2: "));
}

TEST(Toml, NonAsciiCharactersOutsideQuotesNameTheLine) {
  for (const char* bad : {"\u00e9", "\u03b4", "\u3042", "\uff01", "\u2014", "\u00a0x"}) {
    EXPECT_THAT(error_of(std::string(bad) + " = 1\n"), StartsWith("a.toml:1: "));
    EXPECT_THAT(error_of(std::string("h") + bad + "he = 1\n"), StartsWith("a.toml:1: "));
    EXPECT_THAT(error_of("a = 20 " + std::string(bad) + "m\n"), StartsWith("a.toml:1: "));
    EXPECT_THAT(error_of("a = 20" + std::string(bad) + "\n"), StartsWith("a.toml:1: "));
    EXPECT_THAT(keys_of(std::string("\"") + bad + "\" = \"\"\"\\\n" + bad + "\"\"\" # " + bad), ElementsAre(bad));
  }
}

TEST(Toml, DatesAndMixedListsAreRefused) {
  EXPECT_THAT(error_of("a = 2020-01-01\n"), AllOf(StartsWith("a.toml:1: a: found a date"), HasSubstr("in quotes")));
  EXPECT_THAT(error_of("a = 10:00:00\n"), HasSubstr("date or time"));
  EXPECT_THAT(error_of("a = [1, {b = 2}]\n"), HasSubstr("has a table among other values of a list"));
}

TEST(Toml, DeepNestingIsRefusedNotFatal) {
  std::string deep = "a";
  for (int k = 0; k < 1000000; ++k) deep += ".a";
  EXPECT_THAT(error_of(deep + " = 1\n"), HasSubstr("too many parts"));
  EXPECT_THAT(error_of("[" + deep + "]\n"), HasSubstr("too many parts"));
  EXPECT_THAT(error_of("a = " + std::string(1000000, '[') + "\n"), StartsWith("a.toml:1: "));
  std::string inline_tables = "a = ";
  for (int k = 0; k < 100000; ++k) inline_tables += "{a=";
  EXPECT_THAT(error_of(inline_tables), StartsWith("a.toml:1: "));
}

TEST(Toml, FilesThatCannotBeRead) {
  const TemporaryFolder folder;
  const auto said = [](const std::filesystem::path& path) { return input_error([&] { (void)read_toml(path); }); };
  EXPECT_EQ(said(folder / "none.toml"), (folder / "none.toml").string() + ": does not exist; check the path");
  EXPECT_THAT(said(folder.path()), HasSubstr("is a folder"));
  EXPECT_THAT(said(folder.file("big.toml", std::string((16U << 20) + 1U, '#'))), HasSubstr("is larger than 16 MB"));
  EXPECT_THAT(said("/dev/zero"), HasSubstr("is a device; a file is wanted"));
  EXPECT_TRUE(read_toml(folder.file("empty.toml", "")).empty());
  EXPECT_EQ(read_toml(folder.file("bom.toml",
                                  "\xEF\xBB\xBF"
                                  "a = 1\r\n"))
                .size(),
            1U);
}

}  // namespace
}  // namespace perfora::io
