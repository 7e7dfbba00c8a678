// What is here: drawing of the reachable region. What is not: its data (results/map_record.h), axes (chart.h).
#include "report/plot_map.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <string_view>

#include "io/text.h"
#include "report/canvas.h"
#include "report/chart.h"
#include "report/measure_unit.h"

namespace perfora::report {
namespace {

constexpr double page_width = 1600.0, page_height = 1180.0;
constexpr double left = 124.0, top = 168.0, panel_width = 520.0, panel_height = 380.0, gap_x = 130.0, gap_y = 120.0;
constexpr double legend_left = left + 2.0 * panel_width + gap_x + 40.0, legend_line = 28.0;
constexpr double point_radius = 5.5;
/// Results that span more than this ratio stand on a logarithmic axis.
constexpr double logarithmic_ratio = 8.0;
constexpr const char* abscissa = "plateau_stress";
constexpr std::array<const char*, 4> usual_ordinates{"cap_ratio", "undulation", "densification_strain", "porosity"};

double value_of(const results::MapDesign& design, const std::string& key) {
  const auto found = design.results.find(key);
  return found == design.results.end() ? std::numeric_limits<double>::quiet_NaN() : found->second.mean;
}

const results::Wish* wish_of(const results::MapRecord& record, std::string_view key) {
  for (const results::Wish& wish : record.wishes)
    if (key == wish.measure->key) return &wish;
  return nullptr;
}

/// What is wished beside the plateau, then what is usual: as many as there are panels.
std::vector<std::string> ordinates_of(const results::MapRecord& record) {
  std::vector<std::string> keys;
  const auto add = [&](const std::string& key) {
    if (keys.size() < usual_ordinates.size() && std::find(keys.begin(), keys.end(), key) == keys.end())
      keys.push_back(key);
  };
  for (const results::Wish& wish : record.wishes)
    if (const std::string key = wish.measure->key; key != abscissa && key != "target_distance") add(key);
  for (const char* key : usual_ordinates) add(key);
  return keys;
}

/// The range of the designs, and the finite bounds of the wish so that it is seen where nothing came.
Axis axis_of(const results::MapRecord& record, const std::string& key) {
  const MeasureUnit unit = measure_unit(key);
  double low = std::numeric_limits<double>::infinity(), high = -low;
  const auto hold = [&](double value) {
    if (!std::isfinite(value)) return;
    low = std::min(low, unit.scale * value);
    high = std::max(high, unit.scale * value);
  };
  for (const results::MapDesign& design : record.designs) hold(value_of(design, key));
  if (const results::Wish* wish = wish_of(record, key)) {
    hold(wish->low);
    hold(wish->high);
  }
  Axis axis;
  axis.label = unit.label;
  if (!(high >= low)) return axis;
  axis.logarithmic = low > 0.0 && high > logarithmic_ratio * low;
  if (axis.logarithmic) {
    axis.low = low / 1.25;
    axis.high = high * 1.25;
  } else {
    const double room = high > low ? 0.08 * (high - low) : 0.1 * std::abs(high) + 1e-12;
    axis.low = low >= 0.0 ? std::max(0.0, low - room) : low - room;
    axis.high = high + room;
  }
  return axis;
}

std::vector<std::string> arms_of(const results::MapRecord& record) {
  std::vector<std::string> arms;
  for (const results::MapDesign& design : record.designs)
    if (std::find(arms.begin(), arms.end(), design.arm) == arms.end()) arms.push_back(design.arm);
  return arms;
}

Colour colour_of(const std::vector<std::string>& arms, const std::string& arm) {
  const auto place = static_cast<std::size_t>(std::find(arms.begin(), arms.end(), arm) - arms.begin());
  return palette::series()[place % palette::series().size()];
}

void draw_panel(Canvas& canvas, const results::MapRecord& record, const std::string& key, const Box& box) {
  const double x_scale = measure_unit(abscissa).scale, y_scale = measure_unit(key).scale;
  Chart chart(canvas, box, axis_of(record, abscissa), axis_of(record, key));
  const auto bounds = [](const results::Wish& wish, double scale, const Axis& axis) {
    return std::pair{std::max(axis.low, scale * wish.low), std::min(axis.high, scale * wish.high)};
  };
  constexpr double shade = 0.8;
  if (const results::Wish* wish = wish_of(record, abscissa)) {
    const auto [low, high] = bounds(*wish, x_scale, chart.x_axis());
    chart.x_band(low, high, palette::band, shade);
  }
  if (const results::Wish* wish = wish_of(record, key)) {
    const auto [low, high] = bounds(*wish, y_scale, chart.y_axis());
    if (low < high) chart.y_band(low, high, palette::band, shade);
  }
  chart.draw_axes();
  const std::vector<std::string> arms = arms_of(record);
  for (const results::MapDesign& design : record.designs) {
    const double x = x_scale * value_of(design, abscissa), y = y_scale * value_of(design, key);
    if (std::isfinite(x) && std::isfinite(y))
      canvas.disc(chart.px(x), chart.py(y), point_radius, colour_of(arms, design.arm), palette::paper, 1.0);
  }
}

void draw_legend(Canvas& canvas, const results::MapRecord& record) {
  const double width = page_width - legend_left - 24.0;
  double y = top;
  const std::vector<std::string> arms = arms_of(record);
  constexpr std::size_t most_arms = 24;
  for (std::size_t k = 0; k < std::min(arms.size(), most_arms); ++k, y += legend_line) {
    canvas.disc(legend_left + 8.0, y - 5.0, point_radius, colour_of(arms, arms[k]), palette::paper, 1.0);
    canvas.text(legend_left + 24.0, y, canvas.fit(arms[k], width - 24.0, {.size = 15.0}), {.size = 15.0});
  }
  if (record.wishes.empty()) return;
  canvas.fill({legend_left, y - 12.0, 16.0, 14.0}, palette::band);
  canvas.text(legend_left + 24.0, y, "wished", {.size = 15.0});
}

}  // namespace

void plot_map(const results::MapRecord& record, const std::filesystem::path& out) {
  Canvas canvas(out, page_width, page_height);
  canvas.text(44.0, 56.0,
              canvas.fit("What can be reached: " + record.title, page_width - 88.0, {.size = 30.0, .bold = true}),
              {.size = 30.0, .bold = true});
  const int unusable =
      static_cast<int>(std::count_if(record.designs.begin(), record.designs.end(),
                                     [](const auto& one) { return !std::isfinite(value_of(one, abscissa)); }));
  std::string caption = fmt::format("A point a design: mean over {} packing{}; {} designs{}", record.replicates,
                                    record.replicates == 1 ? "" : "s", record.designs.size(),
                                    unusable > 0 ? fmt::format(", {} of them without a plateau", unusable) : "");
  if (!record.fidelity.empty()) caption += ", at the fidelity " + record.fidelity;
  canvas.text(44.0, 88.0, canvas.fit(caption, page_width - 88.0), {.size = 17.0, .colour = palette::soft_ink});
  if (const auto sentences = results::out_of_reach(record); !sentences.empty())
    canvas.text(44.0, 120.0, canvas.fit(sentences.front(), page_width - 88.0, {.bold = true}),
                {.colour = palette::vermilion, .bold = true});
  const std::vector<std::string> ordinates = ordinates_of(record);
  for (std::size_t k = 0; k < ordinates.size(); ++k) {
    const std::size_t column = k % 2, row = k / 2;
    draw_panel(canvas, record, ordinates[k],
               {left + static_cast<double>(column) * (panel_width + gap_x),
                top + static_cast<double>(row) * (panel_height + gap_y), panel_width, panel_height});
  }
  draw_legend(canvas, record);
  canvas.write();
}

}  // namespace perfora::report
