// What is here: values into fields and back: every type of key, --set, origins, resolved configuration, printed
// reference. What is not: wrong input (test_schema_errors.cpp).
#include <gmock/gmock.h>

#include <bit>
#include <random>

#include "example_options.h"
#include "io_support.h"

namespace perfora::io {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;

TEST(Schema, SetsEveryTypeOfKey) {
  Example example;
  example.apply(R"(
title = "An example"
description = "free"
[layout]
family = "staggered"
diameter = "22 mm"
rows = 8
holes = [["12.5 mm", "12.5 mm", "20 mm"], [0.0375, 0.0125, 0.02]]
[packing]
solid_fraction = "71.9 %"
noisy = true
label = "a b"
seed = 9007199254740993
[loading]
plain = 3
strains = [0, 0.1, "25 %"]
)");
  const ExampleOptions& got = example.options;
  EXPECT_EQ(got.family, Family::staggered);
  EXPECT_EQ(got.diameter, 0.022);
  EXPECT_EQ(got.rows, 8);
  EXPECT_THAT(got.holes, ElementsAre(0.0125, 0.0125, 0.02, 0.0375, 0.0125, 0.02));
  EXPECT_EQ(got.fraction, 0.719);
  EXPECT_TRUE(got.noisy);
  EXPECT_EQ(got.label, "a b");
  EXPECT_EQ(got.seed, 9007199254740993);  // 2^53 + 1: lost if it went through a double
  EXPECT_EQ(got.plain, 3.0);
  EXPECT_THAT(got.strains, ElementsAre(0.0, 0.1, 0.25));
}

TEST(Schema, OverridesTakeTomlOrBareText) {
  Example example;
  Schema& schema = example.schema;
  schema.set_override("layout.diameter=22mm");
  EXPECT_EQ(example.options.diameter, 0.022);
  schema.set_override("layout.diameter=23 mm");
  EXPECT_EQ(example.options.diameter, 0.023);
  schema.set_override("layout.diameter = \"24 mm\"");
  EXPECT_EQ(example.options.diameter, 0.024);
  schema.set_override("layout.diameter=0.025");
  EXPECT_EQ(example.options.diameter, 0.025);
  schema.set_override("layout.family=staggered");
  EXPECT_EQ(example.options.family, Family::staggered);
  schema.set_override("packing.noisy=true");
  EXPECT_TRUE(example.options.noisy);
  schema.set_override("packing.label=true");  // a key that holds text takes any text
  EXPECT_EQ(example.options.label, "true");
  schema.set_override("packing.label=a=b # c");
  EXPECT_EQ(example.options.label, "a=b # c");
  schema.set_override("packing.label=");
  EXPECT_EQ(example.options.label, "");
  schema.set_override("packing.solid_fraction=70%");
  EXPECT_EQ(example.options.fraction, 0.7);
  schema.set_override("loading.rate=0.5/s");
  EXPECT_EQ(example.options.rate, 0.5);
  schema.set_override("loading.strains=[0.1, 0.2]");
  EXPECT_THAT(example.options.strains, ElementsAre(0.1, 0.2));
  schema.set_override("layout.holes=[[\"1 mm\", 0, 2e-3]]");
  EXPECT_THAT(example.options.holes, ElementsAre(0.001, 0.0, 0.002));
}

TEST(Schema, KnowsWhereAValueCameFrom) {
  Example example;
  EXPECT_EQ(example.schema.origin("layout.rows").file, "default");
  example.apply("[layout]\n\nrows = 4\n");
  EXPECT_EQ(example.schema.origin("layout.rows").file, "a.toml");
  EXPECT_EQ(example.schema.origin("layout.rows").line, 3);
  EXPECT_EQ(example.schema.origin("layout.rows").key, "layout.rows");
  example.schema.set_override("layout.rows=5");
  EXPECT_EQ(example.schema.origin("layout.rows").file, "--set");
  EXPECT_EQ(example.schema.origin("layout.rows").line, 0);
}

TEST(Schema, PathsAreRelativeToTheFileTheyAreWrittenIn) {
  const TemporaryFolder folder;
  std::filesystem::create_directory(folder / "designs");
  Example example;
  apply_toml(example.schema, folder.file("designs/a.toml", "[layout]\nfile = \"../holes.csv\"\n"));
  EXPECT_EQ(example.options.file, folder / "holes.csv");
  example.schema.set_override("layout.file=holes.csv");
  EXPECT_EQ(example.options.file, std::filesystem::current_path() / "holes.csv");
  example.schema.set_override("layout.file=/data/holes.csv");
  EXPECT_EQ(example.options.file, "/data/holes.csv");
  example.schema.set_override("layout.file=");
  EXPECT_TRUE(example.options.file.empty());
}

TEST(Schema, NumbersByName) {
  Example example;
  example.schema.set_number("layout.diameter", 0.03, {"study", 0, ""});
  EXPECT_EQ(example.schema.get_number("layout.diameter"), 0.03);
  example.schema.set_number("layout.rows", 7.0, {"study", 0, ""});
  EXPECT_EQ(example.options.rows, 7);
  EXPECT_EQ(example.schema.get_number("layout.rows"), 7.0);
  EXPECT_THAT(input_error([&] {
                example.schema.set_number("layout.rows", 7.5, {"study", 0, ""});
              }),
              HasSubstr("a whole number is wanted"));
  EXPECT_THAT(input_error([&] {
                example.schema.set_number("layout.family", 1.0, {"study", 0, ""});
              }),
              HasSubstr("not a number that could be varied"));
  EXPECT_THAT(input_error([&] {
                example.schema.set_number("layout.row", 1.0, {"study", 0, ""});
              }),
              HasSubstr("did you mean layout.rows?"));
  EXPECT_THAT(input_error([&] { (void)example.schema.get_number("layout.family"); }), HasSubstr("is not a number"));
}

TEST(Schema, ElementsOfListsByName) {
  Example example;
  example.apply("[layout]\nholes = [[\"1 mm\", 2e-3, 3e-3], [4e-3, 5e-3, 6e-3]]\n[loading]\nstrains = [0.1, 0.2]\n");
  example.schema.set_override("loading.strains[1]=\"30 %\"");
  example.schema.set_override("layout.holes[1][2]=7 mm");
  EXPECT_THAT(example.options.strains, ElementsAre(0.1, 0.3));
  EXPECT_THAT(example.options.holes, ElementsAre(1e-3, 2e-3, 3e-3, 4e-3, 5e-3, 7e-3));
  example.schema.set_number("loading.strains[0]", 0.15, {"study", 0, ""});
  EXPECT_EQ(example.schema.get_number("loading.strains[0]"), 0.15);
  EXPECT_EQ(example.schema.get_number("layout.holes[0][0]"), 1e-3);
  EXPECT_EQ(example.schema.find("loading.strains[0]"), example.schema.find("loading.strains"));
  EXPECT_TRUE(example.schema.is_number("loading.strains[7]"));
  EXPECT_FALSE(example.schema.is_number("loading.strains"));
  EXPECT_FALSE(example.schema.is_number("layout.family"));
  EXPECT_FALSE(example.schema.is_number("layout.diameter[0]"));
  example.apply("[loading]\n\"strains[1]\" = 0.4\n");
  EXPECT_THAT(example.options.strains, ElementsAre(0.15, 0.4));
}

TEST(Schema, RefusesElementsThatAreNotThere) {
  Example example;
  example.apply("[layout]\nholes = [[1, 2, 3]]\n[loading]\nstrains = [0.1, 0.2]\n");
  const auto said = [&](const std::string& text) { return input_error([&] { example.schema.set_override(text); }); };
  EXPECT_THAT(said("loading.strains[2]=0.3"), HasSubstr("the list has 2 values here; [0] to [1]"));
  EXPECT_THAT(said("loading.strains[-1]=0.3"), HasSubstr("does not name an element of the list; loading.strains[0]"));
  EXPECT_THAT(said("loading.strains[=0.3"), HasSubstr("does not name an element"));
  EXPECT_THAT(said("loading.strains[x]=0.3"), HasSubstr("does not name an element"));
  EXPECT_THAT(said("loading.strains[0][0]=0.3"), HasSubstr("names more than an element"));
  EXPECT_THAT(said("layout.holes[0]=0.3"), HasSubstr("does not name an element of the list; layout.holes[0][0]"));
  EXPECT_THAT(said("layout.holes[0][3]=0.3"), HasSubstr("the list has 3 values here"));
  EXPECT_THAT(said("layout.diameter[0]=0.3"), HasSubstr("the key is no list; write layout.diameter"));
  EXPECT_THAT(said("loading.strain[0]=0.3"), HasSubstr("did you mean loading.strains?"));
  EXPECT_THAT(said("loading.strains[0]=2"), HasSubstr("out of range"));
  EXPECT_THAT(said("loading.strains[0]=[1]"), HasSubstr("found"));
  EXPECT_THAT(example.options.strains, ElementsAre(0.1, 0.2));
  EXPECT_THAT(input_error([&] {
                example.schema.set_number("loading.strains", 0.3, {"study", 0, ""});
              }),
              HasSubstr("name an element, such as loading.strains[0]"));
}

TEST(Schema, AListMayTakeOneNumberWithoutBrackets) {
  std::vector<double> sizes;
  Schema schema;
  schema.section("rows", "").real_list("size", sizes, Dimension::length, Range::positive(), "", OneNumber::taken);
  schema.set_override("rows.size=9 mm");
  EXPECT_THAT(sizes, ElementsAre(0.009));
  schema.set_override("rows.size=[\"9 mm\", 0.01]");
  EXPECT_THAT(sizes, ElementsAre(0.009, 0.01));
  EXPECT_THAT(input_error([&] { schema.set_override("rows.size=-1 mm"); }), HasSubstr("out of range"));
  // A key that holds a word, or one number that is read as such, has no elements.
  std::string word;
  std::vector<double> window;
  schema.section("target", "").numbers("window", window, {{Dimension::ratio}, &word, {"found"}}, "");
  for (const char* whole : {"found", "0.3"}) {
    schema.set_override(std::string("target.window=") + whole);
    EXPECT_THAT(input_error([&] { schema.set_override("target.window[0]=0.2"); }),
                HasSubstr("the key holds one value here; write target.window"));
  }
  EXPECT_THAT(input_error([&] { schema.set_override("rows.size=true"); }),
              HasSubstr("a number or a list of numbers in square brackets is wanted"));
}

TEST(Schema, ResolvedConfigurationBringsBackTheSameBits) {
  std::mt19937_64 random(7);
  const auto any_finite = [&random] {  // all exponents and both signs, denormals included
    for (;;) {
      const double value = std::bit_cast<double>(random());
      if (std::isfinite(value)) return value;
    }
  };
  std::uniform_real_distribution<double> unit(0.0, 1.0);
  for (int trial = 0; trial < 300; ++trial) {
    Example written;
    ExampleOptions& from = written.options;
    from.diameter = std::abs(any_finite()) + 5e-324;
    from.stress = any_finite();
    from.plain = any_finite();
    from.fraction = 1.0 - unit(random);
    from.seed = static_cast<std::int64_t>(random() >> 1);
    from.rows = 1 + trial;
    from.noisy = trial % 2 == 0;
    from.label = "quote \" backslash \\ tab \t line\n \u00e9 \x01 #=";
    from.family = trial % 2 == 0 ? Family::square : Family::staggered;
    from.file = "/some where/holes.csv";
    from.strains.assign(static_cast<std::size_t>(trial % 4), unit(random));
    for (int k = 0; k < 3 * (trial % 3); ++k) from.holes.push_back(any_finite());
    Example read;
    read.apply(written.schema.to_toml());
    const ExampleOptions& to = read.options;
    const auto bits = [](double value) { return std::bit_cast<std::uint64_t>(value); };
    EXPECT_EQ(bits(to.diameter), bits(from.diameter));
    EXPECT_EQ(bits(to.stress), bits(from.stress));
    EXPECT_EQ(bits(to.plain), bits(from.plain));
    EXPECT_EQ(bits(to.fraction), bits(from.fraction));
    EXPECT_EQ(to.seed, from.seed);
    EXPECT_EQ(to.rows, from.rows);
    EXPECT_EQ(to.noisy, from.noisy);
    EXPECT_EQ(to.label, from.label);
    EXPECT_EQ(to.family, from.family);
    EXPECT_EQ(to.file, from.file);
    EXPECT_EQ(to.strains, from.strains);
    EXPECT_EQ(to.holes, from.holes);
    EXPECT_EQ(read.schema.to_toml(), written.schema.to_toml());
  }
}

TEST(Schema, ChangedConfigurationLeavesDefaultsOut) {
  Example example;
  EXPECT_EQ(example.schema.changed_toml(), "");
  example.schema.set_override("loading.strains=[0.25]");
  example.schema.set_override("layout.rows=4");
  example.schema.set_override("layout.diameter=20 mm");  // the default in words
  EXPECT_EQ(example.schema.changed_toml(), "[layout]\nrows = 4\n\n[loading]\nstrains = [0.25]\n");
  Example read;
  read.apply(example.schema.changed_toml());
  EXPECT_EQ(read.schema.to_toml(), example.schema.to_toml());
}

TEST(Schema, OldNamesOfKeysAndSectionsAreTaken) {
  Example example;
  Schema& schema = example.schema;
  schema.renamed({"layout.width_of_hole", "layout.diameter"});
  schema.renamed({"filling", "packing"});
  EXPECT_EQ(schema.find("layout.width_of_hole"), schema.find("layout.diameter"));
  EXPECT_TRUE(schema.notices().empty());
  example.apply("[layout]\nrows = 3\nwidth_of_hole = \"22 mm\"\n[filling]\nlabel = \"a\"\n");
  EXPECT_EQ(example.options.diameter, 0.022);
  EXPECT_EQ(example.options.label, "a");
  schema.set_override("layout.width_of_hole=23 mm");
  EXPECT_EQ(schema.get_number("layout.width_of_hole"), 0.023);
  EXPECT_EQ(schema.origin("layout.width_of_hole").file, "--set");
  EXPECT_EQ(schema.origin("layout.diameter").file, "--set");
  // One sentence for each place and old name, however often it is set.
  schema.set_override("layout.width_of_hole=24 mm");
  ASSERT_EQ(schema.notices().size(), 3u);
  EXPECT_THAT(schema.notices()[0], HasSubstr(":3: layout.width_of_hole: is now called layout.diameter; "));
  EXPECT_THAT(schema.notices()[1], HasSubstr("filling.label: is now called packing.label; the old name is still read"));
  EXPECT_THAT(schema.notices()[2], HasSubstr("--set: layout.width_of_hole: "));
}

TEST(Schema, WhatIsMadeOfFirstNamesStaysWhenAKeyIsRenamed) {
  Example before, renamed;
  renamed.schema.renamed({"layout.first", "layout.diameter"});
  renamed.schema.renamed({"filling", "packing"});
  for (Example* example : {&before, &renamed}) {
    example->schema.set_override("layout.diameter=22 mm");
    example->schema.set_override("packing.label=a");
  }
  EXPECT_EQ(renamed.schema.changed_toml(), before.schema.changed_toml());
  EXPECT_EQ(renamed.schema.changed_toml(Names::first),
            "[layout]\nfirst = 0.021999999999999999\n\n[filling]\nlabel = \"a\"\n");
  Example read;
  read.schema.renamed({"layout.first", "layout.diameter"});
  read.schema.renamed({"filling", "packing"});
  read.apply(renamed.schema.to_toml(Names::first));
  EXPECT_EQ(read.schema.to_toml(), before.schema.to_toml());
}

TEST(Schema, AFileMayNameTheVersionOfItsKeys) {
  Example example;
  example.apply("schema_version = 1\n[layout]\nrows = 3\n");
  EXPECT_EQ(example.options.rows, 3);
  for (const char* text : {"schema_version = 2\n", "schema_version = 0\n", "schema_version = \"1\"\n"}) {
    try {
      example.apply(text);
      ADD_FAILURE() << text;
    } catch (const InputError& error) {
      EXPECT_THAT(error.what(), HasSubstr(":1: schema_version: ")) << text;
    }
  }
}

TEST(Schema, ResolvedConfigurationHoldsEveryKeyInSi) {
  Example example;
  example.schema.set_override("layout.diameter=22mm");
  const std::string text = example.schema.to_toml();
  for (const Key& key : example.schema.keys()) EXPECT_THAT(text, HasSubstr("\n" + key.name + " = "));
  EXPECT_THAT(text, HasSubstr("[layout]\nfamily = \"square\"\ndiameter = 0.022\nrows = 6\n"));
}

TEST(Schema, ReferenceIsATableASection) {
  Example example;
  const std::string text = example.schema.reference();
  EXPECT_THAT(text, HasSubstr("## [layout]\n\nPerforations.\n\n| key |"));
  EXPECT_THAT(text, HasSubstr("| `diameter` | number, m | `0.02` | greater than 0 | Hole diameter. |"));
  EXPECT_THAT(text, HasSubstr("| `family` | choice | `\"square\"` | `square`, `staggered` | Family of layouts. |"));
  EXPECT_THAT(text, HasSubstr("Share of solid \\| clipped."));
  EXPECT_EQ(example.schema.section_help("packing"), "Discs.");
  EXPECT_THAT(example.schema.section_names(), ElementsAre("layout", "packing", "loading"));
}

TEST(Range, InWords) {
  EXPECT_EQ(Range::positive().text(), "greater than 0");
  EXPECT_EQ(Range::non_negative().text(), "at least 0");
  EXPECT_EQ(Range::between(0.0, 0.5).text(), "0 to 0.5");
  EXPECT_EQ((Range{0.0, 1.0, true, false}).text(), "greater than 0 and at most 1");
  EXPECT_EQ(Range{}.text(), "any finite number");
  EXPECT_FALSE(Range{}.contains(std::nan("")));
  EXPECT_FALSE(Range::positive().contains(0.0));
  EXPECT_TRUE(Range::non_negative().contains(0.0));
}

}  // namespace
}  // namespace perfora::io
