// What is here: designs of the public face: values, errors, copies, text and back. What is not: the keys themselves
// (tests/optimize).
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>

#include "tests/perfora/face_support.h"

namespace perfora {
namespace {

using ::testing::HasSubstr;
using ::testing::IsEmpty;

TEST(PublicDesign, TakesUnitsAsTheCommandLineDoes) {
  Design design;
  design.set("layout.diameter", "22 mm").set("layout.rows", 3).set("layout.family", "staggered");
  design.set("loading.until", "25 %").set("noise.length", 0.004);
  EXPECT_EQ(design.number("layout.diameter"), 0.022);
  EXPECT_EQ(design.number("layout.rows"), 3.0);
  EXPECT_EQ(design.text("layout.rows"), "3");
  EXPECT_EQ(design.text("layout.family"), "staggered");
  EXPECT_EQ(design.number("loading.until"), 0.25);
  EXPECT_EQ(design.number("noise.length"), 0.004);
}

TEST(PublicDesign, ErrorsAreOneSentenceAndLeaveTheDesignAsItWas) {
  Design design;
  const std::string before = design.to_toml();
  EXPECT_THAT(error_of([&] { design.set("layout.diametre", "22 mm"); }), HasSubstr("did you mean layout.diameter?"));
  EXPECT_THAT(error_of([&] { design.set("layout.diameter", "22 kg"); }), HasSubstr("no unit of a length"));
  EXPECT_THAT(error_of([&] { design.set("layout.diameter", -1.0); }), HasSubstr("out of range"));
  EXPECT_THAT(error_of([&] { design.set("layout.rows", 2.5); }), HasSubstr("whole number"));
  EXPECT_THAT(error_of([&] { static_cast<void>(design.number("layout.row")); }), HasSubstr("layout.rows"));
  EXPECT_THAT(error_of([&] { static_cast<void>(design.text("nowhere")); }), HasSubstr("sections are"));
  EXPECT_THAT(error_of([&] { static_cast<void>(design.number("layout.family")); }), HasSubstr("is not a number"));
  EXPECT_THAT(error_of([&] { static_cast<void>(Design::from_toml("[layout\n", "mine")); }), HasSubstr("mine:1"));
  EXPECT_THAT(error_of([&] { static_cast<void>(Design::from_file("/nowhere/d.toml")); }), HasSubstr("/nowhere/d.toml"));
  EXPECT_EQ(design.to_toml(), before);
}

TEST(PublicDesign, CopiesAreIndependent) {
  Design first;
  Design second = first;
  second.set("layout.rows", 2);
  first = first;
  EXPECT_EQ(first.number("layout.rows"), 6.0);  // the default that docs/user/design-files.md states
  first = second;
  second.set("layout.rows", 4);
  EXPECT_EQ(first.number("layout.rows"), 2.0);
}

TEST(PublicDesign, TextAndFileGiveTheSameDesignBack) {
  const DesignFolder folder;
  Design design = small_block();
  design.set("packing.mean_diameter", "0.5044 mm");
  const Design from_text = Design::from_toml(design.to_toml());
  const Design from_file = Design::from_file(folder.file("d.toml", design.to_toml()), {"layout.rows=2"});
  EXPECT_EQ(from_text.to_toml(), design.to_toml());
  EXPECT_EQ(from_file.number("layout.rows"), 2.0);
}

TEST(PublicDesign, EveryKeyTakesTheTextThatItGives) {
  Design design = small_block();
  const std::string before = design.to_toml();
  for (const Key& key : Design::keys()) {
    if (key.type == KeyType::path) continue;  // an empty one is no file
    EXPECT_EQ(error_of([&] { design.set(key.name, design.text(key.name)); }), "") << key.name;
  }
  EXPECT_EQ(design.to_toml(), before);
}

TEST(PublicDesign, KeysSayWhatTheyHold) {
  const std::vector<Key> keys = Design::keys();
  const auto key = [&](const std::string& name) {
    return *std::find_if(keys.begin(), keys.end(), [&](const Key& one) { return one.name == name; });
  };
  EXPECT_EQ(key("layout.diameter").dimension, "length");
  EXPECT_EQ(key("layout.diameter").unit, "m");
  EXPECT_EQ(key("layout.diameter").default_text, "0.02");
  EXPECT_EQ(key("layout.rows").type, KeyType::integer);
  EXPECT_EQ(key("layout.rows").dimension, "");
  EXPECT_EQ(key("layout.family").type, KeyType::choice);
  EXPECT_THAT(key("layout.family").choices, ::testing::Contains("staggered"));
  EXPECT_EQ(key("layout.family").range, "");
  for (const Key& one : keys) EXPECT_FALSE(one.help.empty()) << one.name;
}

TEST(PublicDesign, ChecksWithoutPlacingDiscs) {
  EXPECT_THAT(small_block().check(), ::testing::Not(::testing::Contains("")));
  Design overlapping = small_block();
  overlapping.set("layout.diameter", "14 mm");
  EXPECT_NE(error_of([&] { static_cast<void>(overlapping.check()); }), "");
}

}  // namespace
}  // namespace perfora
