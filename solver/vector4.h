// What is here: four doubles as one vector (GCC vector extensions: the same lanes and bits on every instruction set)
// and the few functions the kernels need. What is not: kernels. Include only from a kernel's .cpp: everything here is
// inlined into code built for several instruction sets.
#pragma once

#include <cstdint>

#define PERFORA_INLINE __attribute__((always_inline)) inline

#pragma GCC diagnostic ignored "-Wpsabi"

namespace perfora::solver {
namespace {

constexpr int lanes = 4;
using Vector = double __attribute__((vector_size(lanes * sizeof(double))));
using Mask = std::int64_t __attribute__((vector_size(lanes * sizeof(std::int64_t))));

PERFORA_INLINE Vector splat(double v) {
  return Vector{v, v, v, v};
}
PERFORA_INLINE double sum(const Vector& v) {
  return (v[0] + v[1]) + (v[2] + v[3]);
}

/// Nearest integer of |v| < 2^51, ties to even, by the addition that pushes the fraction out: one instruction set for
/// all.
PERFORA_INLINE Vector nearest(Vector v) {
  const Vector magic = splat(6755399441055744.0);  // 1.5 x 2^52
  return (v + magic) - magic;
}

PERFORA_INLINE Vector root(Vector v) {
  Vector r;
  for (int k = 0; k < lanes; ++k) r[k] = __builtin_sqrt(v[k]);
  return r;
}

PERFORA_INLINE Vector half_integer_power_of(Vector base, int twice_exponent) {
  Vector result = (twice_exponent & 1) ? root(base) : splat(1.0);
  for (int rest = twice_exponent >> 1; rest > 0; rest >>= 1) {
    if (rest & 1) result *= base;
    base *= base;
  }
  return result;
}

PERFORA_INLINE Vector magnitude(Vector v) {
  return v < 0.0 ? -v : v;
}

/// Whether any lane of a comparison is true.
PERFORA_INLINE bool any(Mask mask) {
  const Mask folded = mask | __builtin_shuffle(mask, Mask{2, 3, 0, 1});
  return (folded[0] | folded[1]) != 0;
}

}  // namespace
}  // namespace perfora::solver
