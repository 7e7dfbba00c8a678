// What is here: one broken bond. What is not: why it broke (solver/laws.h), files (run_file.h).
#pragma once

#include <cstdint>

namespace perfora::results {

enum class BreakMode : std::uint8_t { tension = 0, shear = 1 };

/// One broken bond.
struct BreakEvent {
  double time = 0.0;    ///< s
  double strain = 0.0;  ///< engineering
  std::int32_t bond = 0;
  std::int32_t i = 0, j = 0;
  double x = 0.0, y = 0.0;  ///< midpoint, m
  BreakMode mode = BreakMode::tension;
  double energy = 0.0;  ///< U0 at the break, J/m
};

}  // namespace perfora::results
