// What is here: sizes and angles of the disc state. What is not: its motion (integrator.cpp).
#include "solver/state.h"

#include <cmath>
#include <numbers>

namespace perfora::solver {

void DiscState::resize(std::size_t n) {
  for (auto* field : {&sx, &sy, &half_angle, &sx_before, &sy_before, &half_angle_before}) field->assign(n, 0);
  for (auto* field : {&vx, &vy, &omega, &fx, &fy, &torque, &radius, &mass, &inertia}) field->assign(n, 0.0);
  record.resize(n);
  motion.resize(n);
}

void DiscState::set_angle(std::size_t disc, double angle) {
  const double turns = angle / (4.0 * std::numbers::pi);
  half_angle[disc] = fixed_point(turns - std::floor(turns));
}

}  // namespace perfora::solver
