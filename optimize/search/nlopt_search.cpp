// What is here: the only code that talks to NLopt, with its known traps handled.
// What is not: what a score means.
#include "optimize/search/nlopt_search.h"

#include <fmt/format.h>
#include <algorithm>
#include <cassert>
#include <cctype>
#include <cmath>
#include <exception>
#include <limits>
#include <nlopt.hpp>

namespace perfora::optimize {
namespace {

/// Constraints count as kept up to this much, so that a point on the border is not lost to rounding.
constexpr double constraint_tolerance = 1e-9;
/// What NLopt is told after the search is over (it goes on asking for a while): finite, and worse than any score.
constexpr double after_the_end = 1e6;
/// Tolerance of the local searches inside MLSL and AUGLAG, in units of the cube: finer than any simulation resolves.
constexpr double inner_tolerance = 1e-3;

bool starts_with(const std::string& text, const char* prefix) {
  return text.rfind(prefix, 0) == 0;
}

bool one_of(const std::string& name, std::initializer_list<const char*> names) {
  return std::any_of(names.begin(), names.end(), [&](const char* other) { return name == other; });
}

/// GN_ORIG_DIRECT of NLopt 2.7.1 reads memory it never set (and hangs or crashes) when it is stopped within its first
/// division of 2 n + 1 points.
int unstoppable_calls(const SearchOptions& options) {
  if (!starts_with(options.algorithm, "GN_ORIG_DIRECT")) return 0;
  return (2 * options.dimension + 1) * (options.constraints + 1);
}

/// What the callbacks share. NLopt calls back through C, so nothing may be thrown through it.
struct Callbacks {
  const SearchOptions* options = nullptr;
  const Objective* objective = nullptr;
  const Constraints* constraints = nullptr;
  nlopt::opt* search = nullptr;
  SearchEnd end;
  bool over = false;
  std::exception_ptr error;
  std::vector<double> point;   ///< the point requested last
  std::vector<double> limits;  ///< constraint values there
  bool limits_known = false;

  int calls = 0;  ///< of any kind

  void stop() {
    over = true;
    if (calls > unstoppable_calls(*options)) search->force_stop();
  }

  /// Every callback passes here first.
  bool running() {
    ++calls;
    if (over) stop();  // Where stopping had to wait.
    return !over;
  }

  /// Counts points: objective and constraints are separate calls at the same one. False when the budget is spent.
  bool enter(unsigned n, const double* x, bool objective_call) {
    const bool same = point.size() == n && std::equal(point.begin(), point.end(), x) && !(objective_call && scored);
    if (!same) {
      if (end.points >= options->maxeval) {
        end.finished = true;
        end.reason = "maxeval reached";
        stop();
        return false;
      }
      ++end.points;
      point.assign(x, x + n);
      limits_known = false;
      scored = false;
    }
    if (objective_call) scored = true;
    return true;
  }
  bool scored = false;  ///< the objective was evaluated at `point`

  double score(unsigned n, const double* x) {
    if (!running() || !enter(n, x, true)) return after_the_end;
    const std::optional<double> value = (*objective)(std::span<const double>(x, n));
    if (!value) {
      end.finished = false;
      stop();
      return after_the_end;
    }
    assert(std::isfinite(*value));
    return *value;
  }

  double limit(unsigned n, const double* x, std::size_t index) {
    if (!running() || !enter(n, x, false)) return 1.0;
    if (!limits_known) limits = (*constraints)(std::span<const double>(x, n));
    limits_known = true;
    assert(index < limits.size() && std::isfinite(limits[index]));
    return limits[index];
  }

  template <class Call>
  double guarded(Call call, double otherwise) noexcept {
    try {
      return call();
    } catch (...) {
      error = std::current_exception();
      stop();
      return otherwise;
    }
  }
};

struct ConstraintCall {
  Callbacks* callbacks;
  std::size_t index;
};

double score_callback(unsigned n, const double* x, double*, void* data) {
  auto& callbacks = *static_cast<Callbacks*>(data);
  return callbacks.guarded([&] { return callbacks.score(n, x); }, after_the_end);
}

double constraint_callback(unsigned n, const double* x, double*, void* data) {
  const auto& call = *static_cast<ConstraintCall*>(data);
  return call.callbacks->guarded([&] { return call.callbacks->limit(n, x, call.index); }, 1.0);
}

std::string reason_text(nlopt::result result) {
  switch (result) {
    case nlopt::STOPVAL_REACHED:
      return "stop_score reached";
    case nlopt::FTOL_REACHED:
      return "ftol reached";
    case nlopt::XTOL_REACHED:
      return "xtol reached";
    case nlopt::MAXEVAL_REACHED:
      return "maxeval reached";
    default:
      return "the algorithm found nothing more to do";
  }
}

/// MLSL and AUGLAG crash in NLopt 2.7.1 without a local optimiser of their own.
void give_inner_search(nlopt::opt& search, const SearchOptions& options) {
  if (!starts_with(options.algorithm, "GN_MLSL") && !starts_with(options.algorithm, "LN_AUGLAG")) return;
  nlopt::opt inner(nlopt::LN_SBPLX, static_cast<unsigned>(options.dimension));
  inner.set_xtol_rel(inner_tolerance);
  inner.set_maxeval(options.maxeval);
  search.set_local_optimizer(inner);
}

void configure(nlopt::opt& search, const SearchOptions& options) {
  search.set_lower_bounds(0.0);
  search.set_upper_bounds(1.0);
  search.set_maxeval(std::max(options.maxeval, unstoppable_calls(options) + 1));
  if (options.xtol > 0.0) search.set_xtol_abs(options.xtol);
  if (options.ftol > 0.0) search.set_ftol_abs(options.ftol);
  if (options.stop_score) search.set_stopval(*options.stop_score);
  if (options.population > 0) search.set_population(static_cast<unsigned>(options.population));
  if (starts_with(options.algorithm, "LN_")) search.set_initial_step(options.initial_step);
  give_inner_search(search, options);
}

/// Runs NLopt and puts its way of ending into words; its exceptions are all endings, ours are kept in callbacks.error.
std::string optimize(nlopt::opt& search, std::vector<double>& x) {
  double best = 0.0;
  try {
    return reason_text(search.optimize(x, best));
  } catch (const nlopt::roundoff_limited&) {
    return "rounding leaves nothing to improve";
  } catch (const nlopt::forced_stop&) {
    return "stopped";
  } catch (const std::bad_alloc&) {
    throw;
  } catch (const std::exception& failure) {
    return std::string("NLopt gave up: ") + failure.what();
  }
}

}  // namespace

SearchEnd run_search(const SearchOptions& options, const Objective& objective, const Constraints& constraints) {
  assert(options.dimension >= smallest_dimension(options.algorithm));
  assert(static_cast<int>(options.start.size()) == options.dimension);
  nlopt::opt search(options.algorithm.c_str(), static_cast<unsigned>(options.dimension));
  Callbacks callbacks;
  callbacks.options = &options;
  callbacks.objective = &objective;
  callbacks.constraints = &constraints;
  callbacks.search = &search;
  configure(search, options);
  search.set_min_objective(score_callback, &callbacks);
  std::vector<ConstraintCall> calls(static_cast<std::size_t>(options.constraints));
  for (std::size_t k = 0; k < calls.size(); ++k) {
    calls[k] = {&callbacks, k};
    search.add_inequality_constraint(constraint_callback, &calls[k], constraint_tolerance);
  }
  nlopt::srand(options.seed);
  std::vector<double> x = options.start;
  const std::string reason = optimize(search, x);
  if (callbacks.error) std::rethrow_exception(callbacks.error);
  if (!callbacks.over) callbacks.end.finished = true;
  if (callbacks.end.finished && callbacks.end.reason.empty()) callbacks.end.reason = reason;
  return callbacks.end;
}

std::vector<double> descend(const std::function<double(std::span<const double>, std::span<double>)>& function,
                            std::vector<double> start, const std::vector<double>& low, const std::vector<double>& high,
                            int maxeval) {
  struct Call {
    const std::function<double(std::span<const double>, std::span<double>)>& function;
    std::vector<double> best, unused;
    double least = std::numeric_limits<double>::infinity();
    std::exception_ptr error;
  };
  Call call{function, start, std::vector<double>(start.size()), std::numeric_limits<double>::infinity(), nullptr};
  nlopt::opt search(nlopt::LD_LBFGS, static_cast<unsigned>(start.size()));
  const auto callback = [](unsigned n, const double* x, double* gradient, void* data) noexcept {
    auto& one = *static_cast<Call*>(data);
    try {
      const std::span<const double> at(x, n);
      const double value = one.function(at, {gradient ? gradient : one.unused.data(), n});
      if (value < one.least) {
        one.least = value;
        one.best.assign(at.begin(), at.end());
      }
      return value;
    } catch (...) {
      one.error = std::current_exception();
      return after_the_end;
    }
  };
  search.set_lower_bounds(low);
  search.set_upper_bounds(high);
  search.set_maxeval(maxeval);
  search.set_ftol_rel(1e-6);
  search.set_min_objective(callback, &call);
  static_cast<void>(optimize(search, start));  // However it ends, the best point is known.
  if (call.error) std::rethrow_exception(call.error);
  return call.best;
}

const std::vector<std::string>& derivative_free_algorithms() {
  static const std::vector<std::string> names = [] {
    std::vector<std::string> found;
    for (int k = 0; k < nlopt::NUM_ALGORITHMS; ++k) {
      const std::string name = nlopt_algorithm_to_string(static_cast<nlopt_algorithm>(k));
      const bool there = std::string(nlopt::algorithm_name(static_cast<nlopt::algorithm>(k))).find("NOT COMPILED") ==
                         std::string::npos;
      if ((starts_with(name, "GN_") || starts_with(name, "LN_")) && there && name != "LN_NEWUOA") found.push_back(name);
    }
    return found;
  }();
  return names;
}

std::string canonical_algorithm(const std::string& name, std::string& problem) {
  std::string canonical = name;
  std::transform(canonical.begin(), canonical.end(), canonical.begin(),
                 [](unsigned char c) { return static_cast<char>(std::toupper(c)); });
  if (starts_with(canonical, "NLOPT_")) canonical.erase(0, 6);
  const auto& allowed = derivative_free_algorithms();
  if (std::find(allowed.begin(), allowed.end(), canonical) != allowed.end()) return canonical;
  if (canonical == "LN_NEWUOA")
    problem = "LN_NEWUOA keeps no bounds; use LN_NEWUOA_BOUND";
  else if (one_of(canonical, {"AUGLAG", "AUGLAG_EQ", "G_MLSL", "G_MLSL_LDS"}))
    problem = fmt::format("\"{}\" needs a second algorithm; use {}", name,
                          starts_with(canonical, "G_") ? "GN_" + canonical.substr(2) : "LN_" + canonical);
  else if (nlopt_algorithm_from_string(canonical.c_str()) >= 0)
    problem = fmt::format("\"{}\" needs gradients, which a simulation does not give", name);
  else
    problem = fmt::format("NLopt has no algorithm \"{}\"", name);
  return {};
}

bool takes_constraints(const std::string& algorithm) {
  return one_of(algorithm, {"GN_ISRES", "LN_COBYLA", "GN_AGS", "GN_ORIG_DIRECT", "GN_ORIG_DIRECT_L", "LN_AUGLAG"});
}

int smallest_dimension(const std::string& algorithm) {
  return algorithm == "LN_NEWUOA_BOUND" ? 2 : 1;
}

int largest_dimension(const std::string& algorithm) {
  return algorithm == "GN_AGS" ? 10 : std::numeric_limits<int>::max();
}

int first_population(const std::string& algorithm, int dimension, int population) {
  if (population > 0 && one_of(algorithm, {"GN_CRS2_LM", "GN_ISRES"})) return population;
  if (algorithm == "GN_CRS2_LM") return 10 * (dimension + 1);
  if (algorithm == "GN_ISRES") return 20 * (dimension + 1);
  if (algorithm == "GN_ESCH") return 40;
  return 0;
}

bool uses_start(const std::string& algorithm) {
  return starts_with(algorithm, "LN_") || starts_with(algorithm, "GN_MLSL") ||
         one_of(algorithm, {"GN_CRS2_LM", "GN_ISRES", "GN_ESCH"});
}

bool fits_models(const std::string& algorithm) {
  return one_of(algorithm, {"LN_BOBYQA", "LN_NEWUOA_BOUND", "LN_COBYLA", "LN_PRAXIS"});
}

std::string nlopt_version_text() {
  return fmt::format("{}.{}.{}", nlopt::version_major(), nlopt::version_minor(), nlopt::version_bugfix());
}

}  // namespace perfora::optimize
