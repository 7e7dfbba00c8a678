// What is here: what a user reads when a key or its value is wrong. Wording is part of the contract: file, line, key,
// problem, remedy. What is not: TOML syntax (test_toml.cpp).
#include <gmock/gmock.h>

#include "example_options.h"
#include "io_support.h"

namespace perfora::io {
namespace {

using testing::AllOf;
using testing::HasSubstr;
using testing::StartsWith;

/// The error that a file with this text gives; nothing of it may have reached the named key's field before.
std::string error_of(const std::string& text) {
  Example example;
  return input_error([&] { example.apply(text); });
}

TEST(SchemaErrors, UnknownKeyNamesTheNearest) {
  EXPECT_EQ(error_of("[layout]\ndiametr = 1.0\n"),
            "a.toml:2: layout.diametr: unknown key in [layout]; did you mean layout.diameter?");
}

TEST(SchemaErrors, UnknownKeyOfAnotherSectionNamesThatSection) {
  EXPECT_THAT(error_of("[layout]\nrate = 1.0\n"), HasSubstr("rate is a key of [loading]"));
  EXPECT_THAT(error_of("[layout]\nsolid_fractoin = 1.0\n"), HasSubstr("did you mean solid_fraction in [packing]?"));
}

TEST(SchemaErrors, UnknownKeyWithoutNeighbourListsTheKeys) {
  EXPECT_THAT(error_of("[layout]\nzzz = 1.0\n"), HasSubstr("its keys are family, diameter, rows, holes, file"));
}

TEST(SchemaErrors, UnknownSectionListsTheSections) {
  EXPECT_EQ(error_of("[layuot]\nrows = 1\n"),
            "a.toml:2: layuot.rows: unknown section [layuot]; sections are [layout], [packing], [loading]; did you "
            "mean [layout]?");
  EXPECT_THAT(error_of("[zzz]\nrows = 1\n"), HasSubstr("the key rows belongs in [layout]"));
  EXPECT_THAT(error_of("[layout.deeper]\nrows = 1\n"), HasSubstr("unknown"));
}

TEST(SchemaErrors, KeyOutsideEverySectionNamesItsHome) {
  EXPECT_THAT(error_of("rows = 1\n"), AllOf(StartsWith("a.toml:1: rows: stands outside every section"),
                                            HasSubstr("the key rows belongs in [layout]")));
  EXPECT_THAT(error_of("layout = 1\n"), HasSubstr("is a section, not a key"));
  EXPECT_THAT(error_of("\"layout.rows\" = 1\n"), HasSubstr("a.toml:1: "));
}

TEST(SchemaErrors, TitleAndDescriptionAreTexts) {
  EXPECT_EQ(error_of("title = 3\n"), "a.toml:1: title: found the whole number 3; a text in quotes is wanted");
}

TEST(SchemaErrors, WrongTypesSayWhatWasFoundAndWhatIsWanted) {
  EXPECT_EQ(error_of("[layout]\nrows = \"six\"\n"),
            "a.toml:2: layout.rows: found the text \"six\"; a whole number is wanted, such as 6");
  EXPECT_THAT(error_of("[layout]\nrows = 6.5\n"), HasSubstr("found the number 6.5; a whole number is wanted"));
  EXPECT_THAT(error_of("[layout]\nrows = [6]\n"), HasSubstr("found a list of 1 value;"));
  EXPECT_THAT(error_of("[layout]\ndiameter = true\n"), HasSubstr("found the truth value true; a length is wanted"));
  EXPECT_THAT(error_of("[layout]\nfile = 3\n"), HasSubstr("a path in quotes is wanted"));
  EXPECT_THAT(error_of("[layout]\nfamily = 3\n"), HasSubstr("allowed: square, staggered"));
  EXPECT_THAT(error_of("[packing]\nnoisy = 1\n"), HasSubstr("true or false is wanted"));
  EXPECT_THAT(error_of("[packing]\nlabel = 1\n"), HasSubstr("a text in quotes is wanted"));
  EXPECT_THAT(error_of("[loading]\nplain = \"3 mm\"\n"), HasSubstr("a plain number is wanted"));
  EXPECT_THAT(error_of("[loading]\nstrains = 0.1\n"), HasSubstr("a list of numbers in square brackets is wanted"));
}

TEST(SchemaErrors, OutOfRangeSaysTheRange) {
  EXPECT_EQ(error_of("[layout]\ndiameter = \"-20 mm\"\n"),
            "a.toml:2: layout.diameter: -0.02 m is out of range; allowed: greater than 0 (in m); choose a value in "
            "that range");
  EXPECT_EQ(error_of("[packing]\nsolid_fraction = 60\n"),
            "a.toml:2: packing.solid_fraction: 60 is out of range; allowed: greater than 0 and at most 1; did you mean "
            "0.6, which is \"60 %\"?");
  EXPECT_THAT(error_of("[packing]\nsolid_fraction = 1.2\n"), HasSubstr("choose a value in that range"));
  EXPECT_THAT(error_of("[layout]\nrows = 0\n"), HasSubstr("0 is out of range; allowed: 1 to 1000"));
  EXPECT_THAT(error_of("[layout]\nrows = 4294967297\n"), HasSubstr("out of range"));  // 2^32 + 1 must not become 1
  EXPECT_THAT(error_of("[loading]\nstrains = [0.1,\n 1.2]\n"),
              AllOf(StartsWith("a.toml:3: loading.strains: "), HasSubstr("value 2: 1.2 is out of range")));
}

TEST(SchemaErrors, NanAndInfinityAreRefusedEverywhere) {
  for (const std::string bad : {"nan", "inf", "-inf"}) {
    EXPECT_THAT(error_of("[loading]\nplain = " + bad + "\n"), HasSubstr("a finite number"));
    EXPECT_THAT(error_of("[layout]\nrows = " + bad + "\n"), HasSubstr("a whole number is wanted"));
    EXPECT_THAT(error_of("[loading]\nstrains = [" + bad + "]\n"), HasSubstr("a finite number"));
    EXPECT_THAT(error_of("[layout]\nholes = [[1.0, 2.0, " + bad + "]]\n"), HasSubstr("row 1, value 3: is "));
  }
}

TEST(SchemaErrors, ChoiceNamesTheNearest) {
  EXPECT_EQ(error_of("[layout]\nfamily = \"sqare\"\n"),
            "a.toml:2: layout.family: \"sqare\" is not one of its values; allowed: square, staggered; did you mean "
            "\"square\"?");
}

TEST(SchemaErrors, RowsNameTheRow) {
  EXPECT_THAT(error_of("[layout]\nholes = [[1, 2, 3],\n[1, 2]]\n"),
              AllOf(StartsWith("a.toml:3: layout.holes: row 2 has 2 values"), HasSubstr("3 numbers")));
  EXPECT_THAT(error_of("[layout]\nholes = [[1, 2, 3],\n\n[]]\n"), StartsWith("a.toml:4: layout.holes: row 2 is empty"));
  EXPECT_THAT(error_of("[layout]\nholes = [1, 2, 3]\n"), HasSubstr("row 1 is the whole number 1"));
  EXPECT_THAT(error_of("[layout]\nholes = [[\"1 kg\", 2, 3]]\n"),
              HasSubstr("row 1, value 1: \"kg\" in \"1 kg\" is no unit of a length"));
  EXPECT_THAT(error_of("[layout]\nholes = 3\n"), HasSubstr("a list of rows of 3 numbers is wanted"));
}

TEST(SchemaErrors, AWrongValueChangesNothing) {
  Example example;
  (void)input_error([&] { example.apply("[layout]\nholes = [[1, 2, 3], [4]]\n"); });
  EXPECT_TRUE(example.options.holes.empty());
  (void)input_error([&] { example.apply("[loading]\nstrains = [0.1, 7]\n"); });
  EXPECT_TRUE(example.options.strains.empty());
  EXPECT_EQ(example.schema.origin("loading.strains").file, "default");
}

TEST(SchemaErrors, Overrides) {
  Example example;
  const auto said = [&](const std::string& text) { return input_error([&] { example.schema.set_override(text); }); };
  EXPECT_THAT(said("layout.rows"),
              StartsWith("--set: \"layout.rows\" has no equals sign; section.key=value is wanted"));
  EXPECT_THAT(said("layout.row=3"), HasSubstr("--set: layout.row: unknown key in [layout]; did you mean layout.rows?"));
  EXPECT_THAT(said("rows=3"), HasSubstr("the key rows belongs in [layout]"));
  EXPECT_THAT(said("=3"), StartsWith("--set: "));
  EXPECT_THAT(said("layout.rows="), HasSubstr("found the text \"\""));
  EXPECT_THAT(said("layout.rows=1\nrows=2"), HasSubstr("--set: layout.rows: found the text"));
  EXPECT_THAT(said("layout.holes=[[1,2,3]"), HasSubstr("a list of rows of 3 numbers is wanted"));
  EXPECT_THAT(said("packing.label=\xff"), HasSubstr("not valid UTF-8"));
  EXPECT_THAT(said("layout.diameter=nan"), HasSubstr("a finite number"));
  EXPECT_THAT(said("layout.diameter=22 kg"), HasSubstr("accepted are m, cm, mm, um, nm"));
}

}  // namespace
}  // namespace perfora::io
