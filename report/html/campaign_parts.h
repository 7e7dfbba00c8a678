// What is here: the parts of a page about folders of work: studies, sweeps and ensembles, calibrations. What is not:
// the page (page.h), a single run (run_part.h).
#pragma once

#include <filesystem>

#include "report/html/part.h"
#include "results/calibration_record.h"
#include "results/map_record.h"
#include "results/study_record.h"
#include "results/sweep_record.h"

namespace perfora::report {

/// Facts: `subtitle`, `verdict`, `columns`, `rows` (a candidate each, SI), `best_number`, `best`, `start` and
/// `measured` curves, `wish`, `facts`, `finals`, `thumbnails`, `failed`, `status`, `reason`. Throws io::InputError as
/// the readers of `folder` do.
Part study_part(const results::StudyRecord& record, const std::filesystem::path& folder);

/// Facts: `subtitle`, `verdict`, `measures`, `groups` with their cases and curves, `base`, `measured`, `cases` (a row
/// each for a table). `record` has its runs. An ensemble is one group of one case.
Part sweep_part(const results::SweepRecord& record);

/// Facts: `columns`, `rows` (a design each, SI), `ranges` (a row a measure), `wishes`, `out_of_reach`, `failed`.
Part map_part(const results::MapRecord& record);

/// Facts: `points`, `wanted`, `found`.
Part calibration_part(const results::CalibrationRecord& record);

/// result.json or ensemble.json of a folder; null where there is none that can be read.
nlohmann::json result_of(const std::filesystem::path& folder);

/// The unit a key of a design or a measure is shown in: {name, label, scale (per SI unit), unit}. `largest`: the
/// largest value that is shown.
nlohmann::json column_facts(const std::string& name, double largest);

}  // namespace perfora::report
