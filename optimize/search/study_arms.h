// What is here: from the [variables] and [arms] tables of a study file to continuous variables and a list of arms with
// their shares of maxeval. What is not: reading the file (study.h).
#pragma once

#include <vector>

#include "optimize/search/study.h"

namespace perfora::optimize {

/// Entries of both tables, keys without the table's name ("layout.diameter"; in [arms] "rows" stands for
/// "layout.rows").
struct ArmEntries {
  std::vector<io::Entry> variables, arms;
};

/// Sets study.variables from the entries with real keys. Throws io::InputError for unknown keys, empty bounds, bounds
/// out of range, no variable.
void make_variables(Study& study, const ArmEntries& entries);

/// Sets study.arms: the product of all choices (integer keys of [variables] are ranges [lowest, highest]; [arms] lists
/// single values) and starts. Arms that cannot be laid, and those with the same holes and start as one before them, are
/// left out with a warning. They have no candidates yet. Throws io::InputError.
void make_arms(Study& study, const ArmEntries& entries);

/// Gives each arm its part of maxeval, as `allocation` says; arms that get none are left out. `origin` is that of the
/// key. Throws io::InputError.
void allocate(Study& study, const io::Origin& origin);

/// Point number `index` (from 0) of Halton's sequence in [0, 1)^dimension.
std::vector<double> halton_point(int index, int dimension);

/// `total` shared by weights >= 0 by largest remainders; equal weights where all are zero.
std::vector<int> share_out(int total, const std::vector<double>& weights);

}  // namespace perfora::optimize
