// What is here: what a user wishes of the curve of a design, as plain data with its keys: [target]. What is not:
// whether it is met (verdict.h), the search (optimize/search/).
#pragma once

#include <array>
#include <cstddef>
#include <string>
#include <vector>

#include "io/schema.h"
#include "results/measure_options.h"
#include "results/measure_table.h"

namespace perfora::results {

/// What a verdict speaks of: the mean over blocks, or a stated fraction of single blocks.
enum class Statement { mean, block };

/// [target], [target.limit], [target.weight]. Everything is optional.
struct Target {
  double plateau_stress = 0.0;       ///< Pa; 0: none
  double tolerance = 0.20;           ///< on the plateau stress or, as exp(distance) - 1, on the curve
  std::vector<double> window;        ///< start, end, strain; empty: as [measures] says
  std::string window_word;           ///< "found" instead of `window`
  std::vector<double> curve_points;  ///< strain, Pa, strain, Pa, ...: wanted stress over strain
  double floor = 0.05;               ///< of the target, under the stress in the distance
  double cap = 0.0;                  ///< Pa, of the stroke at a cap; 0: none
  std::vector<double> stress_until;  ///< strain, Pa: no larger stress up to there
  Statement statement = Statement::mean;
  double fraction = 0.9;       ///< of single blocks that must keep the wish, for Statement::block
  std::string record;          ///< further measures for tables of a search, with commas
  double weight_limits = 1.0;  ///< of a limit that is not kept, in a score
  /// By place in the table of measures: bounds of a limit (none, one by the measure's sense, two), weight in a score.
  std::array<std::vector<double>, most_measures> limits;
  std::array<double, most_measures> weights{};

  Target();
  bool operator==(const Target&) const = default;
  bool has_curve() const { return !curve_points.empty(); }
  /// The stress wanted at a strain, Pa; 0: none is wanted.
  double stress_at(double strain) const;
  /// Mean over the window of the wanted stress, Pa; 0: none is wanted.
  double level(double window_start, double window_end) const;
};

/// Adds the three sections.
void describe(io::Schema& schema, Target& target);

/// One wish with the range that keeps it: low <= measure <= high, infinite where open.
struct Wish {
  const Measure* measure = nullptr;
  double low = 0.0, high = 0.0;
};

/// The limits, in the order of the table of measures.
std::vector<Wish> limits(const Target& target);
/// Every wish: the plateau stress or the curve first, then the limits.
std::vector<Wish> wishes(const Target& target);
/// Name of a measure in a sentence.
std::string name_of(const Measure& measure);
/// "at most 3 MPa", "0.8 to 1.25".
std::string range_text(const Wish& wish);
/// The wishes a line each, with the window, and what the verdict will speak of.
std::vector<std::string> in_words(const Target& target, const MeasureOptions& options);
/// Whether a search has something to go by: a wish or a weight other than those of a wished stress.
bool is_given(const Target& target);
/// Measures that tables of a search show beside the score: those of wishes and weights, and `record`.
std::vector<const Measure*> recorded_measures(const Target& target);

/// Throws io::InputError (origins from `schema`) for a window, bounds, a curve or names that make no sense; nothing
/// else of this room needs to be checked again. `place` is what [measures] says of the window.
void validate(const Target& target, const MeasureOptions& place, const io::Schema& schema);
/// Sentences about wishes that look like mistakes (a stress of a few pascals, ...), without a full stop.
std::vector<std::string> warnings(const Target& target);

/// The options with the window of the target, where it has one.
MeasureOptions with_window_of(const Target& target, MeasureOptions options);
/// What the curve of a block of this area is measured by.
MeasuringFrame measuring_frame(const Target& target, const MeasureOptions& options, double reference_area);

}  // namespace perfora::results
