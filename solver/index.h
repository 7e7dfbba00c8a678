// What is here: indices of discs, bonds and rows as containers take them.
#pragma once

#include <cstddef>
#include <cstdint>

namespace perfora::solver {

/// An index that is not negative.
inline std::size_t at(std::int64_t k) {
  return static_cast<std::size_t>(k);
}

}  // namespace perfora::solver
