// What is here: the record and the file of material tests. What is not: the tests.
#include <fmt/format.h>

#include "geometry/packing_file.h"
#include "io/hdf5.h"
#include "optimize/evaluate/evaluation.h"
#include "optimize/evaluate/material_tests.h"
#include "solver/run_files.h"

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
                    {"status", solver::status_name(r.status)},
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
  return {{"schema", "perfora.test/1"},
          {"status", solver::status_name(tests.status)},
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
  io::Hdf5Writer file(path);
  write_record(file, "perfora.test/1", design, to_json(tests), command_line);
  geometry::write_packing(file, "/sample", tests.sample);
  for (const MaterialTestRun& run : tests.runs) {
    const std::string group =
        fmt::format("/tests/{}-{:03d}", solver::material_test_name(run.result.kind), run.replicate);
    const solver::MaterialCurve& curve = run.result.curve;
    file.dataset(group + "/curve/strain", curve.strain);
    file.dataset(group + "/curve/stress", curve.stress, 0, "Pa");
    file.dataset(group + "/curve/lateral_strain", curve.lateral_strain);
    file.dataset(group + "/curve/lateral_stress", curve.lateral_stress, 0, "Pa");
    file.dataset(group + "/curve/damage", curve.damage, 0, "J/m");
    file.dataset(group + "/curve/work", curve.work, 0, "J/m");
    file.dataset(group + "/curve/cundall", curve.cundall, 0, "J/m");
    file.dataset(group + "/curve/broken_bonds", curve.broken_bonds);
    if (run.replicate != 0) continue;  // one picture a test is enough; its sample is the one in the file
    solver::write_frame_group(file, group + "/frame", run.result.frame);
    solver::write_events(file, group + "/events", run.result.events);
  }
  file.commit();
}

}  // namespace perfora::optimize
