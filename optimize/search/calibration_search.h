// What is here: the search of a calibration as a function of what has been tested so far: which points to test next, or
// the parameters found. What is not: the tests, the folder (calibration_run.h).
#pragma once

#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "optimize/search/calibration.h"

namespace perfora::optimize {

/// What the elastic response of the samples has settled before any test.
struct CalibrationBasis {
  double normal_stiffness = 0.0, tangential_stiffness = 0.0;  ///< N/m
  double young_modulus = 0.0;                                 ///< two-dimensional, Pa
  double mean_diameter = 0.0, mean_bond_length = 0.0;         ///< of the samples, m
};

/// Strengths of one point, a number a sample, Pa; NaN where a test gave none.
struct SampleStrengths {
  std::vector<double> tension, compression;
};

/// One point to be tested.
struct StrengthQuestion {
  std::string key;                       ///< names the design
  std::shared_ptr<const Design> sample;  ///< the solid sample as TOML
  double shear_ratio = 0.0, rupture_delay = 0.0;
};

/// Strengths by the key of a point; nothing while they are not known.
using KnownStrengths = std::function<std::optional<SampleStrengths>(const std::string& key)>;

/// How far the search has come.
struct StrengthSearch {
  results::RunStatus status = results::RunStatus::completed;  ///< failed: no test gave the strengths it rests on
  std::string reason;
  BondParameters found;  ///< stiffnesses; thresholds above zero once they are found
  std::vector<std::string> not_met;
  std::vector<StrengthPoint> points;     ///< known ones, in the order of the search
  std::vector<StrengthQuestion> wanted;  ///< empty: it has ended. Those of the chart all at once
};

/// Runs the search from its start over the points that are known: thresholds that give nearly the wanted tensile
/// strength, delta_t0/delta_n0 by a bracketed secant in logarithms, delta_n0 by proportion, then the chart.
StrengthSearch search_strengths(const Calibration& calibration, const CalibrationBasis& basis,
                                const KnownStrengths& known);

/// The calibration's design with these bonds.
DesignFile design_with(const Calibration& calibration, const BondParameters& parameters);

/// Largest number of points a calibration may test, and how many of them belong to the chart.
int most_points(const Calibration& calibration);
int chart_points(const Calibration& calibration);

}  // namespace perfora::optimize
