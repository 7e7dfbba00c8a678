// What is here: the calibration file: keys, reading, checks, and the record of a result. What is not: the search
// (calibration_search.cpp).
#include "optimize/search/calibration.h"

#include <fmt/format.h>

#include <algorithm>
#include <utility>

#include "io/error.h"
#include "io/text.h"
#include "optimize/campaign/table_file.h"
#include "optimize/evaluate/evaluation.h"
#include "results/formats.h"

namespace perfora::optimize {
namespace {

using io::Dimension;
using io::Range;
using nlohmann::json;

void describe(io::Schema& schema, CalibrationKeys& keys) {
  constexpr double largest_poisson = 0.49;
  auto section =
      schema.section("calibrate", "Bond parameters for wanted constants of the solid material (perfora calibrate).");
  section.path("design", keys.design, "Design file that packing, horizon, law and density come from.")
      .real("young_modulus", keys.young_modulus, Dimension::stress, Range::non_negative(),
            "Wanted E; 0: not wanted, k_n stays.")
      .real("poisson_ratio", keys.poisson_ratio, Dimension::none, Range::between(0.0, largest_poisson),
            "Wanted nu; 0: not wanted, k_t/k_n stays.")
      .real("tensile_strength", keys.tensile_strength, Dimension::stress, Range::non_negative(),
            "Wanted tensile strength; must be given.")
      .real("compressive_strength", keys.compressive_strength, Dimension::stress, Range::non_negative(),
            "Wanted uniaxial compressive strength; 0: not wanted, delta_t^0/delta_n^0 stays.")
      .choice("reading", keys.reading,
              {{"two_dimensional", ElasticReading::two_dimensional}, {"plane_strain", ElasticReading::plane_strain}},
              "Whether E and nu are those of the plane or of a three-dimensional solid in plane strain.")
      .boolean("vary_rupture_delay", keys.vary_rupture_delay,
               "Try other zeta_max where the wanted ratio of strengths is out of reach.")
      .real("tolerance", keys.tolerance, Dimension::ratio, {1e-3, 0.5, false, false}, "Of each wanted number.")
      .integer("replicates", keys.replicates, Range::between(1, 100), "Samples a point.")
      .integer("maxeval", keys.maxeval, Range::between(3, 1000),
               "Points of the search for delta_t^0/delta_n^0, for each zeta_max tried.")
      .boolean(
          "chart", keys.chart,
          "Also test a grid of zeta_max and delta_t^0/delta_n^0 and draw which ratios of strengths can be reached.");
  describe(section, keys.execution);
}

json statistic_json(const results::Statistic& s) {
  return {{"mean", number(s.mean)}, {"standard_deviation", number(s.standard_deviation)}, {"count", s.count}};
}

/// null for what was not found yet.
json positive(double value) {
  return value > 0.0 ? number(value) : json(nullptr);
}

}  // namespace

Calibration read_calibration(const std::filesystem::path& path, const std::vector<std::string>& overrides) {
  Calibration calibration;
  calibration.file = path;
  io::Schema schema;
  describe(schema, calibration.keys);
  const TableFile file(path, {"calibration", {"calibrate"}, {}}, schema, overrides);
  const CalibrationKeys& keys = calibration.keys;
  const auto start = file.start(keys.design);
  refuse_skip(keys.execution, schema.origin("calibrate.on_trouble"));
  if (!(keys.tensile_strength > 0.0))
    throw io::InputError({path.string(), 0, "calibrate.tensile_strength"}, "no tensile strength is given",
                         "a positive stress", "add tensile_strength = \"3 MPa\" or the like to [calibrate]");
  if (keys.compressive_strength > 0.0 && keys.compressive_strength <= keys.tensile_strength)
    throw io::InputError(schema.origin("calibrate.compressive_strength"),
                         "the compressive strength is not above the tensile one", "more than tensile_strength",
                         "check both; bonds that break more easily in compression are not in this model");
  for (const auto& [name, stress] :
       {std::pair{"young_modulus", keys.young_modulus}, std::pair{"tensile_strength", keys.tensile_strength},
        std::pair{"compressive_strength", keys.compressive_strength}})
    if (stress > 0.0 && stress < 1e4)
      calibration.warnings.push_back(fmt::format(
          "calibrate.{} is {} (plain numbers are in Pa); did you mean \"{:g} {}Pa\"?", name,
          io::quantity(stress, io::Dimension::stress), stress, std::string_view(name) == "young_modulus" ? "G" : "M"));
  // What was found to be in reach of these bonds (docs/user/tutorial-mortar.md).
  constexpr double least_ratio = 5.0, largest_ratio = 40.0;
  const double ratio = keys.compressive_strength / keys.tensile_strength;
  if (keys.compressive_strength > 0.0 && (ratio < least_ratio || ratio > largest_ratio))
    calibration.warnings.push_back(
        fmt::format("the compressive strength is {} times the tensile one: these bonds reach {:g} to {:g} times; check "
                    "both, or expect \"not met\"",
                    io::number(ratio), least_ratio, largest_ratio));
  solver::MaterialOptions& material = start->design().solver.material;
  if (material.grade != 1.0 || material.strength != 1.0)
    calibration.warnings.push_back(
        "material.grade and material.strength of the design are factors on the parameters that "
        "are searched; they are taken as 1 here");
  material.grade = material.strength = 1.0;
  material.characteristic_length = 0.0;  // of other parameters
  calibration.start = start;
  for (std::string& warning : material_sample(*start).validate()) calibration.warnings.push_back(std::move(warning));
  return calibration;
}

std::string calibration_reference() {
  CalibrationKeys keys;
  io::Schema schema;
  describe(schema, keys);
  return schema.reference();
}

json to_json(const CalibrationResult& result) {
  json targets = json::array(), points = json::array();
  for (const CalibrationTarget& t : result.targets)
    targets.push_back({{"name", t.name}, {"wanted", number(t.wanted)}, {"reached", number(t.reached)}, {"met", t.met}});
  for (const StrengthPoint& p : result.points)
    points.push_back({{"shear_ratio", number(p.shear_ratio)},
                      {"rupture_delay", number(p.rupture_delay)},
                      {"tensile_strength", statistic_json(p.tensile)},
                      {"compressive_strength", statistic_json(p.compressive)},
                      {"strength_ratio", number(p.ratio())},
                      {"of_chart", p.of_chart}});
  json record = {
      {"schema", results::calibration_schema},
      {"status", results::status_name(result.status)},
      {"reason", result.reason},
      {"results_version", results_version},
      {"found",
       {{"normal_stiffness", positive(result.found.normal_stiffness)},
        {"tangential_stiffness", positive(result.found.tangential_stiffness)},
        {"critical_normal_stretch", positive(result.found.critical_normal_displacement)},
        {"critical_shear_displacement", positive(result.found.critical_shear_displacement)},
        {"rupture_delay", positive(result.found.rupture_delay)}}},
      {"targets", targets},
      {"not_met", result.not_met},
      {"points", points},
      {"confirmation", result.confirmation.runs.empty() ? json(nullptr) : to_json(result.confirmation)},
      {"performance", {{"seconds", number(result.seconds)}, {"threads", result.confirmation.performance.threads}}}};

  if (!result.troubles.empty()) record["troubles"] = result.troubles;
  return record;
}

}  // namespace perfora::optimize
