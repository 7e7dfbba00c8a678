// What is here: how a check says what it measured, what was expected and within what: printed, and written for
// docs/developer/verification.md when asked. What is not: the checks.
#pragma once

#include <gtest/gtest.h>

#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <string>
#include <vector>

namespace perfora::verification {

/// Compiled into the slow programs: more seeds, larger cells, finer series.
#ifdef PERFORA_VERIFICATION_THOROUGH
inline constexpr bool thorough = true;
#else
inline constexpr bool thorough = false;
#endif

/// Folder for docs/data/verification, from the environment; empty: nothing is written.
inline std::filesystem::path data_folder() {
  const char* folder = std::getenv("PERFORA_VERIFICATION_DATA");
  return folder != nullptr ? folder : "";
}

/// One line of the document: "group | what | measured | expected | tolerance | holds".
inline void record(const std::string& what, double measured, const std::string& expected, bool holds) {
  const std::string group = ::testing::UnitTest::GetInstance()->current_test_info() != nullptr
                                ? ::testing::UnitTest::GetInstance()->current_test_info()->test_suite_name()
                                : "";
  char value[32];
  std::snprintf(value, sizeof value, "%.6g", measured);
  std::printf("CHECK %s | %s | %s | %s | %s\n", group.c_str(), what.c_str(), value, expected.c_str(),
              holds ? "holds" : "DOES NOT HOLD");
  if (const auto folder = data_folder(); !folder.empty()) {
    std::filesystem::create_directories(folder);
    std::ofstream(folder / "checks.txt", std::ios::app)
        << group << " | " << what << " | " << value << " | " << expected << " | " << (holds ? "yes" : "**no**") << '\n';
  }
}

inline std::string short_text(double value) {
  char text[32];
  std::snprintf(text, sizeof text, "%.5g", value);
  return text;
}

/// measured = expected +- tolerance (absolute).
inline void expect_close(const std::string& what, double measured, double expected, double tolerance) {
  const bool holds = std::fabs(measured - expected) <= tolerance;
  record(what, measured, short_text(expected) + " +- " + short_text(tolerance), holds);
  EXPECT_TRUE(holds) << what << ": " << measured << ", expected " << expected << " +- " << tolerance;
}

/// |measured| <= limit.
inline void expect_at_most(const std::string& what, double measured, double limit) {
  const bool holds = std::fabs(measured) <= limit;
  record(what, measured, "at most " + short_text(limit), holds);
  EXPECT_TRUE(holds) << what << ": " << measured << ", at most " << limit;
}

inline void expect_between(const std::string& what, double measured, double low, double high) {
  const bool holds = measured >= low && measured <= high;
  record(what, measured, short_text(low) + " to " + short_text(high), holds);
  EXPECT_TRUE(holds) << what << ": " << measured << ", expected " << low << " to " << high;
}

/// |measured| <= limit of a check that is known not to hold (docs/developer/verification.md says why): recorded as it
/// is. A test with such a check shows as skipped, with this sentence, so that it stays in sight.
inline bool holds_so_far(const std::string& what, double measured, double limit) {
  const bool holds = std::fabs(measured) <= limit;
  record(what, measured, "at most " + short_text(limit), holds);
  return holds;
}
inline constexpr const char* known_not_to_hold =
    "does not hold: see docs/developer/verification.md, \"What does not hold\"";

/// A table of numbers for a picture: DATA/name.csv, one header line. Nothing without PERFORA_VERIFICATION_DATA.
inline void write_table(const std::string& name, const std::vector<std::string>& columns,
                        const std::vector<std::vector<double>>& rows) {
  const auto folder = data_folder();
  if (folder.empty()) return;
  std::filesystem::create_directories(folder);
  std::ofstream file(folder / (name + ".csv"));
  for (std::size_t k = 0; k < columns.size(); ++k) file << (k ? "," : "") << columns[k];
  file << '\n';
  for (const auto& row : rows) {
    for (std::size_t k = 0; k < row.size(); ++k) {
      char text[32];
      std::snprintf(text, sizeof text, "%.8g", row[k]);
      file << (k ? "," : "") << text;
    }
    file << '\n';
  }
}

}  // namespace perfora::verification
