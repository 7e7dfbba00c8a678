// What is here: the study file as plain data: what to vary, what to aim at, how to search, which arms that makes;
// reading and checking it. What is not: the search itself (driver.h), its folder (study_run.h).
#pragma once

#include <cstdint>
#include <filesystem>
#include <map>
#include <memory>
#include <set>
#include <string>
#include <vector>

#include "optimize/campaign/execution.h"
#include "optimize/evaluate/fidelity.h"
#include "optimize/search/constraints.h"
#include "optimize/search/objective.h"

namespace perfora::optimize {

class Searcher;

/// [map]: designs spread over all arms, evaluated before the search.
struct MapKeys {
  int designs = 0;       ///< that keep the constraints, in all; 0: none
  int replicates = 2;    ///< of each, with the seeds of the first replicates of the search
  std::string fidelity;  ///< name in [fidelity.NAME]; "": what candidates are scored at
  std::filesystem::path
      from;  ///< folder of a map or a study of the same space whose evaluations are taken; empty: none
};

/// [race]: the best designs once more on further seeds, the worse half left out after each round.
struct RaceKeys {
  int finalists = 0;   ///< designs that enter; 0: no race, the best of the search goes on alone
  int keep = 4;        ///< designs that are left, and verified
  int replicates = 2;  ///< further seeds a round
};

/// [verify]
struct VerifyKeys {
  std::string fidelity;  ///< name in [fidelity.NAME]; "": the design as it stands
};

/// [study]
struct StudyKeys {
  std::filesystem::path design;     ///< design file the search starts from; relative to the study file
  std::string algorithm = "model";  ///< "model", "random", "sobol" or NLopt's name of one of its own
  int maxeval = 0;                  ///< candidates in total, over all arms; must be given
  std::string allocation =
      "equal";         ///< of maxeval to arms: "equal", "proportional", or a list of numbers, one an arm ("6, 6, 4")
  int replicates = 3;  ///< a candidate; replicate r has the same seeds for every candidate
  int final_replicates = 5;  ///< fresh seeds on which the best is run again; 0: none
  /// The start runs on the first of them: pair by pair they tell what the search has gained, while each further one
  /// makes the verdict on the best narrower, which is what a user acts on.
  int start_final_replicates() const { return final_replicates < 5 ? final_replicates : 5; }
  double until = 0.0;          ///< engineering strain; 0: as the design says
  int starts = 1;              ///< arms that differ only in where a local algorithm begins
  double initial_step = 0.25;  ///< of local algorithms, as a fraction of the bounds
  int population = 0;          ///< 0: NLopt's own
  double xtol = 0.0;           ///< as a fraction of the bounds
  double ftol = 0.0;           ///< on the score
  double stop_score = 0.0;     ///< an arm ends at a score as low as this; 0: never
  std::string refine;          ///< local algorithm of a second stage that begins at the best candidate; "": none
  int refine_maxeval = 0;      ///< candidates of the second stage, beside maxeval
  double refine_step = 0.05;   ///< its initial step, as a fraction of the bounds
  int batch = 4;               ///< candidates that a searcher which asks in batches asks together
  std::string fidelity;  ///< that candidates are scored at: a name in [fidelity.NAME]; "": the design as it stands
  double budget = 0.0;   ///< s, time of one processor; instead of maxeval; 0: none
  MapKeys map;
  RaceKeys race;
  VerifyKeys verify;
  ExecutionKeys execution;  ///< the result does not depend on it
};

/// One continuous variable: a numeric key of the design with its bounds (SI).
struct Variable {
  std::string key;
  double low = 0.0, high = 0.0;
  io::Dimension dimension = io::Dimension::none;
};

/// One sequential search: family x rows x columns x ... x start.
struct Arm {
  std::string name;                   ///< "family=square rows=2 columns=3"; "all" when there is only one
  std::vector<DesignChange> choices;  ///< fixed, such as layout.rows = 3
  std::vector<double> start;          ///< first point of a local algorithm, each coordinate in [0, 1]
  int maxeval = 0;
  double fraction = 0.0;  ///< of its bounds that keeps the constraints, as some points spread over them tell
  std::uint32_t seed =
      1;  ///< of its search; from the search seed and the arm's name, so that arms do not change each other
};

/// What the folder in map.from holds of a study. No budget counts it: it was paid for there.
struct TakenMap {
  int designs = 0, evaluations = 0;
  double seconds = 0.0;       ///< wall time that the evaluations took
  std::int64_t map_runs = 0;  ///< runs of this study's own map that are among them
};

/// A study, read and checked. Copies share the design.
struct Study {
  std::filesystem::path file;
  std::string title;  ///< its own, otherwise the name of the file
  StudyKeys keys;
  results::Target target;  ///< of the study, where it says nothing of the design it starts from
  ConstraintKeys constraints;
  std::vector<Variable> variables;
  std::vector<Arm> arms;
  std::shared_ptr<const Searcher> searcher;  ///< has keys.algorithm
  std::shared_ptr<const Searcher> refiner;   ///< has keys.refine; nullptr without a second stage
  std::shared_ptr<const DesignFile> start;   ///< the design it starts from, window and strain of the study set
  /// What candidates can be evaluated at; the first is what they are scored on. Only those that are used.
  std::vector<Fidelity> fidelities;
  std::size_t map_fidelity = 0, verify_fidelity = 0;  ///< places among them
  std::vector<double> costs;                          ///< s, time of a run on one processor at each; 0: not measured
  std::map<std::string, std::string> ladder;          ///< "fidelity.NAME.KEY" and its value, of all that the file names
  TakenMap taken;                                     ///< empty where the folder is not there (any more)
  std::vector<std::string> warnings;

  /// Everything that decides the result, key by key, as text ("study.algorithm", "variables.layout.diameter",
  /// "design.material.horizon", ...); file names, how it is carried out and output options are left out.
  std::map<std::string, std::string> resolved() const;
  /// Names in resolved() whose keys are at their defaults.
  std::set<std::string> at_default() const;
  /// Values of a point of the unit cube: low + x (high - low), rounded to 12 digits so that equal points give equal
  /// keys on every machine.
  std::vector<double> values_at(std::span<const double> x) const;
  /// The point of the unit cube for values (clamped to the bounds).
  std::vector<double> point_of(std::span<const double> values) const;
  /// A design of an arm (nullptr: the start's own choices) with the variables set. Throws io::InputError when a key
  /// refuses its value.
  DesignFile design_at(const Arm* arm, std::span<const double> values) const;
  double until() const { return start->design().solver.loading.until; }
};

/// Whether a key of the design says what is searched, or by what: those that only what is written or drawn goes by do
/// not.
bool changes_search(const std::string& key);

/// What a study file is read for. A map needs neither a wish nor a number of candidates.
enum class StudyUse { search, map };

/// Reads and checks a study file and the design it names. `overrides` are "section.key=value" texts; those of the
/// study's sections go to the study, all others to the design. Throws io::InputError.
Study read_study(const std::filesystem::path& path, const std::vector<std::string>& overrides = {},
                 StudyUse use = StudyUse::search);
/// The same with these searchers behind study.algorithm and study.refine.
Study read_study(const std::filesystem::path& path, const std::vector<std::string>& overrides,
                 const std::vector<std::shared_ptr<const Searcher>>& searchers, StudyUse use = StudyUse::search);

/// Keys of a study file in one printed reference (Markdown).
std::string study_reference();

/// Adds [study], [map], [race] and [verify].
void describe(io::Schema& schema, StudyKeys& keys);

}  // namespace perfora::optimize
