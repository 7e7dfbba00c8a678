// What is here: what a target wishes, reads and refuses. What is not: verdicts (test_verdict.cpp).
#include "results/target.h"

#include <gtest/gtest.h>

#include <cmath>

#include "io/error.h"
#include "io/toml.h"

namespace perfora::results {
namespace {

/// A target read from TOML text.
struct Read {
  Target target;
  MeasureOptions measures;
  io::Schema schema;

  explicit Read(const std::string& text) {
    describe(schema, measures);
    describe(schema, target);
    io::apply_entries(schema, io::parse_toml(text, "t.toml"), "t.toml");
  }
  std::string refused() {
    try {
      validate(target, measures, schema);
    } catch (const io::InputError& error) {
      return error.what();
    }
    return {};
  }
};

TEST(Target, WishesComeWithTheirSides) {
  Read read(
      "[target]\nplateau_stress = \"1.5 MPa\"\ntolerance = \"10 %\"\nlimit.first_peak_stress = \"3 MPa\"\n"
      "limit.stress_until = [0.5, \"4 MPa\"]\nlimit.smallest_over_mean = 0.6\nlimit.slope = [0.8, 1.25]\n");
  EXPECT_EQ(read.refused(), "");
  const std::vector<Wish> all = wishes(read.target);
  ASSERT_EQ(all.size(), 5u);
  EXPECT_STREQ(all[0].measure->key, "plateau_stress");
  EXPECT_NEAR(all[0].low, 1.35e6, 1e-6);
  EXPECT_NEAR(all[0].high, 1.65e6, 1e-6);
  const auto wish = [&](const std::string& key) {
    for (const Wish& one : all)
      if (one.measure->key == key) return one;
    ADD_FAILURE() << key;
    return all[0];
  };
  EXPECT_EQ(wish("first_peak_stress").high, 3e6);
  EXPECT_TRUE(std::isinf(wish("first_peak_stress").low));
  EXPECT_EQ(wish("stress_until").high, 4e6);
  EXPECT_EQ(wish("smallest_over_mean").low, 0.6);
  EXPECT_TRUE(std::isinf(wish("smallest_over_mean").high));
  EXPECT_EQ(wish("slope").low, 0.8);
  EXPECT_EQ(wish("slope").high, 1.25);
  EXPECT_EQ(measuring_frame(read.target, read.measures, 1.0).cap_strain, 0.5);
}

TEST(Target, TheWindowIsGivenOrFound) {
  Read given("[target]\nwindow = [0.1, \"30 %\"]\n");
  EXPECT_EQ(with_window_of(given.target, given.measures).plateau_start, 0.1);
  EXPECT_EQ(with_window_of(given.target, given.measures).plateau_end, 0.3);
  Read found("[target]\nwindow = \"found\"\n");
  EXPECT_EQ(with_window_of(found.target, found.measures).plateau, PlateauPlace::found);
  Read none("[target]\nplateau_stress = 1e5\n");
  EXPECT_EQ(with_window_of(none.target, none.measures).plateau_start, 0.2);
  EXPECT_EQ(with_window_of(none.target, none.measures).plateau, PlateauPlace::window);
}

// What to_toml writes comes back: the word, single numbers, ranges.
TEST(Target, GoesThroughToml) {
  Read read(
      "[target]\nwindow = \"found\"\nlimit.cap_ratio = 2\nlimit.slope = [0.8, 1.25]\nlimit.stress_until = [0.5, 4e6]\n"
      "weight.undulation = 0.5\nstatement = \"block\"\n");
  Read again(read.schema.to_toml());
  EXPECT_EQ(again.target, read.target);
}

// The wished level over the window: a line from 1 at 0 to 3 at 0.4 has the mean 2.5 over [0.2, 0.4].
TEST(Target, ACurveHasALevelAndAWish) {
  Read read("[target]\ntolerance = 0.25\ncurve_points = [[0.0, 1e5], [0.4, 3e5]]\n");
  EXPECT_NEAR(read.target.level(0.2, 0.4), 2.5e5, 1e-6);
  EXPECT_NEAR(read.target.stress_at(0.1), 1.5e5, 1e-6);
  ASSERT_EQ(wishes(read.target).size(), 1u);
  EXPECT_STREQ(wishes(read.target)[0].measure->key, "target_distance");
  EXPECT_NEAR(wishes(read.target)[0].high, std::log(1.25), 1e-12);
}

TEST(Target, RefusesWhatMakesNoSense) {
  const std::pair<const char*, const char*> cases[] = {
      {"window = [0.4, 0.2]", "target.window"},
      {"limit.slope = 1", "which side is kept"},
      {"limit.slope = [1.25, 0.8]", "the range is empty"},
      {"limit.stroke_at_cap = 0.4", "target.cap"},
      {"limit.stress_until = [0.5]", "target.limit.stress_until"},
      {"record = \"trough_stres\"", "did you mean trough_stress?"},
      {"weight.first_peak_stress = 1", "no stress that it could be compared with"},
      {"plateau_stress = 1e5\ncurve_points = [[0.0, 1e5], [0.5, 1e5]]", "both a stress and a curve"},
      {"curve_points = [[0.0, 1e5], [0.3, 1e5]]", "the window from 0.2 to 0.4"},
      {"curve_points = [[0.2, 1e5], [0.1, 1e5]]", "do not rise"},
      {"curve_points = [[0.0, 0.0], [0.5, 1e5]]", "not above zero"},
  };
  for (const auto& [line, expected] : cases) {
    Read read(std::string("[target]\n") + line + "\n");
    EXPECT_NE(read.refused().find(expected), std::string::npos) << line << " gave: " << read.refused();
  }
}

TEST(Target, AWishAndALimitThatExcludeEachOtherAreTold) {
  const auto told = [](const std::string& limit) {
    const Read read("[target]\nplateau_stress = \"10 MPa\"\nlimit.plateau_stress = " + limit + "\n");
    int count = 0;
    for (const std::string& warning : warnings(read.target)) count += warning.find("in common") != std::string::npos;
    return count;
  };
  EXPECT_EQ(told("[\"1 MPa\", \"2 MPa\"]"), 1);  // 8 to 12 MPa are wished
  EXPECT_EQ(told("[\"1 MPa\", \"9 MPa\"]"), 0);
  EXPECT_EQ(told("[\"13 MPa\", \"20 MPa\"]"), 1);
}

TEST(Target, AStressUpToAStrainIsAPair) {
  const std::pair<const char*, const char*> cases[] = {
      {"\"3 MPa\"", "found the text \"3 MPa\"; [ratio, stress] is wanted, such as [\"25 %\", \"2 MPa\"]"},
      {"[\"3 MPa\", 0.4]", "value 1: \"MPa\" in \"3 MPa\" is no unit of a ratio"},
  };
  for (const auto& [value, expected] : cases) try {
      Read read(std::string("[target]\nlimit.stress_until = ") + value + "\n");
      ADD_FAILURE() << value << " was taken";
    } catch (const io::InputError& error) {
      EXPECT_NE(std::string(error.what()).find(expected), std::string::npos) << error.what();
    }
}

TEST(Target, WordsOfTheWindowAreNamedWhereAnotherIsWritten) {
  try {
    Read read("[target]\nwindow = \"founded\"\n");
    FAIL();
  } catch (const io::InputError& error) {
    EXPECT_NE(std::string(error.what()).find("\"found\""), std::string::npos) << error.what();
  }
}

TEST(Target, WarnsOfAPascalThatWasMeantAsMegapascal) {
  Read read("[target]\nplateau_stress = 1.5\nlimit.first_peak_stress = 3\n");
  const std::vector<std::string> told = warnings(read.target);
  ASSERT_EQ(told.size(), 2u);
  EXPECT_NE(told[0].find("target.plateau_stress is 1.5 Pa"), std::string::npos) << told[0];
  EXPECT_NE(told[0].find("did you mean \"1.5 MPa\"?"), std::string::npos) << told[0];
  EXPECT_NE(told[1].find("did you mean \"3 MPa\"?"), std::string::npos) << told[1];
  EXPECT_TRUE(warnings(Read("[target]\nplateau_stress = \"1.5 MPa\"\n").target).empty());
}

TEST(Target, WarnsOfAPlateauAboveItsCap) {
  // 100 MPa within 20 % is 80 MPa at least.
  const std::vector<std::string> told =
      warnings(Read("[target]\nplateau_stress = \"100 MPa\"\nlimit.stress_until = [0.5, \"79 MPa\"]\n").target);
  ASSERT_EQ(told.size(), 1u);
  EXPECT_NE(told[0].find("no block can keep both"), std::string::npos) << told[0];
  EXPECT_TRUE(warnings(Read("[target]\nplateau_stress = \"100 MPa\"\nlimit.stress_until = [0.5, \"81 MPa\"]\n").target)
                  .empty());
}

}  // namespace
}  // namespace perfora::results
