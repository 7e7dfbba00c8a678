// What is here: the keys of [target], the wishes they make, what is refused. What is not: verdicts, scores.
#include "results/target.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "io/error.h"
#include "io/text.h"
#include "io/units.h"
#include "results/curve_file.h"
#include "results/sampled_curve.h"

namespace perfora::results {
namespace {

constexpr double infinite = std::numeric_limits<double>::infinity();
/// A wished stress below this is a mistake of units: 1.5 for 1.5 MPa.
constexpr double least_stress = 1e3;
constexpr const char* found_word = "found";

std::size_t place_of(const Measure& measure) {
  return static_cast<std::size_t>(&measure - measures().data());
}

std::size_t place_of(const char* key) {
  return place_of(*measure_called(key));
}

/// Which side a single number bounds, for the printed reference.
const char* sense_text(Sense sense) {
  switch (sense) {
    case Sense::at_most:
      return "at most this, or [lowest, highest]";
    case Sense::at_least:
      return "at least this, or [lowest, highest]";
    default:
      return "[lowest, highest]";
  }
}

std::vector<std::string> names_in(const std::string& list) {
  std::vector<std::string> names;
  std::string name;
  for (const char c : list + ",") {
    if (c != ',') {
      if (c != ' ') name += c;
      continue;
    }
    if (!name.empty()) names.push_back(name);
    name.clear();
  }
  return names;
}

std::vector<double> column(const std::vector<double>& points, std::size_t first) {
  std::vector<double> values;
  for (std::size_t k = first; k < points.size(); k += 2) values.push_back(points[k]);
  return values;
}

/// Takes over the curve of a CSV file.
void load_curve(Target& target, const std::filesystem::path& path) {
  const Curve curve = read_curve(path, StrainOrder::rising);
  target.curve_points.clear();
  for (std::size_t k = 0; k < curve.strain.size(); ++k) {
    target.curve_points.push_back(curve.strain[k]);
    target.curve_points.push_back(curve.stress[k]);
  }
}

}  // namespace

std::string name_of(const Measure& measure) {
  const std::string label = measure.label, key = measure.key;
  if (key.starts_with("found_plateau_") && label.front() == ' ') return "found plateau:" + label.substr(1);
  return label.substr(label.find_first_not_of(' '));
}

std::string range_text(const Wish& wish) {
  const io::Dimension dimension = wish.measure->dimension;
  if (!std::isfinite(wish.low)) return "at most " + io::quantity(wish.high, dimension);
  if (!std::isfinite(wish.high)) return "at least " + io::quantity(wish.low, dimension);
  return io::quantities({wish.low, wish.high}, dimension, " to ");
}

Target::Target() {
  weights[place_of("target_distance")] = 1.0;
  weights[place_of("cap_ratio")] = 0.1;
}

double Target::stress_at(double strain) const {
  return has_curve() ? interpolate(column(curve_points, 0), column(curve_points, 1), strain) : plateau_stress;
}

double Target::level(double window_start, double window_end) const {
  if (!has_curve() || !(window_end > window_start)) return plateau_stress;
  return integral(cut(column(curve_points, 0), column(curve_points, 1), window_start, window_end)) /
         (window_end - window_start);
}

void describe(io::Schema& schema, Target& target) {
  using io::Dimension;
  using io::Range;
  schema.section("target", "What is wished of the curve. Nothing of a run depends on it.")
      .real("plateau_stress", target.plateau_stress, Dimension::stress, Range::non_negative(),
            "Wished mean stress of the plateau; 0: none.")
      .real("tolerance", target.tolerance, Dimension::ratio, Range{0.0, 1.0, true, true},
            "On the plateau stress, up and down; with a curve on the root mean square of ln(stress/target).")
      .numbers("window", target.window, {{Dimension::ratio}, &target.window_word, {found_word}, 0, 2},
               "Start and end of the plateau in engineering strain, or \"found\": on the found plateau of each block. "
               "Stands above [measures].")
      .source(
          "curve", [&target](const std::filesystem::path& path, const io::Origin&) { load_curve(target, path); },
          "CSV with columns strain and stress: wished stress over strain, instead of one stress.")
      .real_rows("curve_points", target.curve_points, 2, Dimension::none,
                 "Rows of strain, stress in Pa: what `curve` held when it was read.")
      .real("floor", target.floor, Dimension::ratio, Range{0.0, 1.0, true, true},
            "Of the target: a smaller stress counts as this in the distance to the target.")
      .real("cap", target.cap, Dimension::stress, Range::non_negative(), "Stress of `stroke_at_cap`; 0: none.")
      .choice("statement", target.statement, {{"mean", Statement::mean}, {"block", Statement::block}},
              "What the verdict speaks of: mean of all blocks, or `fraction` of the single blocks.")
      .real("fraction", target.fraction, Dimension::ratio, Range{0.5, 1.0, false, true},
            "Of the single blocks that must keep the wish (statement = \"block\").")
      .text("record", target.record, "Further measures for the tables of a search, by their keys, with commas.");
  auto limit = schema.section("target.limit",
                              "Limits that a design must keep, by the keys of measures "
                              "(docs/user/formats.md): one number or a range.");
  limit.numbers("stress_until", target.stress_until, {{Dimension::ratio, Dimension::stress}, nullptr, {}, 0, 2},
                "[strain, stress]: no larger stress up to that strain, the first peak included.");
  for (const Measure& measure : measures())
    if (measure.sense != Sense::none && std::string_view(measure.key) != "stress_until")
      limit.numbers(measure.key, target.limits[place_of(measure)], {{measure.dimension}, nullptr, {}, 0, 2},
                    fmt::format("{}: {}.", name_of(measure), sense_text(measure.sense)));
  auto weight = schema.section("target.weight",
                               "Weights of a score (docs/user/theory.md, \"Score\"), by the keys of "
                               "measures; 0: left out.");
  weight.real("limits", target.weight_limits, Dimension::none, Range::non_negative(),
              "Of every wish that the mean does not keep: (ln floor)^2 + (ln(mean/bound))^2.");
  for (const Measure& measure : measures())
    if (measure.term != Term::none)
      weight.real(measure.key, target.weights[place_of(measure)], Dimension::none, Range::non_negative(),
                  fmt::format("{}.", name_of(measure)));
}

std::vector<Wish> limits(const Target& target) {
  std::vector<Wish> all;
  for (const Measure& measure : measures()) {
    const std::vector<double>& bounds = target.limits[place_of(measure)];
    if (bounds.size() == 2) all.push_back({&measure, bounds[0], bounds[1]});
    if (bounds.size() == 1)
      all.push_back(measure.sense == Sense::at_least ? Wish{&measure, bounds[0], infinite}
                                                     : Wish{&measure, -infinite, bounds[0]});
    if (std::string_view(measure.key) == "stress_until" && target.stress_until.size() == 2)
      all.push_back({&measure, -infinite, target.stress_until[1]});
  }
  return all;
}

std::vector<Wish> wishes(const Target& target) {
  std::vector<Wish> all;
  if (target.has_curve())
    all.push_back({measure_called("target_distance"), 0.0, std::log1p(target.tolerance)});
  else if (target.plateau_stress > 0.0)
    all.push_back({measure_called("plateau_stress"), target.plateau_stress * (1.0 - target.tolerance),
                   target.plateau_stress * (1.0 + target.tolerance)});
  for (const Wish& limit : limits(target)) all.push_back(limit);
  return all;
}

std::vector<std::string> in_words(const Target& target, const MeasureOptions& options) {
  const MeasureOptions at = with_window_of(target, options);
  const std::string place =
      at.plateau == PlateauPlace::found
          ? "on the found plateau of each block"
          : "over strain " + io::quantities({at.plateau_start, at.plateau_end}, io::Dimension::ratio, " to ");
  std::vector<std::string> lines;
  for (const Wish& wish : wishes(target)) {
    const bool curve = target.has_curve() && lines.empty();
    lines.push_back(fmt::format("{}: {}{}", name_of(*wish.measure), range_text(wish),
                                lines.empty() && (curve || target.plateau_stress > 0.0) ? " " + place : ""));
  }
  if (target.plateau_stress == 0.0 && !target.has_curve()) lines.push_back("measures of the plateau " + place);
  lines.push_back(target.statement == Statement::mean
                      ? "for the mean of blocks"
                      : fmt::format("for {} of single blocks", io::quantity(target.fraction, io::Dimension::ratio)));
  return lines;
}

bool is_given(const Target& target) {
  const Target none;
  return !wishes(target).empty() || target.weights != none.weights;
}

std::vector<const Measure*> recorded_measures(const Target& target) {
  std::vector<bool> wanted(measures().size(), false);
  for (const Wish& wish : wishes(target)) wanted[place_of(*wish.measure)] = true;
  for (const std::string& name : names_in(target.record))
    if (const Measure* measure = measure_called(name)) wanted[place_of(*measure)] = true;
  const bool distance = target.plateau_stress > 0.0 || target.has_curve();
  std::vector<const Measure*> found;
  for (const Measure& measure : measures()) {
    const bool weighed =
        target.weights[place_of(measure)] > 0.0 && (distance || std::string_view(measure.key) != "target_distance");
    if (wanted[place_of(measure)] || (measure.term != Term::none && weighed)) found.push_back(&measure);
  }
  return found;
}

void validate(const Target& target, const MeasureOptions& place, const io::Schema& schema) {
  const auto refuse_unless = [&](bool good, const std::string& key, const std::string& problem,
                                 const std::string& allowed, const std::string& remedy = {}) {
    if (!good) throw io::InputError(schema.origin(key), problem, allowed, remedy);
  };
  const auto& window = target.window;
  refuse_unless(window.empty() || (window.size() == 2 && 0.0 <= window[0] && window[0] < window[1] && window[1] < 1.0),
                "target.window", "this is not a window of strain",
                "[start, end] with 0 <= start < end < 1, or \"found\"",
                window.size() == 2 && window[1] > 1.0 && window[1] < 100.0
                    ? fmt::format("did you mean window = [\"{:g} %\", \"{:g} %\"]?", window[0], window[1])
                    : "write for example window = [0.2, 0.4]");
  const auto& until = target.stress_until;
  refuse_unless(until.empty() || (until.size() == 2 && until[0] > 0.0 && until[0] < 1.0 && until[1] > 0.0),
                "target.limit.stress_until", "this is not a strain with the largest stress up to it",
                "[strain, stress], the strain between 0 and 1",
                "write for example stress_until = [\"50 %\", \"4 MPa\"]");
  for (const Measure& measure : measures()) {
    const auto& bounds = target.limits[place_of(measure)];
    const std::string key = std::string("target.limit.") + measure.key;
    refuse_unless(bounds.size() != 2 || bounds[0] <= bounds[1], key, "the range is empty",
                  "[lowest, highest] with lowest <= highest", "exchange the two");
    refuse_unless(bounds.size() != 1 || measure.sense != Sense::within, key,
                  "one number does not say which side is kept", "[lowest, highest]",
                  fmt::format("write for example {} = [0.8, 1.25]", measure.key));
  }
  refuse_unless(target.cap > 0.0 || target.limits[place_of("stroke_at_cap")].empty(), "target.limit.stroke_at_cap",
                "the stroke is limited at no cap", "a stress target.cap", "add cap = \"4 MPa\" under [target]");
  for (const std::string& name : names_in(target.record)) {
    std::vector<std::string> names;
    for (const Measure& measure : measures()) names.emplace_back(measure.key);
    const std::string nearest = io::nearest_name(name, names);
    refuse_unless(measure_called(name) != nullptr, "target.record", io::in_quotes(name) + " is no measure",
                  "keys of the table in docs/user/formats.md",
                  nearest.empty() ? "" : fmt::format("did you mean {}?", nearest));
  }
  const bool level = target.plateau_stress > 0.0 || target.has_curve();
  for (const Measure& measure : measures())
    refuse_unless(level || !(target.weights[place_of(measure)] > 0.0) ||
                      (measure.term != Term::logarithm_above && measure.term != Term::logarithm_below),
                  std::string("target.weight.") + measure.key, "there is no stress that it could be compared with",
                  "a weight beside target.plateau_stress or target.curve", "wish a plateau stress, or give a limit");
  if (!target.has_curve()) return;
  const MeasureOptions at = with_window_of(target, place);
  refuse_unless(target.plateau_stress == 0.0, "target.plateau_stress", "both a stress and a curve are wished",
                "one of the two", "leave out plateau_stress or curve");
  const std::vector<double> strain = column(target.curve_points, 0), stress = column(target.curve_points, 1);
  const auto unordered = std::adjacent_find(strain.begin(), strain.end(), [](double a, double b) { return !(a < b); });
  refuse_unless(strain.size() >= 2 && unordered == strain.end(), "target.curve",
                "the strains of the wished curve do not rise", "two points or more, each strain above the one before");
  refuse_unless(*std::min_element(stress.begin(), stress.end()) > 0.0, "target.curve",
                "the wished curve holds a stress that is not above zero", "stresses above 0",
                "begin it behind the origin: logarithms are compared");
  refuse_unless(
      at.plateau == PlateauPlace::found || (strain.front() <= at.plateau_start && at.plateau_end <= strain.back()),
      "target.curve",
      fmt::format("the wished curve goes from strain {:g} to {:g}, the window from {:g} to {:g}", strain.front(),
                  strain.back(), at.plateau_start, at.plateau_end),
      "a curve over the whole window", "shorten target.window or give more of the curve");
}

std::vector<std::string> warnings(const Target& target) {
  std::vector<std::string> told;
  const auto look = [&](const std::string& key, double stress) {
    constexpr double hardly_mpa = 50.0;  // of a block with holes
    if (stress > 0.0 && stress < least_stress)
      told.push_back(
          fmt::format("{} is {}, far below what any block carries (plain numbers are in Pa); did you mean \"{:g} {}\"?",
                      key, io::quantity(stress, io::Dimension::stress), stress, stress > hardly_mpa ? "kPa" : "MPa"));
  };
  look("target.plateau_stress", target.plateau_stress);
  look("target.cap", target.cap);
  if (target.stress_until.size() == 2) look("target.limit.stress_until", target.stress_until[1]);
  for (const Wish& wish : wishes(target))
    if (wish.measure->dimension == io::Dimension::stress && std::string_view(wish.measure->key) != "plateau_stress" &&
        std::string_view(wish.measure->key) != "stress_until")
      look(std::string("target.limit.") + wish.measure->key, std::isfinite(wish.high) ? wish.high : wish.low);
  for (const Wish& wish : limits(target)) {
    constexpr double much = 3.0;  // 300 %
    const double bound = std::isfinite(wish.high) ? wish.high : wish.low;
    const std::string_view key = wish.measure->key;
    if (wish.measure->dimension == io::Dimension::ratio && key != "largest_over_mean" && bound > much)
      told.push_back(fmt::format("target.limit.{} is {} (plain numbers are parts of 1); did you mean \"{:g} %\"?", key,
                                 io::quantity(bound, io::Dimension::ratio), bound));
  }
  const double lowest = target.plateau_stress * (1.0 - target.tolerance);
  for (const char* cap : {"stress_until", "first_peak_stress"})
    for (const Wish& wish : wishes(target))
      if (wish.measure == measure_called(cap) && lowest > wish.high)
        told.push_back(fmt::format(
            "the wished plateau, {} at least, lies above target.limit.{}, {}: no block can keep both",
            io::quantity(lowest, io::Dimension::stress), cap, io::quantity(wish.high, io::Dimension::stress)));
  if (const auto& limit = target.limits[place_of("plateau_stress")]; target.plateau_stress > 0.0 && !limit.empty()) {
    const double highest = target.plateau_stress * (1.0 + target.tolerance);
    for (const Wish& wish : limits(target))
      if (std::string_view(wish.measure->key) == "plateau_stress" && (lowest > wish.high || highest < wish.low))
        told.push_back(fmt::format(
            "the wished plateau, {}, and target.limit.plateau_stress have no stress in common: no block can keep both",
            io::quantities({lowest, highest}, io::Dimension::stress, " to ")));
  }
  if (target.has_curve())
    look("target.curve", *std::max_element(target.curve_points.begin(), target.curve_points.end()));
  return told;
}

MeasureOptions with_window_of(const Target& target, MeasureOptions options) {
  if (target.window_word == found_word) options.plateau = PlateauPlace::found;
  if (target.window.size() != 2) return options;
  options.plateau = PlateauPlace::window;
  options.plateau_start = target.window[0];
  options.plateau_end = target.window[1];
  return options;
}

MeasuringFrame measuring_frame(const Target& target, const MeasureOptions& options, double reference_area) {
  MeasuringFrame frame;
  frame.options = with_window_of(target, options);
  frame.reference_area = reference_area;
  frame.target_stress = target.plateau_stress;
  frame.target_curve = target.curve_points;
  frame.floor = target.floor;
  frame.cap = target.cap;
  frame.cap_strain = target.stress_until.size() == 2 ? target.stress_until[0] : 0.0;
  return frame;
}

}  // namespace perfora::results
