// What is here: see measure_unit.h. What is not: drawing.
#include "report/measure_unit.h"

#include <algorithm>

namespace perfora::report {

MeasureUnit measure_unit(const std::string& measure) {
  std::string name = measure;
  std::replace(name.begin(), name.end(), '_', ' ');
  const auto ends = [&](const char* end) { return name.ends_with(end); };
  if (ends(" stress") || ends(" stress in window")) return {1e-3, name + " (kPa)"};
  if (ends(" strain")) return {100.0, name + " (%)"};
  if (name == "energy absorbed") return {1e-3, name + " (kJ/m3)"};
  return {1.0, name};
}

}  // namespace perfora::report
