// What is here: statistics over replicates and the folder of an ensemble. Expected numbers: textbook values of
// Student's t, sums worked out by hand.
#include "optimize/campaign/ensemble.h"

#include <gmock/gmock.h>

#include <cmath>
#include <limits>

#include "io/files.h"
#include "io/journal.h"
#include "tests/optimize/evaluate/design_support.h"

namespace perfora::optimize {
namespace {

using ::testing::HasSubstr;
constexpr double nan = std::numeric_limits<double>::quiet_NaN();

class Ensembles : public ::testing::Test {
 protected:
  DesignFile design(const std::vector<std::string>& overrides = {}) const {
    return DesignFile(folder_.file("design.toml", small_design), overrides);
  }
  EnsembleOptions options(int replicates) {
    EnsembleOptions result;
    result.folder = folder_ / "ensemble";
    result.replicates = replicates;
    result.finished = [this](const Evaluation& evaluation, const std::filesystem::path&, bool kept) {
      log_ += (kept ? "kept " : "made ") + std::to_string(evaluation.replicate) + ";";
    };
    return result;
  }
  DesignFolder folder_;
  std::string log_;
};

TEST_F(Ensembles, GrowAndKeepWhatIsFinished) {
  const DesignFile file = design();
  const Ensemble two = evaluate_ensemble(file, options(2));
  EXPECT_EQ(two.status, results::RunStatus::completed);
  EXPECT_TRUE(std::filesystem::exists(folder_ / "ensemble/replicate-001.h5"));
  EnsembleOptions more = options(3);
  more.resume = true;
  const Ensemble three = evaluate_ensemble(file, more);
  EXPECT_EQ(log_, "made 0;made 1;kept 0;kept 1;made 2;");
  ASSERT_EQ(three.replicates.size(), 3u);
  EXPECT_EQ(three.statistics.front().name, "plateau_stress");
  double sum = 0.0;
  for (const Evaluation& evaluation : three.replicates) sum += evaluation.summary.plateau_stress;
  EXPECT_NEAR(three.statistics.front().mean, sum / 3.0, 1e-9 * std::fabs(sum));
  // Each replicate is what one evaluation gives.
  EXPECT_EQ(three.replicates[1].summary.plateau_stress, evaluate_design(file, {}, 1).summary.plateau_stress);
  EXPECT_EQ(nlohmann::json::parse(io::read_file(folder_ / "ensemble/ensemble.json")), to_json(three));
}

TEST_F(Ensembles, AnotherDesignIsRefused) {
  evaluate_ensemble(design(), options(1));
  EnsembleOptions again = options(1);
  EXPECT_THAT(complaint([&] { evaluate_ensemble(design(), again); }), HasSubstr("--resume"));
  again.resume = true;
  EXPECT_THAT(complaint([&] { evaluate_ensemble(design({"layout.diameter=5 mm"}), again); }),
              HasSubstr("another design"));
  again.resume = false;
  again.force = true;
  evaluate_ensemble(design({"layout.diameter=5 mm"}), again);
  EXPECT_EQ(log_, "made 0;made 0;");
}

TEST_F(Ensembles, OnesStoppedGoOn) {
  EnsembleOptions stopping = options(2);
  stopping.evaluate.wall_time_limit = 1e-9;
  const Ensemble stopped = evaluate_ensemble(design(), stopping);
  EXPECT_EQ(stopped.status, results::RunStatus::stopped);
  EXPECT_TRUE(stopped.replicates.empty());
  EnsembleOptions resuming = options(2);
  resuming.resume = true;
  EXPECT_EQ(evaluate_ensemble(design(), resuming).replicates.size(), 2u);
}

TEST_F(Ensembles, FilesOfSomebodyElseAreLeftAlone) {
  std::filesystem::create_directory(folder_ / "ensemble");
  folder_.file("ensemble/thesis.txt", "mine");
  folder_.file("ensemble/replicate-007.h5", "somebody's");
  EXPECT_THAT(complaint([&] { evaluate_ensemble(design(), options(1)); }), HasSubstr("would overwrite"));
  EnsembleOptions forced = options(1);
  forced.force = true;
  evaluate_ensemble(design(), forced);
  EXPECT_EQ(io::read_file(folder_ / "ensemble/thesis.txt"), "mine");
  EXPECT_FALSE(std::filesystem::exists(folder_ / "ensemble/replicate-007.h5"));
}

}  // namespace
}  // namespace perfora::optimize
