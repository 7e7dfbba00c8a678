// What is here: the history of a run as plain data, a column a quantity, and the one list of its columns. What is not:
// numbers read from it (measures.h), files (run_file.h).
#pragma once

#include <string>
#include <vector>

namespace perfora::results {

/// History of a run: equally long columns, one entry a row; stresses in Pa (compression positive), energies in J per
/// metre of depth. A stress is a mean
/// from half way to the row before to half way to the next one, and in the last row up to that row
/// (docs/user/formats.md says what it was before results_version 4); all else is at the row.
struct History {
  std::vector<double> strain_yy;  ///< engineering, compression positive
  std::vector<double> strain_yy_log;
  std::vector<double> stress_yy, stress_xx, stress_xy, stress_asymmetry;
  std::vector<double> broken_bonds, fragments, contacts;
  std::vector<double> time;
  std::vector<double> rate;  ///< of the strain, mean since the last row, 1/s; 0 in the first
  std::vector<double> external_work, elastic_bonds, elastic_contacts, kinetic, damage, friction, viscous, cundall;
  /// What the summary says of the end of a run, at each row: so that a longer run answers for a shorter one. In stored
  /// histories, not in tables for people.
  std::vector<double> steps, broken_in_tension;
  std::vector<double> largest_fragment;   ///< area over that of all discs
  std::vector<double> largest_overlap;    ///< so far, over <d>
  std::vector<double> largest_asymmetry;  ///< so far, Pa
  std::vector<double> peak_passed;        ///< 1 from the row on at which the first peak was known
  std::vector<double> stress_before;      ///< mean stress_yy from half way to the row before up to the row, Pa
  /// Normal force over the block's nominal edge; empty without platens or side walls.
  std::vector<double> platen_stress_bottom, platen_stress_top, wall_stress_left, wall_stress_right;

  /// Columns with their names and SI units, in file order (docs/user/formats.md).
  struct Column {
    const char* name;
    const char* units;
    std::vector<double> History::*values;
    bool optional = false;  ///< left out of files where it is empty
    bool internal = false;  ///< in result files only, not in tables for people
  };
  static const std::vector<Column>& columns();
  std::size_t rows() const { return strain_yy.size(); }
  std::size_t filled_columns() const;  ///< columns for people that hold a number a row
  /// Whether the columns from `steps` to `stress_before` are there (older files have none).
  bool knows_ends() const { return rows() > 0 && stress_before.size() == rows(); }
  /// Whether every column that a run fills is there.
  bool is_full() const { return rows() > 0 && cundall.size() == rows(); }
  /// The rows up to `strain`, included up to rounding.
  History up_to(double strain) const;
};
/// Strains that differ by less are one: a path adds up to its strains with such an error.
inline constexpr double strain_rounding = 1e-9;

/// A curve of at most some two hundred points: strain and stress averaged over steps of 0.5 % strain, unchanged below
/// 3 %. What journals keep.
History coarse_curve(const History& history);

/// The history as CSV: one line of names, then one line a row, 17 digits, SI (docs/user/formats.md). Columns that the
/// run has not got are left out.
std::string history_csv(const History& history);

}  // namespace perfora::results
