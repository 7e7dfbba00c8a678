// What is here: what a study demands of a layout before anything is simulated, as smooth normalised numbers.
// What is not: the score of a simulation (objective.h).
#pragma once

#include <span>
#include <string>
#include <vector>

#include "io/schema.h"
#include "optimize/evaluate/design.h"

namespace perfora::optimize {

/// [constraints] of a study.
struct ConstraintKeys {
  double thinnest_wall =
      0.0;  ///< m; smallest wall allowed. The horizon of the bonds and layout.minimum_wall hold as well
  std::vector<double> porosity;  ///< lowest and highest fraction of the cell that the perforations take; empty: any
};

void describe(io::Schema& schema, ConstraintKeys& keys);

/// What constraints are measured on; no disc is placed.
struct LayoutMeasure {
  bool placed = false;  ///< false: the layout cannot be laid at all (`problem` says why)
  std::string problem;
  double thinnest_wall = 0.0;  ///< m; negative where holes overlap, infinite without holes
  double porosity = 0.0;       ///< area of the perforations over that of the cell, overlaps counted twice
};
LayoutMeasure measure_layout(const DesignFile& design);

/// g, one number a constraint, kept where g <= 0: (wanted wall - wall)/wanted wall; (lowest - porosity)/highest;
/// (porosity - highest)/highest. The wanted wall is the largest of thinnest_wall, layout.minimum_wall and the horizon
/// (a bond may not span a wall). Always finite, within [-1e3, 1e3]; 1 everywhere when the layout cannot be laid. The
/// number of entries depends on `keys` only.
std::vector<double> constraint_values(const ConstraintKeys& keys, const DesignFile& design,
                                      const LayoutMeasure& measure);
std::vector<std::string> constraint_names(const ConstraintKeys& keys);
/// What candidates of `design` must keep, a line each.
std::vector<std::string> in_words(const ConstraintKeys& keys, const Design& design);

/// Sum of the positive entries; 0: all are kept. A border is kept up to 1e-9.
double violation(std::span<const double> values);

/// Score of a candidate that breaks a constraint and so costs no simulation: 1000 (1 + violation), above that of every
/// simulated one.
double violation_score(double violation);

}  // namespace perfora::optimize
