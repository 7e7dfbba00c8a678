// What is here: numbers as people read them. Expected texts: written out by hand.
#include <gtest/gtest.h>

#include <cmath>

#include "app/summary_text.h"

namespace perfora::app {
namespace {

TEST(SummaryText, CountsHaveThousands) {
  EXPECT_EQ(with_thousands(0), "0");
  EXPECT_EQ(with_thousands(999), "999");
  EXPECT_EQ(with_thousands(1000), "1,000");
  EXPECT_EQ(with_thousands(36607), "36,607");
  EXPECT_EQ(with_thousands(-1234567), "-1,234,567");
  EXPECT_EQ(with_thousands(NAN), "?");
}

TEST(SummaryText, StressesLengthsMemoryTakeTheirUnits) {
  EXPECT_EQ(stress_text(12.0), "12 Pa");
  EXPECT_EQ(stress_text(653400.0), "653.4 kPa");
  EXPECT_EQ(stress_text(1.5e6), "1.5 MPa");
  EXPECT_EQ(stress_text(-2e9), "-2 GPa");
  EXPECT_EQ(length_text(0.5044e-3), "0.5044 mm");
  EXPECT_EQ(length_text(1.529e-6), "1.529 um");
  EXPECT_EQ(length_text(2.0), "2 m");
  EXPECT_EQ(memory_text(1.2e9), "1.2 GB");
  EXPECT_EQ(memory_text(46.9e6), "46.9 MB");
}

TEST(SummaryText, DurationsReadLikeAClock) {
  EXPECT_EQ(duration_text(0.5), "0.5 s");
  EXPECT_EQ(duration_text(45.0), "45 s");
  EXPECT_EQ(duration_text(200.0), "3 min 20 s");
  EXPECT_EQ(duration_text(7500.0), "2 h 05 min");
  EXPECT_EQ(duration_text(14.0 * 86400.0 + 3.0 * 3600.0), "14 d 3 h");
}

TEST(SummaryText, SaysWhatWasNotReached) {
  const nlohmann::json record = {
      {"schema", "perfora.evaluate/1"}, {"status", "stopped"},      {"reason", "signal"},
      {"plateau_stress", nullptr},      {"perforations", 0},        {"thinnest_wall", nullptr},
      {"first_peak_stress", 653400.0},  {"first_peak_strain", 0.01}};
  const std::string text = summary_text(record);
  EXPECT_NE(text.find("stopped: signal"), std::string::npos);
  EXPECT_NE(text.find("653.4 kPa"), std::string::npos);
  EXPECT_NE(text.find("1 %"), std::string::npos);
  EXPECT_NE(text.find("not reached"), std::string::npos);
  EXPECT_EQ(text.find("thinnest wall"), std::string::npos) << "there is none to speak of";
}

}  // namespace
}  // namespace perfora::app
