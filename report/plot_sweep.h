// What is here: the picture of a sweep: for each group of cases its curves and its results with their scatter. Plain
// data in, picture out. What is not: what fills SweepPicture (sweep_picture.h).
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "report/curve_mean.h"
#include "results/sweep_record.h"

namespace perfora::report {

/// One result of one case, SI; NaN where not reached.
struct SweepValue {
  std::vector<double> replicates;
  double mean = 0.0, half_interval = 0.0;  ///< of the 95 % confidence interval; NaN for fewer than two
};

/// One case.
struct SweepPoint {
  int place = 0;                       ///< on the x axis of its group
  int series = 0;                      ///< of its group
  std::vector<results::Curve> curves;  ///< a replicate each
  std::vector<SweepValue> values;      ///< by measure
};

/// Cases that are drawn together: one row of the page.
struct SweepGroup {
  std::string label;                ///< of the x axis: what was varied
  std::vector<std::string> places;  ///< the values, as written
  std::vector<std::string> series;  ///< names; one empty name where there is one series
  std::vector<SweepPoint> points;
};

struct SweepPicture {
  std::string title, subtitle;
  std::string verdict, outcome;       ///< of an ensemble or one case with a target; empty: none
  std::vector<std::string> measures;  ///< keys of the table of measures: "plateau_stress"
  std::vector<SweepGroup> groups;
  std::vector<results::Wish> wishes;     ///< bands behind the results
  std::vector<SweepPoint> base;          ///< the design itself, drawn behind every group: none or one
  std::vector<results::Curve> measured;  ///< drawn thin beside the curves of every group, under their names
};

/// Draws it, 1600 pixels wide, a row a group: mean curves (of a single case each block's too), then every result with
/// its replicates (small), their mean and its 95 % interval. Throws io::InputError for an extension other than .png,
/// .svg, .pdf.
void plot_sweep(const SweepPicture& picture, const std::filesystem::path& out);

}  // namespace perfora::report
