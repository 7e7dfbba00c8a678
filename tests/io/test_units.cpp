// What is here: quantities against the SI prefixes and the definitions of the units, written out by hand.
// What is not: keys and files.
#include <gmock/gmock.h>

#include <numbers>
#include <random>

#include "io/schema.h"
#include "io/units.h"
#include "io_support.h"

namespace perfora::io {
namespace {

using testing::EndsWith;
using testing::HasSubstr;

const Origin here{"a.toml", 3, "s.k"};

double quantity(const std::string& text, Dimension dimension) {
  return parse_quantity({text}, dimension, here);
}

TEST(Quantity, HasTheBitsOfTheSameNumberInSi) {
  EXPECT_EQ(quantity("20 mm", Dimension::length), 0.020);
  EXPECT_EQ(quantity("22mm", Dimension::length), 0.022);
  EXPECT_EQ(quantity("5.04 mm", Dimension::length), 5.04e-3);
  EXPECT_EQ(quantity("0.5044mm", Dimension::length), 0.5044e-3);
  EXPECT_EQ(quantity("1.529 um", Dimension::length), 1.529e-6);
  EXPECT_EQ(quantity("1.529 \u00b5m", Dimension::length), 1.529e-6);
  EXPECT_EQ(quantity("1.529 \u03bcm", Dimension::length), 1.529e-6);
  EXPECT_EQ(quantity("15 cm", Dimension::length), 0.15);
  EXPECT_EQ(quantity("400 mm2", Dimension::area), 400e-6);
  EXPECT_EQ(quantity("400 mm^2", Dimension::area), 400e-6);
  EXPECT_EQ(quantity("400 mm\u00b2", Dimension::area), 400e-6);
  EXPECT_EQ(quantity("2 MPa", Dimension::stress), 2e6);
  EXPECT_EQ(quantity("0.3 N/mm2", Dimension::stress), 0.3e6);
  EXPECT_EQ(quantity("12 bar", Dimension::stress), 1.2e6);
  EXPECT_NEAR(quantity("1000 psi", Dimension::stress), 6.894757e6, 1.0);  // NIST SP 811, appendix B, seven digits
  EXPECT_EQ(quantity("2 in", Dimension::length), 0.0508);
  EXPECT_EQ(quantity("2.195e7 N/m", Dimension::stiffness), 2.195e7);
  EXPECT_EQ(quantity("21.95 MN/m", Dimension::stiffness), 21.95e6);
  EXPECT_EQ(quantity("2200 kg/m3", Dimension::density), 2200.0);
  EXPECT_EQ(quantity("2.2 g/cm3", Dimension::density), 2200.0);
  EXPECT_EQ(quantity("2.2 g/cm\u00b3", Dimension::density), 2200.0);
  EXPECT_EQ(quantity("5 ms", Dimension::time), 5e-3);
  EXPECT_EQ(quantity("2 min", Dimension::time), 120.0);
  EXPECT_EQ(quantity("0.5 1/s", Dimension::rate), 0.5);
  EXPECT_EQ(quantity("0.5 /s", Dimension::rate), 0.5);
  EXPECT_EQ(quantity("0.5/s", Dimension::rate), 0.5);
  EXPECT_EQ(quantity("50 %/s", Dimension::rate), 0.5);
  EXPECT_EQ(quantity("0.5 s^-1", Dimension::rate), 0.5);
  EXPECT_EQ(quantity("25 %", Dimension::ratio), 0.25);
  EXPECT_EQ(quantity("25%", Dimension::ratio), 0.25);
  EXPECT_EQ(quantity("0.25", Dimension::ratio), 0.25);
  EXPECT_DOUBLE_EQ(quantity("180 deg", Dimension::angle), std::numbers::pi);
  EXPECT_DOUBLE_EQ(quantity("180\u00b0", Dimension::angle), std::numbers::pi);
}

TEST(Quantity, TakesNumbersAsTheyAreCommonlyWritten) {
  EXPECT_EQ(quantity("  +20   mm ", Dimension::length), 0.020);
  EXPECT_EQ(quantity("-20 mm", Dimension::length), -0.020);
  EXPECT_EQ(quantity(".5 m", Dimension::length), 0.5);
  EXPECT_EQ(quantity("5. m", Dimension::length), 5.0);
  EXPECT_EQ(quantity("2E-2m", Dimension::length), 0.02);
  EXPECT_EQ(quantity("2e+1mm", Dimension::length), 0.02);
  EXPECT_EQ(parse_quantity({std::int64_t{3}}, Dimension::length, here), 3.0);
  EXPECT_EQ(parse_quantity({0.25}, Dimension::none, here), 0.25);
}

TEST(Quantity, UnitOfAnotherDimensionListsTheAcceptedOnes) {
  const std::string said = input_error([] { quantity("20 kg", Dimension::length); });
  EXPECT_EQ(said, "a.toml:3: s.k: \"kg\" in \"20 kg\" is no unit of a length; accepted are m, cm, mm, um, nm");
  EXPECT_THAT(input_error([] { quantity("2 mpa", Dimension::stress); }), HasSubstr("did you mean \"MPa\"?"));
  EXPECT_THAT(input_error([] { quantity("2 kg", Dimension::ratio); }), HasSubstr("accepted are % or no unit"));
  EXPECT_THAT(input_error([] { quantity("2,5 mm", Dimension::length); }),
              EndsWith("has a comma; write a decimal point"));
  EXPECT_THAT(input_error([] { quantity("0.2,0.3", Dimension::ratio); }), EndsWith("a list in brackets: [0.2,0.3]"));
  EXPECT_THAT(input_error([] { quantity("5mm,3mm", Dimension::length); }), HasSubstr("a list stands in brackets"));
}

TEST(Quantity, WithoutUnitSaysHowToWriteIt) {
  const std::string said = input_error([] { quantity("20", Dimension::length); });
  EXPECT_THAT(said, HasSubstr("the text \"20\" has no unit"));
  EXPECT_THAT(said, HasSubstr("write the number without quotes for m"));
}

TEST(Quantity, WrongKindsSayWhatWasFoundAndWhatIsWanted) {
  EXPECT_THAT(input_error([] { quantity("wide", Dimension::length); }),
              HasSubstr("found the text \"wide\"; a length is wanted: a number in m or a text such as \"20 mm\""));
  EXPECT_THAT(input_error([] { quantity("3", Dimension::none); }), HasSubstr("write the number without quotes"));
  EXPECT_THAT(input_error([] { parse_quantity({true}, Dimension::length, here); }),
              HasSubstr("found the truth value true"));
  EXPECT_THAT(input_error([] { parse_quantity({ValueList{}}, Dimension::length, here); }),
              HasSubstr("found an empty list"));
}

TEST(Quantity, RefusesWhatIsNoFiniteNumber) {
  for (const double bad : {std::nan(""), HUGE_VAL, -HUGE_VAL})
    EXPECT_THAT(input_error([bad] { parse_quantity({bad}, Dimension::length, here); }), HasSubstr("a finite number"));
  for (const char* bad : {"nan mm", "inf mm", "-inf m", "1e400 m", "1e99999999999 m", "1e308 GPa"}) {
    const Dimension dimension =
        std::string(bad).find("Pa") != std::string::npos ? Dimension::stress : Dimension::length;
    EXPECT_THAT(input_error([&] { quantity(bad, dimension); }), HasSubstr("a.toml:3: s.k: "));
  }
}

TEST(Quantity,
     AgreesWithSiForRandomDecimals) {  // "x mm" must be the double nearest to the decimal x e-3, as strtod reads it
  std::mt19937_64 random(1);
  std::uniform_int_distribution<long> mantissa(-999999999, 999999999);
  std::uniform_int_distribution<int> exponent(-30, 30);
  for (int k = 0; k < 2000; ++k) {
    const std::string digits = std::to_string(mantissa(random));
    const int e = exponent(random);
    const double expected = std::strtod((digits + "e" + std::to_string(e - 3)).c_str(), nullptr);
    EXPECT_EQ(quantity(digits + "e" + std::to_string(e) + " mm", Dimension::length), expected);
  }
}

TEST(Units, EachDimensionWithUnitsListsItsSiUnit) {
  for (const Dimension dimension : {Dimension::length, Dimension::area, Dimension::stress, Dimension::stiffness,
                                    Dimension::density, Dimension::time, Dimension::rate, Dimension::angle}) {
    EXPECT_THAT(accepted_units(dimension), HasSubstr(std::string(si_unit(dimension))));
    EXPECT_EQ(quantity("1 " + std::string(si_unit(dimension)), dimension), 1.0);
  }
  EXPECT_EQ(si_unit(Dimension::none), "");
  EXPECT_EQ(si_unit(Dimension::ratio), "");
}

}  // namespace
}  // namespace perfora::io
