// What is here: every file of designs/ read and checked as what it is. What is not: what the designs give.
#include <gtest/gtest.h>

#include <filesystem>

#include "optimize/campaign/tolerance.h"
#include "optimize/search/calibration.h"
#include "optimize/search/study.h"
#include "results/describe.h"
#include "tests/optimize/evaluate/design_support.h"

namespace perfora::optimize {
namespace {

const std::filesystem::path designs = std::filesystem::path(PERFORA_SOURCE_DIR) / "designs";

TEST(ExampleDesigns, EveryFileOfTheFolderIsValid) {
  int found = 0;
  for (const auto& entry : std::filesystem::directory_iterator(designs)) {
    if (entry.path().extension() != ".toml") continue;
    ++found;
    const auto check = [&] {
      const std::string kind = results::kind_of_toml(entry.path());
      if (kind == "study")
        static_cast<void>(read_study(entry.path()));
      else if (kind == "sweep")
        for (const SweepCase& one : read_sweep(entry.path()).cases) EXPECT_EQ(one.problem, "") << entry.path();
      else if (kind == "tolerance")
        for (const SweepCase& one : read_tolerance(entry.path()).sweep.cases) EXPECT_EQ(one.problem, "") << entry.path();
      else if (kind == "calibration")
        static_cast<void>(read_calibration(entry.path(), {}));
      else
        static_cast<void>(DesignFile(entry.path()).validate());
    };
    EXPECT_EQ(complaint(check), "") << entry.path();
  }
  EXPECT_GE(found, 14);
}

}  // namespace
}  // namespace perfora::optimize
