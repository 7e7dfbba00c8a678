// What is here: columns of block characters. What is not: what is worth drawing (app/terminal.cpp).
#include "report/text_chart.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "io/text.h"
#include "results/sampled_curve.h"

namespace perfora::report {
namespace {

/// Mean stress of each column: of its samples, or between them where it has none.
std::vector<double> column_means(std::span<const double> strain, std::span<const double> stress, std::size_t columns) {
  std::vector<double> sum(columns, 0.0), count(columns, 0.0);
  const double first = strain.front(), span = strain.back() - first;
  for (std::size_t k = 0; k < strain.size(); ++k) {
    const double place = (strain[k] - first) / span * static_cast<double>(columns);
    const std::size_t column = std::min(columns - 1, static_cast<std::size_t>(std::max(0.0, place)));
    sum[column] += stress[k];
    count[column] += 1.0;
  }
  const std::vector<double> x(strain.begin(), strain.end()), y(stress.begin(), stress.end());
  for (std::size_t column = 0; column < columns; ++column)
    sum[column] = count[column] > 0.0
                      ? sum[column] / count[column]
                      : results::interpolate(
                            x, y, first + span * (static_cast<double>(column) + 0.5) / static_cast<double>(columns));
  return sum;
}

}  // namespace

std::string text_chart(std::span<const double> strain, std::span<const double> stress, const TextChart& chart) {
  if (strain.size() < 2 || !(strain.back() > strain.front())) return {};
  const auto columns = static_cast<std::size_t>(std::max(2, chart.columns));
  const std::vector<double> means = column_means(strain, stress, columns);
  const double most = *std::max_element(means.begin(), means.end());
  const double top = chart.stress_at_top > 0.0 ? std::min(chart.stress_at_top, most) : most;
  if (!(top > 0.0)) return {};
  constexpr int eighths = 8, label_width = 10;
  static constexpr const char* blocks[] = {" ",      "\u2581", "\u2582", "\u2583", "\u2584",
                                           "\u2585", "\u2586", "\u2587", "\u2588"};
  std::string text;
  if (most > 1.0000001 * top) {
    std::string cut;
    for (const double mean : means) cut += mean > top ? '+' : ' ';
    cut.erase(cut.find_last_not_of(' ') + 1);
    text += fmt::format("{:>{}}  {}\n", "", label_width, cut);
  }
  for (int row = chart.rows - 1; row >= 0; --row) {
    const std::string label = row == chart.rows - 1 ? io::quantity(top, io::Dimension::stress) : "";
    std::string line;
    std::size_t filled = 0;  // bytes up to the last column that is not empty
    for (const double mean : means) {
      const double height = std::clamp(mean / top, 0.0, 1.0) * chart.rows - row;
      const int part = std::clamp(static_cast<int>(std::lround(eighths * height)), 0, eighths);
      line += chart.unicode ? blocks[part] : (2 * part >= eighths ? "#" : " ");
      if (line.back() != ' ') filled = line.size();
    }
    text += fmt::format("{:>{}} {}{}\n", label, label_width, chart.unicode ? "\u2502" : "|", line.substr(0, filled));
  }
  const std::string end = io::quantity(strain.back(), io::Dimension::ratio) + " strain";
  const std::string begin = io::quantity(strain.front(), io::Dimension::ratio);
  const int between = std::max(1, static_cast<int>(columns) - static_cast<int>(begin.size() + end.size()));
  return text + fmt::format("{:>{}}  {}{:>{}}{}\n", "", label_width, begin, "", between, end);
}

}  // namespace perfora::report
