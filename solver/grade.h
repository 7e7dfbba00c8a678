// What is here: the run at grade 1 that a run of another grade is computed from. What is not: what becomes of its
// results (results/grade.h).
#pragma once

#include "solver/options.h"

namespace perfora::solver {

/// Grade multiplies both stiffnesses and leaves critical displacements and densities, so a block of grade g goes
/// through the same states as one of grade 1, faster by sqrt(g) (docs/user/theory.md, "Grade, strength, scale"). These
/// are the options of that run: grade 1, and the rate, where one is set, over sqrt(g).
SolverOptions at_grade_one(SolverOptions options);

}  // namespace perfora::solver
