// What is here: the picture of a study: its search, its best design, and what that gained. Plain data in, picture out.
// What is not: journals, studies (optimize/), which fill StudyPicture.
#pragma once

#include <filesystem>
#include <limits>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "geometry/perforation.h"
#include "report/curve_mean.h"

namespace perfora::report {

/// One evaluated candidate.
struct StudyEvaluation {
  int number = 0;                                           ///< 1, 2, ... in the order of the search
  std::string arm;                                          ///< "square 6 x 6"
  std::vector<double> values;                               ///< of the variables
  double score = std::numeric_limits<double>::quiet_NaN();  ///< smaller is better; NaN: failed or not simulated
  bool feasible = true;                                     ///< false: a constraint is violated (nothing was simulated)
};

struct StudyPicture {
  std::string title;
  std::string subtitle;               ///< one line: algorithm, replicates, why it stopped
  std::string score_label = "score";  ///< with its unit in brackets
  std::vector<StudyEvaluation> evaluations;
  int best_number = 0;           ///< evaluation that is the best design; 0: none
  std::vector<StudyCurve> best;  ///< a replicate each
  std::vector<StudyCurve> start;
  std::optional<double> best_plateau, best_plateau_deviation;  ///< mean and standard deviation over replicates, Pa
  std::optional<double> start_plateau, start_plateau_deviation;
  std::optional<double> target;            ///< Pa
  std::optional<double> target_tolerance;  ///< Pa, half the height of the band
  double window_start = 0.20, window_end = 0.40;
  std::optional<geometry::PerforationLayout> best_layout, start_layout;
  /// Lines beside the best design: name and value as printed ("diameter", "18.2 mm"), and the value of the start design
  /// ("" where it is not shown).
  struct Fact {
    std::string name, best, start;
  };
  std::vector<Fact> facts;
};

/// Draws it, 1600 x 1000 pixels. Throws io::InputError for an extension other than .png, .svg, .pdf.
void plot_study(const StudyPicture& picture, const std::filesystem::path& out);

}  // namespace perfora::report
