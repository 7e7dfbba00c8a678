// What is here: units of axes by the dimension of a measure. What is not: drawing.
#include "report/measure_unit.h"

#include <algorithm>

#include "results/measure_table.h"

namespace perfora::report {

MeasureUnit measure_unit(const std::string& measure) {
  std::string name = measure;
  std::replace(name.begin(), name.end(), '_', ' ');
  const results::Measure* known = results::measure_called(measure);
  switch (known ? known->dimension : io::Dimension::none) {
    case io::Dimension::stress:
      return {1e-3, name + " (kPa)"};
    case io::Dimension::ratio:
      return {100.0, name + " (%)"};
    case io::Dimension::length:
      return {1e3, name + " (mm)"};
    case io::Dimension::time:
      return {1e6, name + " (us)"};
    case io::Dimension::rate:
      return {1.0, name + " (1/s)"};
    case io::Dimension::energy_density:
      return {1e-3, name + " (kJ/m3)"};
    default:
      return {1.0, name};
  }
}

}  // namespace perfora::report
