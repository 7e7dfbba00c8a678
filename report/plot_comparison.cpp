// What is here: several runs in one picture: their curves, linear for the peaks and logarithmic for what is left behind
// them, and their numbers. What is not: one run in full (plot_run.cpp), sweeps (plot_sweep.h), which know replicates.

#include <algorithm>
#include <cmath>
#include <limits>

#include "io/error.h"
#include "io/text.h"
#include "report/canvas.h"
#include "report/chart.h"
#include "report/curve_mean.h"
#include "report/measured_curves.h"
#include "report/plot.h"
#include "results/summary_numbers.h"

namespace perfora::report {
namespace {

constexpr double page_width = 1600.0, page_margin = 44.0;
constexpr double first_row = 130.0;
constexpr double panel_left = 124.0, panel_width = 880.0, upper_height = 330.0, lower_height = 380.0, panel_gap = 40.0;
constexpr double table_left = 1040.0, table_line = 30.0;
/// The logarithmic axis spans at most this ratio: below it there is dust.
constexpr double stress_decades = 1000.0;
/// Empty share above the highest first peak.
constexpr double headroom = 1.15;
constexpr double percent = 100.0, kilo = 1e-3;
/// Strain up to which a measured curve counts for the height of its first peak where no plateau window says.
constexpr double latest_peak = 0.1;

struct Drawn {
  const LabelledRun* row = nullptr;
  Colour colour;
  std::vector<double> strain, stress;  ///< %, kPa
  results::Curve smooth;               ///< %, kPa
};

/// The k-th colour; darker with every turn through the palette.
Colour hue(std::size_t k) {
  constexpr double darker = 0.4;
  const auto& hues = palette::series();
  const std::size_t round = k / hues.size();
  return mix(hues[k % hues.size()], palette::ink, 1.0 - std::pow(1.0 - darker, static_cast<double>(round)));
}

/// A colour a design, lighter with every further run of it; a colour a run where all are of one design.
std::vector<Colour> colours_of(const std::vector<LabelledRun>& rows) {
  constexpr double lightest = 0.5;
  std::vector<std::string> designs, known;
  for (const LabelledRun& row : rows) {
    designs.push_back(row.design);
    if (std::find(known.begin(), known.end(), row.design) == known.end()) known.push_back(row.design);
  }
  std::vector<Colour> colours;
  for (std::size_t k = 0; k < rows.size(); ++k) {
    if (known.size() == 1) {
      colours.push_back(hue(k));
      continue;
    }
    const auto design = static_cast<std::size_t>(std::find(known.begin(), known.end(), designs[k]) - known.begin());
    const auto before = std::count(designs.begin(), designs.begin() + static_cast<std::ptrdiff_t>(k), designs[k]);
    const auto all = std::count(designs.begin(), designs.end(), designs[k]);
    const double light = all > 1 ? lightest * static_cast<double>(before) / static_cast<double>(all - 1) : 0.0;
    colours.push_back(mix(hue(design), palette::paper, light));
  }
  return colours;
}

std::vector<Drawn> drawn_of(const std::vector<LabelledRun>& rows) {
  const std::vector<Colour> colours = colours_of(rows);
  std::vector<Drawn> all;
  for (std::size_t k = 0; k < rows.size(); ++k) {
    Drawn one{&rows[k], colours[k], rows[k].run.history.strain_yy, rows[k].run.history.stress_yy, {}};
    one.smooth = smoothed_mean({{one.strain, one.stress}});
    for (auto* strains : {&one.strain, &one.smooth.strain})
      for (double& value : *strains) value *= 100.0;
    for (auto* stresses : {&one.stress, &one.smooth.stress})
      for (double& value : *stresses) value *= 1e-3;
    all.push_back(std::move(one));
  }
  return all;
}

using Window = std::optional<std::pair<double, double>>;

/// The window of the plateau where all runs have the same.
Window common_window(const std::vector<LabelledRun>& rows) {
  const Window window = results::plateau_window(rows.front().run.summary);
  for (const LabelledRun& row : rows)
    if (results::plateau_window(row.run.summary) != window) return std::nullopt;
  return window;
}

/// What the page says of the plateaus: where they were taken, or that they cannot be compared.
std::string window_text(const std::vector<LabelledRun>& rows, const Window& window) {
  if (window)
    return "; shaded: the plateau window, " +
           io::quantities({window->first, window->second}, io::Dimension::ratio, " to ");
  const bool any =
      std::any_of(rows.begin(), rows.end(), [](const auto& row) { return results::plateau_window(row.run.summary); });
  return any ? "; the plateau windows of these runs differ" : "";
}

using Measured = std::vector<results::Curve>;

void draw_curves(Canvas& canvas, const std::vector<Drawn>& all, const Measured& measured, const Window& window) {
  double end = 0.0, peak = 0.0, highest = 0.0, lowest = INFINITY;
  for (const Drawn& one : all) {
    if (!one.strain.empty()) end = std::max(end, one.strain.back());
    const auto first_peak = results::summary_number(one.row->run.summary, "first_peak_stress");
    const double own = one.stress.empty() ? 0.0 : *std::max_element(one.stress.begin(), one.stress.end());
    peak = std::max(peak, first_peak ? 1e-3 * *first_peak : own);
    highest = std::max(highest, own);
    for (const double value : one.smooth.stress)
      if (value > 0.0) lowest = std::min(lowest, value);
  }
  const double early = window ? window->first : latest_peak;
  for (const results::Curve& curve : measured)
    for (std::size_t k = 0; k < curve.strain.size(); ++k) {
      end = std::max(end, percent * curve.strain[k]);
      highest = std::max(highest, kilo * curve.stress[k]);
      if (curve.strain[k] <= early) peak = std::max(peak, kilo * curve.stress[k]);
    }
  if (!(end > 0.0) || !(highest > 0.0)) end = peak = highest = lowest = 1.0;  // no row yet: empty axes
  const Axis strain{0.0, end, "engineering strain (%)"};
  const Axis linear{0.0, headroom * peak, "stress (kPa)"};
  const Axis logarithmic{std::max(0.8 * lowest, highest / stress_decades), 1.5 * highest, "stress (kPa), smoothed",
                         true};
  Chart upper(canvas, {panel_left, first_row, panel_width, upper_height}, strain, linear);
  Chart lower(canvas, {panel_left, first_row + upper_height + panel_gap, panel_width, lower_height}, strain,
              logarithmic);
  for (Chart* chart : {&upper, &lower}) {
    if (window && 100.0 * window->first < end)
      chart->x_band(100.0 * window->first, std::min(100.0 * window->second, end), palette::band, 0.75);
    chart->draw_axes(chart == &lower);
  }
  for (const Drawn& one : all) {
    upper.polyline(one.strain, one.stress, one.colour, 1.6);
    std::vector<double> level = one.smooth.stress;
    for (double& value : level) value = std::max(value, 0.5 * logarithmic.low);  // clipped below the axis
    lower.polyline(one.smooth.strain, level, one.colour, 2.0);
  }
  draw_measured(upper, measured, {percent, kilo}, -std::numeric_limits<double>::infinity());
  draw_measured(lower, measured, {percent, kilo}, 0.5 * logarithmic.low);
}

/// The first peaks and the fall behind them, which are a spike in the whole curve.
void draw_first_peaks(Canvas& canvas, const std::vector<Drawn>& all, const Measured& measured, const Box& box) {
  constexpr double shown = 4.0;  // times the largest strain of a first peak
  double strain = 0.0, stress = 0.0;
  for (const Drawn& one : all) {
    const auto at = results::summary_number(one.row->run.summary, "first_peak_strain");
    const auto peak = results::summary_number(one.row->run.summary, "first_peak_stress");
    if (!at || !peak) continue;
    strain = std::max(strain, 100.0 * *at);
    stress = std::max(stress, 1e-3 * *peak);
  }
  if (!(strain > 0.0) || !(stress > 0.0)) return;
  Chart chart(canvas, box, {0.0, shown * strain, "engineering strain (%)"}, {0.0, headroom * stress, "stress (kPa)"});
  canvas.text(box.x, box.y - 12.0, "the first peaks, magnified", {.size = 16.0, .colour = palette::soft_ink});
  chart.draw_axes();
  for (const Drawn& one : all) chart.polyline(one.strain, one.stress, one.colour, 2.0);
  draw_measured(chart, measured, {percent, kilo}, -std::numeric_limits<double>::infinity());
}

void draw_table(Canvas& canvas, const std::vector<Drawn>& all, const Measured& measured) {
  struct Field {
    const char *name, *unit, *key;
    double scale;
  };
  constexpr Field fields[] = {{"first peak", "kPa", "first_peak_stress", 1e-3},
                              {"plateau", "kPa", "plateau_stress", 1e-3},
                              {"densified", "at %", "densification_strain", 100.0}};
  constexpr double field_width = 86.0;
  const double fields_left = page_width - page_margin - field_width * std::size(fields);
  const TextStyle head{.size = 15.0, .colour = palette::soft_ink, .align = Align::right};
  const TextStyle name{.size = 16.0}, value{.size = 16.0, .align = Align::right};
  double y = first_row + 12.0;
  double x = fields_left;
  for (const Field& field : fields) {
    x += field_width;
    canvas.text(x, y, field.name, head);
    canvas.text(x, y + 20.0, field.unit, head);
  }
  y += 20.0;
  for (const Drawn& one : all) {
    y += table_line;
    canvas.line(table_left, y - 5.0, table_left + 24.0, y - 5.0, one.colour, 4.0);
    canvas.text(table_left + 34.0, y, canvas.fit(one.row->label, fields_left - table_left - 44.0, name, Keep::end),
                name);  // names of files differ at their ends
    x = fields_left;
    for (const Field& field : fields) {
      const auto number = results::summary_number(one.row->run.summary, field.key);
      canvas.text(x += field_width, y, number ? io::number(field.scale * *number) : "-", value);
    }
  }
  for (std::size_t k = 0; k < measured.size(); ++k) {
    y += table_line;
    canvas.line(table_left, y - 5.0, table_left + 24.0, y - 5.0, measured_colour(k), measured_thickness);
    canvas.text(table_left + 34.0, y,
                canvas.fit(measured[k].name, page_width - page_margin - table_left - 34.0, name, Keep::end), name);
  }
}

}  // namespace

void plot_comparison(const std::vector<LabelledRun>& rows, const std::filesystem::path& out,
                     const PlotOptions& options) {
  if (rows.empty()) throw io::InputError({out.string(), 0, ""}, "no run was given to draw", "", "name run files");
  const std::vector<Drawn> all = drawn_of(rows);
  const double panels = first_row + upper_height + panel_gap + lower_height + 74.0;
  const double lines = static_cast<double>(rows.size() + options.measured.size());
  const double table = first_row + 60.0 + table_line * lines + page_margin;
  Canvas canvas(out, page_width, std::max(panels, table));
  const TextStyle title{.size = 30.0, .bold = true};
  canvas.text(page_margin, 56.0, canvas.fit(options.title, page_width - 2.0 * page_margin, title), title);
  const Window window = common_window(rows);
  std::string line = "Above: every row of the history. Below: mean over 2 % strain, on a logarithmic axis";
  line += window_text(rows, window);
  canvas.text(page_margin, 88.0, line, {.size = 17.0, .colour = palette::soft_ink});
  draw_curves(canvas, all, options.measured, window);
  draw_table(canvas, all, options.measured);
  const Box beside{table_left + 70.0, first_row + upper_height + panel_gap,
                   page_width - page_margin - table_left - 70.0, lower_height};
  if (table < beside.y) draw_first_peaks(canvas, all, options.measured, beside);
  canvas.write();
}

}  // namespace perfora::report
