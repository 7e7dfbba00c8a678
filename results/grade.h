// What is here: results of a run at one grade of the material turned into those at another. What is not: the run
// (solver/grade.h), which stored evaluation answers a request (optimize/evaluate/answers.h).
#pragma once

#include "results/break_event.h"
#include "results/evaluation.h"
#include "results/frame.h"
#include "results/material_file.h"

namespace perfora::results {

/// What numbers are multiplied with when both stiffnesses become `factor` times as large at the same critical
/// displacements and densities (docs/user/theory.md, "Grade, strength, scale"): stresses and energies `factor`, times
/// 1/sqrt(factor), rates sqrt(factor); strains, displacements and counts stay. A factor of 1 leaves every bit, a power
/// of two every digit of stresses and energies.
struct GradeChange {
  explicit GradeChange(double factor);
  double stress, time, rate;

  void apply(History& history) const;
  void apply(Summary& summary) const;
  void apply(BreakEvent& event) const;
  void apply(Frame& frame) const;
  void apply(MaterialCurve& curve) const;
};

/// An evaluation, curve and all, as it would have been at another grade.
Evaluation at_grade(Evaluation evaluation, double grade);

}  // namespace perfora::results
