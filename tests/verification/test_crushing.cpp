// What is here: whole crushing runs of a small perforated cell: the ledger, and that the first peak does not hang on
// step, rate or mass scaling. What is not: closed forms of two discs (the other files of this folder).
#include <map>
#include <ostream>
#include <string>
#include <utility>
#include <vector>

#include "tests/verification/blocks.h"
#include "tests/verification/checks.h"

namespace perfora::verification {
namespace {

/// rows x rows holes as wide as four fifths of their pitch, Table 1's pattern: 20 mm at 25 mm is Table 1 itself.
Block perforated(double pitch, int rows, std::uint64_t seed) {
  return make_block(holes(rows * pitch, rows * pitch, 0.8 * pitch, rows, rows), seed);
}

class Ledger : public ::testing::TestWithParam<std::uint64_t> {};

// 60 % strain through peak, rubble and re-contact: |external work - sum of all parts| stays below 0.5 % of the work:
// half of the 1 % that is commonly asked of an explicit scheme, as every part is summed from its own force.
TEST_P(Ledger, ClosesOverCrushing) {
  solver::SolverOptions options;
  options.loading.until = 0.60;
  options.loading.transits = 6.0;  // fast: more kinetic energy than a user's run, a harder case
  const solver::Response r = crush(perforated(thorough ? 25e-3 : 12.5e-3, 1, GetParam()), options);
  ASSERT_EQ(r.summary.status, solver::RunStatus::completed) << r.summary.reason;
  EXPECT_GT(r.summary.broken_bonds, r.bonds / 20);
  expect_at_most("residual over largest work, seed " + std::to_string(GetParam()), r.summary.energy_residual, 0.005);
}
INSTANTIATE_TEST_SUITE_P(, Ledger, ::testing::Values(1, 2, 3));

struct PeakCase {
  int rows = 1;  ///< of Table 1's holes, as many columns
  std::uint64_t seed = 1;
};
void PrintTo(const PeakCase& c, std::ostream* out) {
  *out << c.rows << " x " << c.rows << " holes, seed " << c.seed;
}

/// What does not hold so far (docs/verification.md) went up to 7 %; more than this would be something else.
constexpr double largest_known = 0.15;

class FirstPeak : public ::testing::TestWithParam<PeakCase> {
 protected:
  static std::string at() { return ", " + ::testing::PrintToString(GetParam()); }
  /// Options for a run that ends behind the first peak of Table 1's cell (at 0.6 to 1.0 %).
  static solver::SolverOptions to_the_peak() {
    solver::SolverOptions options;
    options.loading.until = 0.025;
    options.output.history_interval = 1e-4;
    return options;
  }
  /// First peak of this packing over that of the default options, less 1.
  static double change(const solver::SolverOptions& options) {
    const Block block = perforated(25e-3, GetParam().rows, GetParam().seed);
    static std::map<std::pair<int, std::uint64_t>, double> defaults;
    double& peak = defaults[{GetParam().rows, GetParam().seed}];
    if (peak == 0.0) peak = crush(block, to_the_peak()).summary.first_peak_stress;
    return crush(block, options).summary.first_peak_stress / peak - 1.0;
  }
};

// Halving the step, the rate, or taking physical masses moves the first peak of the same packing by less than 2 %: well
// below the scatter between packings, so that a comparison of designs does not hang on them.
TEST_P(FirstPeak, DoesNotHangOnTheStep) {
  solver::SolverOptions options = to_the_peak();
  options.dynamics.step_factor *= 0.5;
  expect_at_most("change of the first peak on half the step" + at(), change(options), 0.02);
}

TEST_P(FirstPeak, DoesNotHangOnTheRate) {
  solver::SolverOptions options = to_the_peak();
  options.loading.transits *= 2.0;
  const double found = change(options);
  EXPECT_LT(std::fabs(found), largest_known) << "worse than what is known not to hold";
  if (!holds_so_far("change of the first peak at half the rate" + at(), found, 0.02)) GTEST_SKIP() << known_not_to_hold;
}

TEST_P(FirstPeak, DoesNotHangOnMassScaling) {
  solver::SolverOptions options = to_the_peak();
  options.dynamics.mass = solver::MassScaling::physical;
  const double found = change(options);
  EXPECT_LT(std::fabs(found), largest_known) << "worse than what is known not to hold";
  if (!holds_so_far("change of the first peak with physical masses" + at(), found, 0.02))
    GTEST_SKIP() << known_not_to_hold;
}
INSTANTIATE_TEST_SUITE_P(, FirstPeak,
                         ::testing::ValuesIn(thorough ? std::vector<PeakCase>{{1, 1}, {1, 2}, {1, 3}, {2, 1}}
                                                      : std::vector<PeakCase>{{1, 1}}));

}  // namespace
}  // namespace perfora::verification
