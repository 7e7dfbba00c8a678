// What is here: what a picture of a study shows, as plain data with its file study.json. What is not: the search
// (optimize/search/), its numbers for programs (result.json), drawing (report/).
#pragma once

#include <filesystem>
#include <limits>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <vector>

#include "geometry/perforation.h"
#include "results/curve.h"
#include "results/stress_cap.h"

namespace perfora::results {

/// One evaluated candidate.
struct StudyPoint {
  int number = 0;                                           ///< 1, 2, ... in the order of the search
  std::string arm;                                          ///< "square 6 x 6"
  std::vector<double> values;                               ///< of the variables
  double score = std::numeric_limits<double>::quiet_NaN();  ///< smaller is better; NaN: failed or not simulated
  bool feasible = true;                                     ///< false: a constraint is violated (nothing was simulated)
};

struct StudyRecord {
  std::string title;
  std::string subtitle;               ///< one line: algorithm, replicates, why it stopped
  std::string score_label = "score";  ///< with its unit in brackets
  std::vector<StudyPoint> points;
  int best_number = 0;      ///< point that is the best design; 0: none
  std::vector<Curve> best;  ///< a replicate each
  std::vector<Curve> start;
  std::vector<Curve> measured;  ///< of an experiment: drawn beside them under their names
  std::optional<double> best_plateau, best_plateau_deviation;  ///< mean and standard deviation over replicates, Pa
  std::optional<double> start_plateau, start_plateau_deviation;
  std::optional<double> target;                    ///< Pa
  std::optional<double> target_tolerance;          ///< Pa, half the height of the band
  Curve target_curve;                              ///< wished stress over strain, instead of one stress; empty: none
  std::optional<double> window_start, window_end;  ///< of the plateau; none where each curve has its own
  std::vector<StressCap> caps;
  std::string verdict, outcome;                    ///< Verdict::text, outcome_name(); empty where nothing is wished
  std::optional<geometry::PerforationLayout> best_layout, start_layout;
  /// Lines beside the best design: name and value as printed ("diameter", "18.2 mm"), and the value of the start design
  /// ("" where it is not shown).
  struct Fact {
    std::string name, best, start;
  };
  std::vector<Fact> facts;
};

/// schema "perfora.study_picture/1".
nlohmann::json to_json(const StudyRecord& record);
/// Throws nlohmann::json::exception for anything but such a record.
StudyRecord study_record_from_json(const nlohmann::json& object);

/// Reads the folder of a study: study.json; where an older program left none, what result.json, evaluations.csv and the
/// journal tell (no curves, no layouts). Throws io::InputError.
StudyRecord read_study_record(const std::filesystem::path& folder);

}  // namespace perfora::results
