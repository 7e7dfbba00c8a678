// What is here: what a run says is so: stresses stand at their strains, the run ends where it was told to, frames and
// samples change nothing, the frame of the first peak is at it, the ledger closes for very unequal discs. Expected
// values: linear elasticity, the request itself, conservation of energy. What is not: the path (test_loading_rate.cpp).
#include <gtest/gtest.h>

#include <cmath>

#include "optimize/evaluate/elastic_response.h"
#include "optimize/evaluate/evaluation.h"
#include "results/run_file.h"
#include "tests/optimize/evaluate/design_support.h"

namespace perfora::optimize {
namespace {

class TruthOfARun : public testing::Test {
 protected:
  Evaluation evaluate(const std::vector<std::string>& overrides, const std::filesystem::path& run_file = {}) const {
    DesignFile design(folder.file("design.toml", small_design), overrides);
    EvaluateOptions options;
    options.run_file = run_file;
    return evaluate_design(design, options, 0);
  }
  const DesignFolder folder;
};

// 0.0123 lies neither on a sample nor on a segment.
TEST_F(TruthOfARun, EndsAtTheStrainAskedFor) {
  for (const char* control : {"loading.rate=40", "loading.rate=0"})
    for (const char* interval : {"output.history_interval=5e-4", "output.history_interval=0.1"}) {
      const Evaluation run = evaluate({"loading.until=0.0123", control, interval, "loading.transits=2"});
      EXPECT_NEAR(run.summary.final_strain, 0.0123, 1e-15) << control << interval;
      EXPECT_EQ(run.curve.strain_yy.back(), run.summary.final_strain);
      EXPECT_EQ(run.reason, "reached strain 0.0123");
    }
}

TEST_F(TruthOfARun, WhatIsWrittenChangesNoResult) {
  const Evaluation plain = evaluate({"loading.rate=0", "loading.transits=5", "loading.until=0.04"});
  ASSERT_GT(plain.summary.broken_bonds, 50);
  ASSERT_FALSE(std::isnan(plain.summary.first_peak_stress));
  for (const char* output : {"output.history_interval=0.003", "output.history_interval=1.7e-4",
                             "output.history_interval=0.1", "output.frames=all", "output.frame_strains=[0.00123]"}) {
    const Evaluation other =
        evaluate({"loading.rate=0", "loading.transits=5", "loading.until=0.04", output}, folder / "other.h5");
    std::filesystem::remove(folder / "other.h5");
    EXPECT_EQ(other.summary.broken_bonds, plain.summary.broken_bonds) << output;
    EXPECT_EQ(other.summary.steps, plain.summary.steps) << output;
    EXPECT_EQ(other.summary.first_peak_stress, plain.summary.first_peak_stress) << output;
    EXPECT_EQ(other.summary.first_peak_strain, plain.summary.first_peak_strain) << output;
    EXPECT_EQ(other.summary.kinetic_ratio_at_peak, plain.summary.kinetic_ratio_at_peak) << output;
    EXPECT_EQ(other.curve.external_work.back(), plain.curve.external_work.back()) << output;
  }
}

// Bonds that never break make a linear block: stress over strain is its oedometric modulus, as the elastic response
// gives it without a run, from the first sample on (a mean that stood at its end would give half of it there). The rate
// is slow enough that waves move it by less than the tolerance: 200 transits before the strain at which Table 1's block
// has its peak.
TEST_F(TruthOfARun, TheFirstModulusIsThatOfTheBlock) {
  const Evaluation run = evaluate({"loading.rate=0", "loading.transits=200", "loading.until=0.004",
                                   "material.critical_normal_displacement=1", "material.critical_shear_displacement=1",
                                   "loading.control=constant", "loading.rate=1.5"});
  ASSERT_EQ(run.summary.broken_bonds, 0);
  const auto modulus = [&](std::size_t k) { return run.curve.stress_yy[k] / run.curve.strain_yy[k]; };
  const std::size_t inside = run.curve.rows() - 2;  // the last sample's mean reaches back only
  const double wanted = elastic_response(DesignFile(folder / "design.toml"), {}, 0).response.stiffness[1][1];
  for (std::size_t k = 1; k < inside; ++k) EXPECT_NEAR(modulus(k), wanted, 0.03 * wanted) << k;
}

TEST_F(TruthOfARun, AFrameStandsAtTheFirstPeak) {
  const std::filesystem::path file = folder / "run.h5";
  const Evaluation run =
      evaluate({"loading.rate=0", "loading.transits=5", "loading.until=0.04", "output.frames=all"}, file);
  ASSERT_FALSE(std::isnan(run.summary.first_peak_strain));
  const results::RunResult result = results::read_run(file);
  double nearest = 1.0, last = -1.0;
  for (const results::FrameInfo& frame : result.frames) {
    EXPECT_GT(frame.strain, last);
    last = frame.strain;
    nearest = std::min(nearest, std::abs(frame.strain - run.summary.first_peak_strain));
  }
  EXPECT_EQ(result.frames.size(), 6u);  // 0, 1, 2, 3, 4 % and the peak
  EXPECT_LE(nearest, 2.0 * 6.25e-5);    // a frame is taken at the end of the segment (6.25e-5) of largest mean stress
}

// Discs of 0.15 to 3 mm: a large disc has some 25 neighbours in contact. External work equals the sum of all energies.
TEST_F(TruthOfARun, TheLedgerClosesForVeryUnequalDiscs) {
  const Evaluation run = evaluate(
      {"cell.width=24 mm", "cell.height=24 mm", "layout.diameter=10 mm", "packing.maximum_diameter=3 mm",
       "packing.mean_diameter=0.6 mm", "packing.size_ratio=20", "packing.solid_fraction=0.78", "material.horizon=2",
       "loading.rate=0", "loading.transits=2", "loading.until=0.2", "loading.impact_ratio=1"});
  ASSERT_EQ(run.status, results::RunStatus::completed) << run.reason;
  EXPECT_LT(run.summary.energy_residual, 0.02);
}

}  // namespace
}  // namespace perfora::optimize
