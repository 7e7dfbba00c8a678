// What is here: vectors of floats as wide as the instruction set this file is compiled for likes them, and the few
// functions the bond loop needs (GCC vector extensions; intrinsics where the compiler does not find the instruction).
// What is not: loops. Include only from a kernel's .cpp; everything is in an unnamed namespace, so that code for one
// instruction set never serves another.
#pragma once

#include <cstdint>
#include <cstring>

#if defined(__AVX512F__) || defined(__AVX2__)
#include <immintrin.h>
#endif

#define PERFORA_INLINE __attribute__((always_inline)) inline

namespace perfora::solver {
namespace {

#if defined(__AVX512F__)
constexpr int lanes = 16;
#else
constexpr int lanes = 8;  // without AVX the compiler makes two vectors of four of each
#endif
using Floats = float __attribute__((vector_size(lanes * sizeof(float))));
using Ints = std::int32_t __attribute__((vector_size(lanes * sizeof(std::int32_t))));
using Unsigned = std::uint32_t __attribute__((vector_size(lanes * sizeof(std::uint32_t))));
using Bytes = std::int8_t __attribute__((vector_size(lanes)));
using Shorts = std::uint16_t __attribute__((vector_size(lanes * sizeof(std::uint16_t))));

PERFORA_INLINE Floats splat(float v) {
  return v - Floats{};  // the compiler broadcasts the scalar
}

PERFORA_INLINE Floats load(const float* from) {
  Floats v;
  std::memcpy(&v, from, sizeof v);
  return v;
}

PERFORA_INLINE void store(float* to, Floats v) {
  std::memcpy(to, &v, sizeof v);
}

/// v itself, which the compiler may not fuse with what comes after.
PERFORA_INLINE Floats rounded(Floats v) {
#if defined(__AVX512F__) || defined(__AVX2__)
  __asm__("" : "+v"(v));
#elif defined(__aarch64__)
  auto* half = reinterpret_cast<float __attribute__((vector_size(16)))*>(&v);
  __asm__("" : "+w"(half[0]), "+w"(half[1]));
#endif
  return v;
}

/// Unsigned 16-bit numbers as floats.
PERFORA_INLINE Floats load(const std::uint16_t* from) {
#if defined(__AVX512F__)
  return Floats(_mm512_cvtepi32_ps(_mm512_cvtepu16_epi32(_mm256_loadu_si256(reinterpret_cast<const __m256i*>(from)))));
#else
  Shorts v;
  std::memcpy(&v, from, sizeof v);
  return __builtin_convertvector(__builtin_convertvector(v, Ints), Floats);
#endif
}

/// Signed bytes as floats.
PERFORA_INLINE Floats load(const std::int8_t* from) {
#if defined(__AVX512F__)
  return Floats(_mm512_cvtepi32_ps(_mm512_cvtepi8_epi32(_mm_loadu_si128(reinterpret_cast<const __m128i*>(from)))));
#elif defined(__AVX2__)
  return Floats(_mm256_cvtepi32_ps(_mm256_cvtepi8_epi32(_mm_loadl_epi64(reinterpret_cast<const __m128i*>(from)))));
#else
  Bytes v;
  std::memcpy(&v, from, sizeof v);
  return __builtin_convertvector(__builtin_convertvector(v, Ints), Floats);
#endif
}

PERFORA_INLINE Floats root(Floats v) {
#if defined(__AVX512F__)
  return Floats(_mm512_sqrt_ps(__m512(v)));
#elif defined(__AVX2__)
  return Floats(_mm256_sqrt_ps(__m256(v)));
#else
  Floats r;
  for (int k = 0; k < lanes; ++k) r[k] = __builtin_sqrtf(v[k]);
  return r;
#endif
}

/// 1/sqrt(v), relative error below 1e-4: a first guess.
PERFORA_INLINE Floats inverse_root(Floats v) {
#if defined(__AVX512F__)
  return Floats(_mm512_rsqrt14_ps(__m512(v)));
#else
  return 1.0f / root(v);
#endif
}

PERFORA_INLINE Floats magnitude(Floats v) {
  return v < 0.0f ? -v : v;
}

/// One bit a lane where a > limit.
PERFORA_INLINE std::uint32_t above(Floats a, float limit) {
#if defined(__AVX512F__)
  return _mm512_cmp_ps_mask(__m512(a), _mm512_set1_ps(limit), _CMP_GT_OQ);
#elif defined(__AVX2__)
  return static_cast<std::uint32_t>(_mm256_movemask_ps(_mm256_cmp_ps(__m256(a), _mm256_set1_ps(limit), _CMP_GT_OQ)));
#else
  std::uint32_t bits = 0;
  for (int k = 0; k < lanes; ++k) bits |= static_cast<std::uint32_t>(a[k] > limit) << k;
  return bits;
#endif
}

PERFORA_INLINE float sum(const Floats& v) {
  float half[lanes / 2];
  for (int k = 0; k < lanes / 2; ++k) half[k] = v[k] + v[k + lanes / 2];
  for (int width = lanes / 4; width > 0; width /= 2)
    for (int k = 0; k < width; ++k) half[k] += half[k + width];
  return half[0];
}

/// The four fields of the 16-byte records at base + offset[lane], each record loaded whole, then transposed four by
/// four. Measured against gathers of the fields, which take 1.4 times as long (docs/developer/performance.md).
struct Fields {
  Ints x, y;
  Floats c, s;
};
PERFORA_INLINE Fields load_records(const char* base, const std::int32_t* offset) {
#if defined(__AVX512F__)
  const auto four = [&](int k) __attribute__((always_inline)) {
    const auto at = [&](int lane) __attribute__((always_inline)) {
      return _mm_load_ps(reinterpret_cast<const float*>(base + offset[lane]));
    };
    __m512 r = _mm512_castps128_ps512(at(k));
    r = _mm512_insertf32x4(r, at(k + 4), 1);
    r = _mm512_insertf32x4(r, at(k + 8), 2);
    return _mm512_insertf32x4(r, at(k + 12), 3);
  };
  const __m512 r0 = four(0), r1 = four(1), r2 = four(2), r3 = four(3);
  const __m512 a = _mm512_unpacklo_ps(r0, r1), b = _mm512_unpackhi_ps(r0, r1), c = _mm512_unpacklo_ps(r2, r3),
               d = _mm512_unpackhi_ps(r2, r3);
  return {Ints(_mm512_shuffle_ps(a, c, 0x44)), Ints(_mm512_shuffle_ps(a, c, 0xEE)),
          Floats(_mm512_shuffle_ps(b, d, 0x44)), Floats(_mm512_shuffle_ps(b, d, 0xEE))};
#elif defined(__AVX2__)
  const auto two = [&](int k) __attribute__((always_inline)) {
    const auto at = [&](int lane) __attribute__((always_inline)) {
      return _mm_load_ps(reinterpret_cast<const float*>(base + offset[lane]));
    };
    return _mm256_insertf128_ps(_mm256_castps128_ps256(at(k)), at(k + 4), 1);
  };
  const __m256 r0 = two(0), r1 = two(1), r2 = two(2), r3 = two(3);
  const __m256 a = _mm256_unpacklo_ps(r0, r1), b = _mm256_unpackhi_ps(r0, r1), c = _mm256_unpacklo_ps(r2, r3),
               d = _mm256_unpackhi_ps(r2, r3);
  return {Ints(_mm256_shuffle_ps(a, c, 0x44)), Ints(_mm256_shuffle_ps(a, c, 0xEE)),
          Floats(_mm256_shuffle_ps(b, d, 0x44)), Floats(_mm256_shuffle_ps(b, d, 0xEE))};
#else
  Fields f;
  for (int k = 0; k < lanes; ++k) {
    struct {
      std::int32_t x, y;
      float c, s;
    } r;
    std::memcpy(&r, base + offset[k], sizeof r);
    f.x[k] = r.x;
    f.y[k] = r.y;
    f.c[k] = r.c;
    f.s[k] = r.s;
  }
  return f;
#endif
}

}  // namespace
}  // namespace perfora::solver
