// What is here: the record and the file of material tests. What is not: the tests.
#include "optimize/evaluate/material_tests_file.h"

#include "optimize/evaluate/evaluation.h"
#include "results/formats.h"
#include "results/material_file.h"

namespace perfora::optimize {

using nlohmann::json;

json to_json(const MaterialTests& tests) {
  json material = json::object();
  for (const results::Statistic& s : tests.statistics)
    material[s.name] = {{"mean", number(s.mean)},
                        {"standard_deviation", number(s.standard_deviation)},
                        {"confidence_95", number(s.confidence_95)},
                        {"minimum", number(s.minimum)},
                        {"maximum", number(s.maximum)},
                        {"count", s.count}};
  json runs = json::array();
  for (const MaterialTestRun& run : tests.runs) {
    const solver::MaterialTestResult& r = run.result;
    runs.push_back({{"test", solver::material_test_name(r.kind)},
                    {"replicate", run.replicate},
                    {"status", results::status_name(r.status)},
                    {"reason", r.reason},
                    {"strength", number(r.strength)},
                    {"peak_strain", number(r.peak_strain)},
                    {"modulus", number(r.modulus)},
                    {"lateral_ratio", number(r.lateral_ratio)},
                    {"fracture_energy", number(r.fracture_energy)},
                    {"crack_length", number(r.crack_length)},
                    {"energy_residual", number(r.energy_residual)},
                    {"broken_bonds", r.broken_bonds},
                    {"broken_in_tension", r.broken_in_tension},
                    {"steps", r.steps},
                    {"rate", number(r.rate)},
                    {"time_step", number(r.time_step)}});
  }
  return {{"schema", results::material_format},
          {"status", results::status_name(tests.status)},
          {"reason", tests.reason},
          {"seeds", to_json(tests.seeds)},
          {"results_version", results_version},
          {"discs", tests.discs},
          {"bonds", tests.bonds},
          {"width", tests.sample.width},
          {"height", tests.sample.height},
          {"mean_diameter", number(tests.mean_diameter)},
          {"material", material},
          {"tests", runs},
          {"performance", to_json(tests.performance)}};
}

void write_material_tests(const std::filesystem::path& path, const DesignFile& design, const MaterialTests& tests,
                          const std::string& command_line) {
  results::MaterialResult result;
  result.provenance = provenance_of(design, tests.seeds, command_line);
  result.sample = tests.sample;
  result.summary = to_json(tests);
  for (const MaterialTestRun& run : tests.runs) {
    results::MaterialTest test{solver::material_test_name(run.result.kind), run.replicate, run.result.curve, {}, {}};
    if (run.replicate == 0) {  // one picture a test is enough; its sample is the one in the file
      test.frame = run.result.frame;
      test.events = run.result.events;
    }
    result.tests.push_back(std::move(test));
  }
  results::write_material_tests(path, result);
}

}  // namespace perfora::optimize
