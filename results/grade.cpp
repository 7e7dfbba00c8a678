// What is here: which numbers follow the grade, and how. What is not: why (docs/user/theory.md, "Grade, strength,
// scale").
#include "results/grade.h"

#include <cmath>
#include <string_view>
#include <variant>

#include "results/measure_table.h"

namespace perfora::results {
namespace {

void multiply(std::vector<double>& values, double factor) {
  for (double& value : values) value *= factor;
}

double factor_of_units(std::string_view units, const GradeChange& change) {
  if (units == "Pa" || units == "J/m") return change.stress;
  if (units == "s") return change.time;
  return units == "1/s" ? change.rate : 1.0;
}

double factor_of(io::Dimension dimension, const GradeChange& change) {
  using enum io::Dimension;
  switch (dimension) {
    case stress:
    case stiffness:
    case energy_density:
    case surface_energy:
      return change.stress;
    case time:
      return change.time;
    case rate:
      return change.rate;
    default:
      return 1.0;
  }
}

}  // namespace

GradeChange::GradeChange(double factor) : stress(factor), time(1.0 / std::sqrt(factor)), rate(std::sqrt(factor)) {}

void GradeChange::apply(History& history) const {
  for (const History::Column& column : History::columns())
    multiply(history.*column.values, factor_of_units(column.units, *this));
}

void GradeChange::apply(Summary& summary) const {
  for (const Measure& measure : measures())
    if (const auto* member = std::get_if<double Summary::*>(&measure.member))
      summary.** member *= factor_of(measure.dimension, *this);
  summary.impact_stress_per_rate *= stress * time;  // Pa s, which is no dimension of the table
  for (CurvePeak& peak : summary.peaks) peak.stress *= stress;
}

void GradeChange::apply(BreakEvent& event) const {
  event.time *= time;
  event.energy *= stress;
}

void GradeChange::apply(Frame& frame) const {
  frame.info.time *= time;
  multiply(frame.velocity, rate);
  multiply(frame.spin, rate);
  multiply(frame.stress, stress);
  multiply(frame.bond_normal_force, stress);
  multiply(frame.bond_shear_force, stress);
  multiply(frame.contact_normal_force, stress);
  multiply(frame.contact_shear_force, stress);
}

void GradeChange::apply(MaterialCurve& curve) const {
  for (auto* column : {&curve.stress, &curve.lateral_stress, &curve.damage, &curve.work, &curve.cundall})
    multiply(*column, stress);
}

Evaluation at_grade(Evaluation evaluation, double grade) {
  const GradeChange change(grade / evaluation.grade);
  change.apply(evaluation.summary);
  change.apply(evaluation.curve);
  evaluation.grade = grade;
  return evaluation;
}

}  // namespace perfora::results
