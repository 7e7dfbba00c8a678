// What is here: one sequential NLopt search over the unit cube that may meet points nobody has evaluated yet, and which
// algorithms there are. What is not: designs, scores, the journal (driver.h). nlopt.hpp is included in nlopt_search.cpp
// only.
#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <span>
#include <string>
#include <vector>

namespace perfora::optimize {

/// One search. Coordinates are scaled to [0, 1] by the caller.
struct SearchOptions {
  std::string algorithm = "GN_DIRECT_L";  ///< as canonical_algorithm() gives it
  int dimension = 1;
  int maxeval =
      1;  ///< points in total; never exceeded, although NLopt's own limit is (by a population, by a sweep of DIRECT)
  std::uint32_t seed = 1;      ///< of NLopt's generator (thread-local; seeded in the calling thread)
  std::vector<double> start;   ///< first point of local algorithms, in [0, 1]
  double initial_step = 0.25;  ///< of local algorithms, in units of the cube
  int population = 0;          ///< 0: NLopt's own choice
  double xtol = 0.0;           ///< absolute, in units of the cube; 0: off. DIRECT, ISRES and ESCH take no notice of it
  double ftol = 0.0;           ///< absolute, on the score; 0: off
  std::optional<double> stop_score;  ///< ends the search at a score as low as this
  int constraints = 0;               ///< number of inequality constraints g(x) <= 0 given to NLopt
};

/// The score at a point, or nothing when it is not known yet.
using Objective = std::function<std::optional<double>(std::span<const double>)>;
/// Values g(x), feasible where all are <= 0; known everywhere.
using Constraints = std::function<std::vector<double>(std::span<const double>)>;

struct SearchEnd {
  bool finished = false;  ///< false: it met an unknown point, which is the last one requested
  std::string reason;     ///< why it finished: "maxeval reached", "xtol reached", ...
  int points = 0;         ///< points requested, the unknown one included
};

/// Runs the search from its start until it ends or the objective answers nothing for the first time; after that the
/// objective is not called again, whatever NLopt still asks. Values that are not finite are a bug of the caller
/// (assert). An exception of the objective or of the constraints ends the search and is thrown on unchanged. NLopt's
/// own "best" is not returned: it is not always the best it saw.
SearchEnd run_search(const SearchOptions& options, const Objective& objective, const Constraints& constraints = {});

/// The lowest point that NLopt's LD_LBFGS sees from `start` within the bounds, for a smooth function that writes its
/// gradient to the second span. Not a search of a study: what models are fitted by. At most `maxeval` calls.
std::vector<double> descend(const std::function<double(std::span<const double>, std::span<double>)>& function,
                            std::vector<double> start, const std::vector<double>& low, const std::vector<double>& high,
                            int maxeval = 80);

/// Derivative-free algorithms that keep bounds, by NLopt's own names without the prefix "NLOPT_".
const std::vector<std::string>& derivative_free_algorithms();

/// The name without "NLOPT_" and in capitals when the algorithm can be used here; otherwise empty and `problem` says in
/// one clause why not.
std::string canonical_algorithm(const std::string& name, std::string& problem);

/// Whether NLopt hands nonlinear inequality constraints to this algorithm.
bool takes_constraints(const std::string& algorithm);
/// Smallest number of variables it works with (NEWUOA needs two), and the largest (AGS stops at ten).
int smallest_dimension(const std::string& algorithm);
int largest_dimension(const std::string& algorithm);
/// Points it spends on its first population before it learns anything; 0 where there is none.
int first_population(const std::string& algorithm, int dimension, int population);
/// Whether it starts from `start` (local algorithms and those global ones that use the first guess).
bool uses_start(const std::string& algorithm);
/// Whether it fits quadratic or linear models and so suffers from penalties that jump.
bool fits_models(const std::string& algorithm);
/// "2.7.1"
std::string nlopt_version_text();

}  // namespace perfora::optimize
