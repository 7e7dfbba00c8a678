// What is here: the keys of [study], [map], [race] and [verify] with their help. What is not: reading a study file
// (study.cpp).
#include "optimize/search/study.h"

namespace perfora::optimize {
namespace {

using io::Range;

void describe(io::Schema& schema, MapKeys& keys) {
  auto section = schema.section(
      "map", "Designs spread evenly over all arms and bounds, evaluated before the search; they serve every target.");
  section.integer("designs", keys.designs, Range::non_negative(), "Designs that keep the constraints; 0: none");
  section.integer("replicates", keys.replicates, Range::at_least(1),
                  "Simulations a design, with the search's first seeds");
  section.text("fidelity", keys.fidelity,
               "Name of a [fidelity.NAME] that they are simulated at; empty: as the candidates of the search");
  section.path("from", keys.from,
               "Folder of a map or a study of the same space: its evaluations are taken instead of runs");
}

void describe(io::Schema& schema, RaceKeys& keys) {
  auto section = schema.section(
      "race", "The best designs once more on further seeds; after each round the worse half is left out.");
  section.integer("finalists", keys.finalists, Range::non_negative(),
                  "Designs that enter; 0: no race, the best design alone is verified");
  section.integer("keep", keys.keep, Range::at_least(1), "Designs that are left at the end; each of them is verified");
  section.integer("replicates", keys.replicates, Range::at_least(1), "Further seeds a round, the same for all");
}

void describe(io::Schema& schema, VerifyKeys& keys) {
  schema.section("verify", "The end of a study: designs on seeds that nothing has chosen them by.")
      .text("fidelity", keys.fidelity, "Name of a [fidelity.NAME]; empty: the design as it stands");
}

}  // namespace

void describe(io::Schema& schema, StudyKeys& keys) {
  using io::Dimension;
  auto section = schema.section("study", "How to search.");
  section.path("design", keys.design, "Design file the search starts from");
  section.real("budget", keys.budget, Dimension::time, Range::non_negative(),
               "Time of one processor for the whole study, instead of maxeval: two processors take half of it");
  section.text("algorithm", keys.algorithm,
               "\"model\", \"random\", \"sobol\" or a derivative-free algorithm of NLopt by its name");
  section.integer("maxeval", keys.maxeval, Range::non_negative(), "Candidates in total, over all arms");
  section.text("allocation", keys.allocation,
               "How maxeval is shared by the arms: \"equal\", \"proportional\" (to the fraction of an arm's bounds "
               "that keeps the "
               "constraints) or a list of numbers");
  section.integer("replicates", keys.replicates, Range::at_least(1),
                  "Simulations a candidate, each with seeds of its own");
  section.integer(
      "final_replicates", keys.final_replicates, Range::non_negative(),
      "Fresh seeds on which the best design is run again at the end; the start design on the first five of them");
  section.real("until", keys.until, Dimension::ratio, Range{0.0, 1.0, false, true},
               "Strain to run to; 0: as the design says");
  section.integer("starts", keys.starts, Range::at_least(1), "Arms that differ only in where a local algorithm begins");
  section.real("initial_step", keys.initial_step, Dimension::ratio, Range{0.0, 1.0, true, false},
               "First step of a local algorithm as a fraction of the bounds");
  section.integer("population", keys.population, Range::non_negative(),
                  "Population of CRS2, ISRES, ESCH; 0: NLopt's choice");
  section.real("xtol", keys.xtol, Dimension::ratio, Range{0.0, 1.0, false, true},
               "Stop when steps are smaller; fraction of the bounds");
  section.real("ftol", keys.ftol, Dimension::none, Range::non_negative(), "Stop when the score changes by less");
  section.real("stop_score", keys.stop_score, Dimension::none, Range::non_negative(),
               "An arm ends at a score as low as this; 0: never");
  section.text("refine", keys.refine, "Local algorithm of a second stage from the best candidate; empty: none");
  section.integer("refine_maxeval", keys.refine_maxeval, Range::non_negative(), "Candidates of the second stage");
  section.real("refine_step", keys.refine_step, Dimension::ratio, Range{0.0, 1.0, true, false},
               "First step of the second stage as a fraction of the bounds");
  section.integer("batch", keys.batch, Range::at_least(1),
                  "Candidates asked together by searches that ask in batches; more where there are more processors");
  section.text("fidelity", keys.fidelity,
               "Name of a [fidelity.NAME] that candidates are scored at; empty: the design as it stands");
  describe(section, keys.execution);
  describe(schema, keys.map);
  describe(schema, keys.race);
  describe(schema, keys.verify);
}

}  // namespace perfora::optimize
