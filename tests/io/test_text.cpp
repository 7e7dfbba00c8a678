// What is here: values as people read them and as identities hold them. Expected texts: written out by hand from the
// rule "a prefix that gives 1 to 999, four significant digits".
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "io/text.h"
#include "io/units.h"

namespace perfora::io {
namespace {

constexpr double inf = std::numeric_limits<double>::infinity();

TEST(Text, QuantitiesTakeThePrefixOfOneTo999) {
  EXPECT_EQ(quantity(5290.0, Dimension::stress), "5.29 kPa");
  EXPECT_EQ(quantity(12.0, Dimension::stress), "12 Pa");
  EXPECT_EQ(quantity(653412.0, Dimension::stress), "653.4 kPa");
  EXPECT_EQ(quantity(1.5e6, Dimension::stress), "1.5 MPa");
  EXPECT_EQ(quantity(0.0256666666667, Dimension::length), "25.67 mm");
  EXPECT_EQ(quantity(0.5044e-3, Dimension::length), "504.4 um");
  EXPECT_EQ(quantity(2.0, Dimension::length), "2 m");
  EXPECT_EQ(quantity(1.2821e-6, Dimension::time), "1.282 us");
  EXPECT_EQ(quantity(5.31e-9, Dimension::time), "5.31 ns");
  EXPECT_EQ(quantity(24.8e6, Dimension::memory), "24.8 MB");
  EXPECT_EQ(quantity(9701.2, Dimension::energy_density), "9.701 kJ/m3");
  EXPECT_EQ(quantity(58.3, Dimension::surface_energy), "58.3 J/m2");
  EXPECT_EQ(quantity(2.195e7, Dimension::stiffness), "21.95 MN/m");
  EXPECT_EQ(quantity(2200.0, Dimension::density), "2200 kg/m3");
  EXPECT_EQ(quantity(0.5, Dimension::rate), "0.5 1/s");
  EXPECT_EQ(quantity(4e-4, Dimension::area), "400 mm2");
  EXPECT_EQ(quantity(1.5, Dimension::area), "1.5 m2");
  EXPECT_EQ(quantity(std::numbers::pi / 6.0, Dimension::angle), "30 deg");
  EXPECT_EQ(quantity(0.35, Dimension::ratio), "35 %");
  EXPECT_EQ(quantity(0.00053215, Dimension::ratio), "0.05322 %");
  EXPECT_EQ(quantity(36607.0, Dimension::count), "36,607");
  EXPECT_EQ(quantity(0.2509, Dimension::none), "0.2509");
}

TEST(Text, RoundingCrossesThePrefix) {
  EXPECT_EQ(quantity(999.94e3, Dimension::stress), "999.9 kPa");
  EXPECT_EQ(quantity(999.96e3, Dimension::stress), "1 MPa");
  EXPECT_EQ(quantity(-999.96e3, Dimension::stress), "-1 MPa");
  EXPECT_EQ(quantity(1000.0, Dimension::stress), "1 kPa");
  EXPECT_EQ(quantity(0.99996e-3, Dimension::length), "1 mm");
  EXPECT_EQ(quantity(9.9996e-7, Dimension::time), "1 us");
  EXPECT_EQ(number(9999.4), "9999");
  EXPECT_EQ(number(9999.6), "10,000");
  EXPECT_EQ(number(999960.0), "1e+06");
}

TEST(Text, EndsOfTheRange) {
  EXPECT_EQ(quantity(0.0, Dimension::stress), "0 Pa");
  EXPECT_EQ(quantity(-0.0, Dimension::stress), "0 Pa");
  EXPECT_EQ(quantity(0.0, Dimension::length), "0 m");
  EXPECT_EQ(quantity(0.0123, Dimension::stress), "0.0123 Pa") << "no mPa, which is read as MPa";
  EXPECT_EQ(quantity(5e-324, Dimension::length), "4.941e-315 nm");
  EXPECT_EQ(quantity(1e300, Dimension::stress), "1e+291 GPa");
  EXPECT_EQ(quantity(NAN, Dimension::stress), "-");
  EXPECT_EQ(quantity(NAN, Dimension::count, "none"), "none");
  EXPECT_EQ(quantity(NAN, Dimension::stress, "not reached"), "not reached");
  EXPECT_EQ(quantity(inf, Dimension::stress), "infinity");
  EXPECT_EQ(quantity(-inf, Dimension::length), "-infinity");
}

TEST(Text, SeveralValuesShareTheUnitOfTheLargest) {
  EXPECT_EQ(quantities({0.05, 0.1}, Dimension::length, " x "), "50 x 100 mm");
  EXPECT_EQ(quantities({5.294e3, 312.0}, Dimension::stress, " +- "), "5.294 +- 0.312 kPa");
  EXPECT_EQ(quantities({0.2, 0.4}, Dimension::ratio, " to "), "20 to 40 %");
  EXPECT_EQ(quantities({1e-3, NAN}, Dimension::length, " to "), "1 to - mm");
  EXPECT_EQ(quantities({NAN, NAN}, Dimension::length, " to "), "- to -");
  EXPECT_EQ(quantities({0.25, 0.5}, Dimension::none, ", "), "0.25, 0.5");
  const PrintUnit unit = unit_for(1e-3, Dimension::length);
  EXPECT_EQ(in_unit(0.5044e-3, unit), "0.5044 mm");
  EXPECT_EQ(unit_for(NAN, Dimension::stress).name, "Pa");
}

// What is drawn stands beside the name of its unit: 504.4 um, 30 degrees of pi/6.
TEST(Text, ScalesLeadToTheUnit) {
  EXPECT_DOUBLE_EQ(scale_of(unit_for(0.5044e-3, Dimension::length)) * 0.5044e-3, 504.4);
  EXPECT_DOUBLE_EQ(scale_of(unit_for(0.35, Dimension::ratio)), 100.0);
  EXPECT_DOUBLE_EQ(scale_of(unit_for(0.2, Dimension::angle)) * std::numbers::pi / 6.0, 30.0);
  EXPECT_EQ(in_unit(std::numbers::pi / 6.0, unit_for(0.2, Dimension::angle)), "30 deg");
}

// Four significant digits come back from every text, in the unit it names.
TEST(Text, WhatIsPrintedIsRead) {
  for (const Dimension dimension :
       {Dimension::ratio, Dimension::length, Dimension::area, Dimension::stress, Dimension::density, Dimension::rate,
        Dimension::angle, Dimension::energy_density, Dimension::surface_energy, Dimension::memory})
    for (int power = -5; power <= 8; ++power) {
      const double value = 1.23456 * std::pow(10.0, power);
      std::string text = quantity(value, dimension);
      std::erase(text, ',');
      EXPECT_NEAR(parse_quantity({text}, dimension, {}) / value, 1.0, 5e-4) << text;
    }
}

TEST(Text, NumbersAndCounts) {
  EXPECT_EQ(number(0.25), "0.25");
  EXPECT_EQ(number(12345.6), "12,350");
  EXPECT_EQ(number(2.195e7), "2.195e+07");
  EXPECT_EQ(number(3.14159e-7), "3.142e-07");
  EXPECT_EQ(number(NAN), "-");
  EXPECT_EQ(count(0), "0");
  EXPECT_EQ(count(999), "999");
  EXPECT_EQ(count(1000), "1,000");
  EXPECT_EQ(count(std::size_t{36607}), "36,607");
  EXPECT_EQ(count(-1234567), "-1,234,567");
  EXPECT_EQ(count(-0.4), "0");
  EXPECT_EQ(count(9007199254740992.0), "9,007,199,254,740,992");
  EXPECT_EQ(count(NAN), "-");
  EXPECT_EQ(count(inf), "infinity");
}

TEST(Text, DurationsReadLikeAClock) {
  EXPECT_EQ(duration(0.0), "0 s");
  EXPECT_EQ(duration(0.4), "400 ms");
  EXPECT_EQ(duration(0.9999), "1 s");
  EXPECT_EQ(duration(3.24), "3.2 s");
  EXPECT_EQ(duration(9.96), "10 s");
  EXPECT_EQ(duration(45.0), "45 s");
  EXPECT_EQ(duration(59.6), "1 min 00 s");
  EXPECT_EQ(duration(185.0), "3 min 05 s");
  EXPECT_EQ(duration(7620.0), "2 h 07 min");
  EXPECT_EQ(duration(14.0 * 86400.0 + 3.0 * 3600.0), "14 d 3 h");
  EXPECT_EQ(duration(HUGE_VAL), "more than a year");
  EXPECT_EQ(duration(NAN), "unknown time");
  EXPECT_EQ(duration(-1.0), "unknown time");
}

// Names of a sweep's cases and identities of studies are stored: these texts never change.
TEST(Text, StoredTexts) {
  const Value list{ValueList{Value{0.1}, Value{std::int64_t{2}}, Value{std::string("a")}, Value{true}}};
  EXPECT_EQ(value_text({0.1}), "0.10000000000000001");
  EXPECT_EQ(value_text({1e22}), "1e+22");
  EXPECT_EQ(value_text({std::string("20 mm")}), "20 mm");
  EXPECT_EQ(value_text(list), "[0.10000000000000001, 2, a, true]");
  EXPECT_EQ(readable({0.0123456789}), "0.0123457");
  EXPECT_EQ(readable({1234567.0}), "1.23457e+06");
  EXPECT_EQ(readable({std::string("20 mm")}), "20 mm");
  EXPECT_EQ(readable(list), "[0.1, 2, a, true]");
  EXPECT_EQ(readable(list, 3), "[4 values]");
  EXPECT_EQ(toml_literal({0.1}, Digits::all_17), "0.10000000000000001");
  EXPECT_EQ(toml_literal({2.0}, Digits::shortest), "2.0");
  EXPECT_EQ(toml_literal({std::string("a\"b")}, Digits::shortest), "\"a\\\"b\"");
  EXPECT_EQ(rounded(0.1234567890123456), 0.123456789012);
}

TEST(Text, ShortenedTextsKeepWholeCharacters) {
  EXPECT_EQ(beginning("abc", 3), "abc");
  EXPECT_EQ(beginning("ab\u00e9d", 3), "ab") << "\u00e9 has two bytes";
  EXPECT_EQ(after_section("layout.diameter"), "diameter");
  EXPECT_EQ(after_section("title"), "title");
}

}  // namespace
}  // namespace perfora::io
