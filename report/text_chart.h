// What is here: a curve drawn in block characters, for terminals. What is not: pictures (plot.h).
#pragma once

#include <span>
#include <string>

namespace perfora::report {

struct TextChart {
  int columns = 64, rows = 8;  ///< of the area below the curve
  double stress_at_top = 0.0;  ///< Pa; what is higher stands full, with a '+' over it; 0: the largest
  bool unicode = true;         ///< eighths of a character; otherwise '#'
};

/// Stress over strain (engineering, Pa, equally long, strain rising) as filled columns, each the mean of its samples,
/// with both axes: rows + 2 lines and one of '+' where something is cut off. Empty for fewer than two samples or none
/// above zero.
std::string text_chart(std::span<const double> strain, std::span<const double> stress, const TextChart& chart);

}  // namespace perfora::report
