// What is here: the columns of a history, its CSV form. What is not: how it is computed.
#include "results/history.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <iterator>

namespace perfora::results {

const std::vector<History::Column>& History::columns() {
  static const std::vector<Column> list = {
      {"strain_yy", "", &History::strain_yy},
      {"strain_yy_log", "", &History::strain_yy_log},
      {"stress_yy", "Pa", &History::stress_yy},
      {"stress_xx", "Pa", &History::stress_xx},
      {"stress_xy", "Pa", &History::stress_xy},
      {"stress_asymmetry", "Pa", &History::stress_asymmetry},
      {"broken_bonds", "", &History::broken_bonds},
      {"fragments", "", &History::fragments},
      {"contacts", "", &History::contacts},
      {"time", "s", &History::time},
      {"rate", "1/s", &History::rate},
      {"external_work", "J/m", &History::external_work},
      {"elastic_bonds", "J/m", &History::elastic_bonds},
      {"elastic_contacts", "J/m", &History::elastic_contacts},
      {"kinetic", "J/m", &History::kinetic},
      {"damage", "J/m", &History::damage},
      {"friction", "J/m", &History::friction},
      {"viscous", "J/m", &History::viscous},
      {"cundall", "J/m", &History::cundall},
      {"steps", "", &History::steps, true, true},
      {"broken_in_tension", "", &History::broken_in_tension, true, true},
      {"largest_fragment", "", &History::largest_fragment, true, true},
      {"largest_overlap", "", &History::largest_overlap, true, true},
      {"largest_asymmetry", "Pa", &History::largest_asymmetry, true, true},
      {"peak_passed", "", &History::peak_passed, true, true},
      {"stress_before", "Pa", &History::stress_before, true, true},
      {"platen_stress_bottom", "Pa", &History::platen_stress_bottom, true},
      {"platen_stress_top", "Pa", &History::platen_stress_top, true},
      {"wall_stress_left", "Pa", &History::wall_stress_left, true},
      {"wall_stress_right", "Pa", &History::wall_stress_right, true},
  };
  return list;
}

namespace {

constexpr double curve_step = 0.005;
constexpr double fine_until = 0.03;  // rows up to here stay as they are: the first peak is narrow

std::vector<const History::Column*> filled(const History& history) {
  std::vector<const History::Column*> columns;
  for (const History::Column& column : History::columns())
    if (!column.internal && !(history.*column.values).empty()) columns.push_back(&column);
  return columns;
}

}  // namespace

std::size_t History::filled_columns() const {
  return filled(*this).size();
}

History History::up_to(double strain) const {
  const auto end = std::upper_bound(strain_yy.begin(), strain_yy.end(), strain + strain_rounding);
  const auto kept = static_cast<std::size_t>(end - strain_yy.begin());
  History shorter = *this;
  for (const Column& column : columns())
    if ((shorter.*column.values).size() > kept) (shorter.*column.values).resize(kept);
  return shorter;
}

History coarse_curve(const History& history) {
  History coarse;
  double strain = 0.0, stress = 0.0;
  int count = 0;
  for (std::size_t k = 0; k < history.rows(); ++k) {
    strain += history.strain_yy[k];
    stress += history.stress_yy[k];
    ++count;
    const bool last = k + 1 == history.rows();
    const bool fine = history.strain_yy[k] < fine_until;
    if (!last && !fine &&
        std::floor(history.strain_yy[k + 1] / curve_step) == std::floor(history.strain_yy[k] / curve_step))
      continue;
    coarse.strain_yy.push_back(strain / count);
    coarse.stress_yy.push_back(stress / count);
    strain = stress = 0.0;
    count = 0;
  }
  return coarse;
}

std::string history_csv(const History& history) {
  const std::vector<const History::Column*> columns = filled(history);
  fmt::memory_buffer out;
  for (std::size_t c = 0; c < columns.size(); ++c)
    fmt::format_to(std::back_inserter(out), "{}{}", c == 0 ? "" : ",", columns[c]->name);
  out.push_back('\n');
  for (std::size_t row = 0; row < history.rows(); ++row) {
    for (std::size_t c = 0; c < columns.size(); ++c)
      fmt::format_to(std::back_inserter(out), "{}{}", c == 0 ? "" : ",", (history.*columns[c]->values)[row]);
    out.push_back('\n');
  }
  return fmt::to_string(out);
}

}  // namespace perfora::results
