// What is here: the columns of a history, the names of states. What is not: how either is computed.
#include "solver/response.h"

namespace perfora::solver {

const char* status_name(RunStatus status) {
  switch (status) {
    case RunStatus::completed:
      return "completed";
    case RunStatus::stopped:
      return "stopped";
    case RunStatus::failed:
      return "failed";
  }
  return "failed";
}

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
      {"platen_stress_bottom", "Pa", &History::platen_stress_bottom, true},
      {"platen_stress_top", "Pa", &History::platen_stress_top, true},
      {"wall_stress_left", "Pa", &History::wall_stress_left, true},
      {"wall_stress_right", "Pa", &History::wall_stress_right, true},
  };
  return list;
}

}  // namespace perfora::solver
