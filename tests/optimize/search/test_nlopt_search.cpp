// What is here: NLopt by replay against NLopt called straight through its C interface; its traps. Expected numbers are
// closed-form minima. What is not: designs, journals (test_driver.cpp, test_study_run.cpp).
#include <gtest/gtest.h>
#include <nlopt.h>

#include <cmath>
#include <map>
#include <stdexcept>

#include "optimize/search/nlopt_search.h"

namespace {

using namespace perfora::optimize;
using Point = std::vector<double>;

/// Smooth, one minimum (value 0) at 0.3, 0.4, 0.5, ...
double bowl(const Point& x) {
  double sum = 0.0;
  for (std::size_t k = 0; k < x.size(); ++k) sum += std::pow(x[k] - 0.3 - 0.1 * static_cast<double>(k), 2);
  return sum;
}

/// The same with a region where evaluations fail: the finite penalty of a failure stands there.
double with_failures(const Point& x) {
  return x[0] > 0.6 && x[0] < 0.8 ? 750.0 : bowl(x);
}
/// A cliff of constraint penalties.
double with_cliff(const Point& x) {
  return bowl(x) < 0.05 ? bowl(x) : 1000.0 * (1.0 + bowl(x));
}
double constant(const Point&) {
  return 1.0;
}
double steps(const Point& x) {
  return std::floor(10.0 * bowl(x));
}

using Function = double (*)(const Point&);
const std::map<std::string, Function> functions{
    {"bowl", bowl}, {"failures", with_failures}, {"cliff", with_cliff}, {"constant", constant}, {"steps", steps}};

SearchOptions options_for(const std::string& algorithm, int dimension, int maxeval) {
  SearchOptions options;
  options.algorithm = algorithm;
  options.dimension = dimension;
  options.maxeval = maxeval;
  options.seed = 12345;
  options.start.assign(static_cast<std::size_t>(dimension), 0.45);
  return options;
}

struct Straight {
  Function function;
  std::vector<Point> points;
};

double straight_callback(unsigned n, const double* x, double*, void* data) {
  auto& straight = *static_cast<Straight*>(data);
  straight.points.emplace_back(x, x + n);
  return straight.function(straight.points.back());
}

/// The points NLopt asks for when nothing stands between it and the function.
std::vector<Point> straight_points(const SearchOptions& options, Function function) {
  Straight straight{function, {}};
  const auto n = static_cast<unsigned>(options.dimension);
  nlopt_opt search = nlopt_create(nlopt_algorithm_from_string(options.algorithm.c_str()), n);
  nlopt_set_lower_bounds1(search, 0.0);
  nlopt_set_upper_bounds1(search, 1.0);
  nlopt_set_maxeval(search, options.maxeval);
  nlopt_set_min_objective(search, straight_callback, &straight);
  if (options.algorithm.rfind("LN_", 0) == 0) nlopt_set_initial_step1(search, options.initial_step);
  nlopt_opt inner = nullptr;
  if (options.algorithm.rfind("GN_MLSL", 0) == 0 || options.algorithm.rfind("LN_AUGLAG", 0) == 0) {
    inner = nlopt_create(NLOPT_LN_SBPLX, n);
    nlopt_set_xtol_rel(inner, 1e-3);
    nlopt_set_maxeval(inner, options.maxeval);
    nlopt_set_local_optimizer(search, inner);
  }
  nlopt_srand(options.seed);
  Point x = options.start;
  double best = 0.0;
  nlopt_optimize(search, x.data(), &best);
  if (inner) nlopt_destroy(inner);
  nlopt_destroy(search);
  if (straight.points.size() > static_cast<std::size_t>(options.maxeval))
    straight.points.resize(static_cast<std::size_t>(options.maxeval));
  return straight.points;
}

/// The points of a search that learns one value a call of run_search.
std::vector<Point> replayed_points(const SearchOptions& options, Function function) {
  std::map<Point, double> known;
  std::vector<Point> points;
  for (int call = 0; call <= options.maxeval + 1; ++call) {
    points.clear();
    std::optional<Point> unknown;
    const SearchEnd end = run_search(options, [&](std::span<const double> x) -> std::optional<double> {
      points.emplace_back(x.begin(), x.end());
      const auto found = known.find(points.back());
      if (found != known.end()) return found->second;
      EXPECT_FALSE(unknown) << "asked again after an unknown point";
      unknown = points.back();
      return std::nullopt;
    });
    EXPECT_EQ(end.finished, !unknown);
    if (end.finished) return points;
    known[*unknown] = function(*unknown);
  }
  ADD_FAILURE() << "did not finish";
  return points;
}

struct Case {
  std::string algorithm;
  int dimension;
};

std::vector<Case> cases() {
  std::vector<Case> all;
  for (const std::string& name : derivative_free_algorithms())
    for (int dimension = smallest_dimension(name); dimension <= 3; ++dimension) all.push_back({name, dimension});
  return all;
}

class EveryAlgorithm : public testing::TestWithParam<Case> {};

TEST_P(EveryAlgorithm, ReplayGivesTheStraightTrajectory) {
  for (const auto& [name, function] : functions) {
    const SearchOptions options = options_for(GetParam().algorithm, GetParam().dimension, 60);
    const auto straight = straight_points(options, function);
    ASSERT_FALSE(straight.empty());
    EXPECT_EQ(replayed_points(options, function), straight) << name;
  }
}

TEST_P(EveryAlgorithm, NeverAsksForMoreThanMaxeval) {
  for (const int maxeval : {1, 2, 7, 25}) {
    const SearchOptions options = options_for(GetParam().algorithm, GetParam().dimension, maxeval);
    int calls = 0;
    const SearchEnd end = run_search(options, [&](std::span<const double> x) -> std::optional<double> {
      ++calls;
      return bowl({x.begin(), x.end()});
    });
    EXPECT_TRUE(end.finished);
    EXPECT_FALSE(end.reason.empty());
    EXPECT_LE(calls, maxeval);
    EXPECT_GE(calls, 1);
  }
}

TEST_P(EveryAlgorithm, ThrowsOurExceptionOnWithItsMessage) {
  for (const int at : {1, 5, 20}) {
    int calls = 0;
    const Objective objective = [&](std::span<const double> x) -> std::optional<double> {
      if (++calls == at) throw std::out_of_range("our own words");
      return bowl({x.begin(), x.end()});
    };
    try {
      run_search(options_for(GetParam().algorithm, GetParam().dimension, 40), objective);
      FAIL() << "nothing was thrown";
    } catch (const std::out_of_range& error) {
      EXPECT_STREQ(error.what(), "our own words");
    }
    EXPECT_EQ(calls, at);
  }
}

INSTANTIATE_TEST_SUITE_P(NLopt, EveryAlgorithm, testing::ValuesIn(cases()),
                         [](const testing::TestParamInfo<Case>& instance) {
                           return instance.param.algorithm + "_" + std::to_string(instance.param.dimension);
                         });

TEST(NloptSearch, ListsTheAlgorithmsThatWereAskedFor) {
  const auto& names = derivative_free_algorithms();
  for (const char* name : {"GN_DIRECT_L", "GN_CRS2_LM", "GN_ISRES", "LN_SBPLX", "LN_COBYLA", "LN_BOBYQA", "GN_ESCH",
                           "LN_NELDERMEAD", "LN_NEWUOA_BOUND", "GN_AGS"})
    EXPECT_NE(std::find(names.begin(), names.end(), name), names.end()) << name;
}

TEST(NloptSearch, TakesNamesWithAndWithoutPrefixAndRefusesTheRest) {
  std::string problem;
  EXPECT_EQ(canonical_algorithm("GN_DIRECT_L", problem), "GN_DIRECT_L");
  EXPECT_EQ(canonical_algorithm("NLOPT_LN_SBPLX", problem), "LN_SBPLX");
  EXPECT_EQ(canonical_algorithm("ln_cobyla", problem), "LN_COBYLA");
  for (const auto& [name, clause] : std::map<std::string, std::string>{{"LD_LBFGS", "needs gradients"},
                                                                       {"NLOPT_LD_MMA", "needs gradients"},
                                                                       {"GD_STOGO", "needs gradients"},
                                                                       {"LN_NEWUOA", "keeps no bounds"},
                                                                       {"G_MLSL_LDS", "use GN_MLSL_LDS"},
                                                                       {"AUGLAG", "use LN_AUGLAG"},
                                                                       {"SIMPLEX", "has no algorithm"},
                                                                       {"", "has no algorithm"}}) {
    problem.clear();
    EXPECT_EQ(canonical_algorithm(name, problem), "") << name;
    EXPECT_NE(problem.find(clause), std::string::npos) << name << ": " << problem;
  }
}

/// Lowest value seen, which is what the driver keeps.
double lowest(const SearchOptions& options, Function function) {
  double best = HUGE_VAL;
  run_search(options, [&](std::span<const double> x) -> std::optional<double> {
    const double value = function({x.begin(), x.end()});
    best = std::min(best, value);
    return value;
  });
  return best;
}

TEST(NloptSearch, FindsTheKnownMinimum) {
  // The bowl's minimum is 0; a step of 1 % of the bounds off in two variables is 2e-4.
  for (const char* name :
       {"GN_DIRECT_L", "GN_DIRECT", "LN_SBPLX", "LN_COBYLA", "LN_BOBYQA", "LN_NELDERMEAD", "LN_NEWUOA_BOUND"})
    EXPECT_LT(lowest(options_for(name, 2, 150), bowl), 2e-4) << name;
  EXPECT_LT(lowest(options_for("GN_CRS2_LM", 2, 600), bowl), 2e-4);
  EXPECT_LT(lowest(options_for("GN_ISRES", 2, 1500), bowl), 2e-3);
}

TEST(NloptSearch, FindsAMinimumOnTheBorderOfAConstraint) {
  // min (x - 0.7)^2 + (y - 0.7)^2 with x + y <= 1 lies at (0.5, 0.5): value 0.08.
  auto away = [](std::span<const double> x) { return std::pow(x[0] - 0.7, 2) + std::pow(x[1] - 0.7, 2); };
  for (const auto& [name, maxeval] :
       std::map<std::string, int>{{"LN_COBYLA", 150}, {"GN_ORIG_DIRECT_L", 400}, {"GN_ISRES", 2000}, {"GN_AGS", 400}}) {
    ASSERT_TRUE(takes_constraints(name));
    SearchOptions options = options_for(name, 2, maxeval);
    options.constraints = 1;
    double best = HUGE_VAL;
    const Constraints constraints = [](std::span<const double> x) { return std::vector<double>{x[0] + x[1] - 1.0}; };
    run_search(
        options,
        [&](std::span<const double> x) -> std::optional<double> {
          if (x[0] + x[1] - 1.0 > 1e-9) return best < 1.0 ? best : 1.0;  // What the driver answers: nothing new.
          best = std::min(best, away(x));
          return away(x);
        },
        constraints);
    EXPECT_NEAR(best, 0.08, 0.02) << name;
    EXPECT_GE(best, 0.08 - 1e-8) << name;
  }
}

TEST(NloptSearch, WorksOutConstraintsOncePerPoint) {
  SearchOptions options = options_for("LN_COBYLA", 2, 60);
  options.constraints = 3;
  int scores = 0, limits = 0;
  const SearchEnd end = run_search(
      options,
      [&](std::span<const double> x) -> std::optional<double> {
        ++scores;
        return bowl({x.begin(), x.end()});
      },
      [&](std::span<const double> x) {
        ++limits;
        return std::vector<double>{x[0] - 0.9, x[1] - 0.9, -1.0};
      });
  EXPECT_EQ(scores, 60);
  EXPECT_LE(limits, scores);
  EXPECT_EQ(end.points, 60);
}

TEST(NloptSearch, StopsAtScoreAndTolerances) {
  SearchOptions options = options_for("LN_SBPLX", 2, 500);
  options.stop_score = 1e-3;
  EXPECT_EQ(run_search(options,
                       [](std::span<const double> x) -> std::optional<double> {
                         return bowl({x.begin(), x.end()});
                       })
                .reason,
            "stop_score reached");
  options.stop_score.reset();
  options.xtol = 1e-2;
  const SearchEnd end = run_search(options, [](std::span<const double> x) -> std::optional<double> {
    return bowl({x.begin(), x.end()});
  });
  EXPECT_EQ(end.reason, "xtol reached");
  EXPECT_LT(end.points, 500);
}

TEST(NloptSearch, TheSeedDecides) {
  SearchOptions options = options_for("GN_CRS2_LM", 2, 40);
  const auto first = straight_points(options, bowl);
  options.seed = 54321;
  EXPECT_NE(straight_points(options, bowl), first);
  EXPECT_NE(replayed_points(options, bowl), first);
}

}  // namespace
