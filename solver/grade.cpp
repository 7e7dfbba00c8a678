// What is here: options at grade 1.
#include "solver/grade.h"

#include <cmath>

namespace perfora::solver {

SolverOptions at_grade_one(SolverOptions options) {
  options.loading.rate /= std::sqrt(options.material.grade);
  options.material.grade = 1.0;
  return options;
}

}  // namespace perfora::solver
