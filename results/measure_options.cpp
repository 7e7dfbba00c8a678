// What is here: the keys of [measures], the text of a frame. What is not: the measures (measures.cpp).
#include "results/measure_options.h"

#include <fmt/format.h>

#include "io/error.h"

namespace perfora::results {

void describe(io::Schema& schema, MeasureOptions& options) {
  using io::Dimension;
  using io::Range;
  schema.section("measures", "What is read from the curve.")
      .choice("plateau", options.plateau, {{"window", PlateauPlace::window}, {"found", PlateauPlace::found}},
              "window: from plateau_start to plateau_end; found: on the found plateau of each curve "
              "(docs/user/theory.md, \"Measures\").")
      .real("plateau_start", options.plateau_start, Dimension::ratio, Range::between(0.0, 0.9),
            "Start of the plateau window.")
      .real("plateau_end", options.plateau_end, Dimension::ratio, Range::between(0.0, 0.9),
            "End of the plateau window.")
      .real("smoothing", options.smoothing, Dimension::ratio, Range{0.0, 0.2, true, false},
            "Width of the moving mean, in strain, behind the trough, the smallest and largest stress of a plateau and "
            "the found plateau.")
      .real("found_band", options.found_band, Dimension::ratio, Range{0.0, 1.0, true, true},
            "The smoothed stress of a found plateau stays within +- this of its mean.")
      .real("found_length", options.found_length, Dimension::ratio, Range{0.0, 0.9, true, false},
            "A found plateau is at least this long, in strain.");
}

void validate(const MeasureOptions& options, const io::Schema& schema) {
  if (options.plateau_start < options.plateau_end) return;
  throw io::InputError(schema.origin("measures.plateau_end"), "the plateau window is empty",
                       "plateau_end must be larger than plateau_start", "raise plateau_end");
}

std::string MeasuringFrame::text() const {
  const MeasureOptions& o = options;
  const bool found = o.plateau == PlateauPlace::found;
  std::string text = found ? "found" : fmt::format("{} {}", o.plateau_start, o.plateau_end);
  text += fmt::format("; {} {} {}; {} {}", o.smoothing, o.found_band, o.found_length, cap, cap_strain);
  if (target_stress > 0.0 || !target_curve.empty())
    text += fmt::format("; {} {} {}", floor, target_stress, fmt::join(target_curve, " "));
  return text;
}

}  // namespace perfora::results
