// What is here: the history of a run as plain data, a column a quantity, and the one list of its columns. What is not:
// numbers read from it (measures.h), files (run_file.h).
#pragma once

#include <string>
#include <vector>

namespace perfora::results {

/// History of a run: equally long columns, one entry a row; stresses in Pa (compression positive), energies in J per
/// metre of depth. Stresses are means since the last row; all else is at the row.
struct History {
  std::vector<double> strain_yy;  ///< engineering, compression positive
  std::vector<double> strain_yy_log;
  std::vector<double> stress_yy, stress_xx, stress_xy, stress_asymmetry;
  std::vector<double> broken_bonds, fragments, contacts;
  std::vector<double> time;
  std::vector<double> rate;  ///< of the strain, mean since the last row, 1/s; 0 in the first
  std::vector<double> external_work, elastic_bonds, elastic_contacts, kinetic, damage, friction, viscous, cundall;
  /// Normal force over the block's nominal edge; empty without platens or side walls.
  std::vector<double> platen_stress_bottom, platen_stress_top, wall_stress_left, wall_stress_right;

  /// Columns with their names and SI units, in file order (docs/user/formats.md).
  struct Column {
    const char* name;
    const char* units;
    std::vector<double> History::*values;
    bool optional = false;  ///< left out of files where it is empty
  };
  static const std::vector<Column>& columns();
  std::size_t rows() const { return strain_yy.size(); }
  std::size_t filled_columns() const;  ///< columns that hold a number a row
};

/// The history as CSV: one line of names, then one line a row, 17 digits, SI (docs/user/formats.md). Columns that the
/// run has not got are left out.
std::string history_csv(const History& history);

}  // namespace perfora::results
