// What is here: the unit in which a result is drawn. What is not: the table of measures (results/measure_table.h), how
// texts show them (io/text.h).
#pragma once

#include <string>

namespace perfora::report {

/// Number per SI unit, and the name of the result with its unit: "plateau stress (kPa)".
struct MeasureUnit {
  double scale = 1.0;
  std::string label;
};
/// By the dimension in the table of measures: stresses in kPa, ratios in per cent, ... A plain number where it has
/// none.
MeasureUnit measure_unit(const std::string& measure);

}  // namespace perfora::report
