// What is here: the unit in which a result is drawn. What is not: results (optimize/), how texts show them (app/).
#pragma once

#include <string>

namespace perfora::report {

/// Number per SI unit, and the name of the result with its unit: "plateau stress (kPa)".
struct MeasureUnit {
  double scale = 1.0;
  std::string label;
};
/// By the end of the name: stresses in kPa, strains in per cent.
MeasureUnit measure_unit(const std::string& measure);

}  // namespace perfora::report
