// What is here: calibrations read from result.json or from their journal. What is not: writing them
// (optimize/search/).
#include "results/calibration_record.h"

#include <cmath>
#include <nlohmann/json.hpp>

#include "io/error.h"
#include "io/files.h"
#include "results/campaign_folder.h"
#include "results/formats.h"
#include "results/record_reading.h"
#include "results/statistic.h"

namespace perfora::results {
namespace {

using nlohmann::json;
namespace fs = std::filesystem;

std::optional<double> wanted_in(const json& result, const std::string& name) {
  for (const json& target : result.at("targets"))
    if (target.at("name") == name) return target.at("wanted").get<double>();
  return std::nullopt;
}

CalibrationRecord from_result(const json& result) {
  CalibrationRecord record;
  for (const json& p : result.at("points"))
    if (p.at("strength_ratio").is_number())
      record.points.push_back({p.at("rupture_delay").get<double>(), p.at("shear_ratio").get<double>(),
                               p.at("strength_ratio").get<double>(), p.at("of_chart").get<bool>()});
  const auto tensile = wanted_in(result, "tensile_strength"), compressive = wanted_in(result, "compressive_strength");
  if (tensile && compressive) record.wanted = *compressive / *tensile;
  const json& found = result.at("found");
  const json &normal = found.at("critical_normal_stretch"), &shear = found.at("critical_shear_displacement");
  if (normal.is_number() && normal.get<double>() > 0.0) record.found = shear.get<double>() / normal.get<double>();
  return record;
}

double mean_of(const json& strengths) {
  std::vector<double> values;
  for (const json& value : strengths)
    if (value.is_number()) values.push_back(value.get<double>());
  return statistic_of("strength", values).mean;
}

/// The first point of a journal was tested at other thresholds, which it was there to set.
CalibrationRecord from_journal(const fs::path& folder) {
  CalibrationRecord record;
  bool first = true;
  int line = 0;
  for (const json& event : journal_events(folder)) {
    ++line;
    if (event.at("event") != "point") continue;
    read_from(folder / "journal.jsonl", line, "give the folder of `perfora calibrate`", [&] {
      const double ratio = mean_of(event.at("compression")) / mean_of(event.at("tension"));
      if (!first && std::isfinite(ratio))
        record.points.push_back(
            {event.at("rupture_delay").get<double>(), event.at("shear_ratio").get<double>(), ratio, false});
    });
    first = false;
  }
  return record;
}

}  // namespace

CalibrationRecord read_calibration_record(const fs::path& path) {
  const fs::path file = fs::is_directory(path) ? path / "result.json" : path;
  const char* remedy = "give the folder or the result.json of `perfora calibrate`";
  if (!fs::exists(file) && fs::is_directory(path)) return from_journal(path);
  return read_from(file, 0, remedy, [&] {
    const json result = json::parse(io::read_file(file), nullptr, false);
    if (!result.is_object() || result.value("schema", "") != calibration_schema)
      throw io::InputError({file.string(), 0, ""}, "is not the result of a calibration", "", remedy);
    return from_result(result);
  });
}

}  // namespace perfora::results
