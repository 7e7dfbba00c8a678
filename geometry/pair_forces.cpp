// What is here: forces and energy of overlapping pairs, and the moves of the minimiser, eight at a time. Vectors of
// eight floats (GCC vector extensions: the same lanes, and IEEE operations only, so the bits do not depend on the
// instruction set). What is not: any choice of pairs.
#include "geometry/pair_forces.h"

#include <algorithm>
#include <cmath>

#if defined(__x86_64__) && defined(__GNUC__) && !defined(__clang__) && !defined(__SANITIZE_THREAD__) && \
    !defined(__SANITIZE_ADDRESS__)
#define PERFORA_CLONES __attribute__((target_clones("avx2", "default")))
#else
#define PERFORA_CLONES
#endif
#define PERFORA_INLINE __attribute__((always_inline)) inline

namespace perfora::geometry {

namespace {

using Vector = float __attribute__((vector_size(lanes * sizeof(float)), may_alias));
using Half = float __attribute__((vector_size(lanes / 2 * sizeof(float)), may_alias));
using Point = float __attribute__((vector_size(2 * sizeof(float)), may_alias));

/// Added to squared distances so that coincident centres do not divide by zero.
constexpr float coincident = 1e-30F;

PERFORA_INLINE Vector load(const float* from) {
  Vector v;
  __builtin_memcpy(&v, from, sizeof v);
  return v;
}

PERFORA_INLINE Vector root(Vector v) {
  Vector r;
  for (int k = 0; k < lanes; ++k) r[k] = __builtin_sqrtf(v[k]);
  return r;
}

PERFORA_INLINE Vector positive_part(Vector v) {
  return v > 0.0F ? v : Vector{};
}

PERFORA_INLINE double sum(Vector v) {
  double total = 0.0;
  for (int k = 0; k < lanes; ++k) total += static_cast<double>(v[k]);
  return total;
}

PERFORA_INLINE Half join(Point a, Point b) {
  return __builtin_shufflevector(a, b, 0, 1, 2, 3);
}

/// Four discs' points, x and y in turn.
template <class Index>
PERFORA_INLINE Vector gather(const Point* points, const Index* k) {
  return __builtin_shufflevector(join(points[k[0]], points[k[1]]), join(points[k[2]], points[k[3]]), 0, 1, 2, 3, 4, 5,
                                 6, 7);
}

/// Adds sign times four points to those of four discs, one after the other: a disc may be there twice.
template <int sign, class Index>
PERFORA_INLINE void scatter(Point* points, const Index* k, Vector v) {
  const Half low = __builtin_shufflevector(v, v, 0, 1, 2, 3), high = __builtin_shufflevector(v, v, 4, 5, 6, 7);
  const Point part[] = {__builtin_shufflevector(low, low, 0, 1), __builtin_shufflevector(low, low, 2, 3),
                        __builtin_shufflevector(high, high, 0, 1), __builtin_shufflevector(high, high, 2, 3)};
  for (int n = 0; n < lanes / 2; ++n) points[k[n]] = sign > 0 ? points[k[n]] + part[n] : points[k[n]] - part[n];
}

/// Eight pairs: vectors between centres (pairs 0 to 3, 4 to 7) and, in the order of lane_of_reach, squared distances.
struct Separation {
  Vector low, high, squared;
};

template <class Index>
PERFORA_INLINE Separation separation(const PairGroup<Index>& group, const Point* first, const Point* second) {
  const Vector* apart = reinterpret_cast<const Vector*>(group.apart);
  Separation s;
  s.low = apart[0] + (gather(second, group.second) - gather(first, group.first));
  s.high = apart[1] + (gather(second, group.second + 4) - gather(first, group.first + 4));
  const Vector low = s.low * s.low, high = s.high * s.high;
  s.squared = __builtin_shufflevector(low, high, 0, 2, 8, 10, 4, 6, 12, 14) +
              __builtin_shufflevector(low, high, 1, 3, 9, 11, 5, 7, 13, 15) + coincident;
  return s;
}

template <class Index>
PERFORA_INLINE Vector reach_of(const PairGroup<Index>& group) {
  return *reinterpret_cast<const Vector*>(group.reach);
}

template <bool both, class Index>
PERFORA_INLINE void add_forces(const PairTable<Index>& table, const Point* first, const Point* second, Point* force,
                               float scale) {
  const PairGroup<Index>* groups = table.near.data();
  for (const PairGroup<Index>* group = groups; group != groups + table.near_groups; ++group) {
    const Separation s = separation(*group, first, second);
    const Vector distance = root(s.squared);
    const Vector factor = positive_part(scale * reach_of(*group) - distance) / distance;
    const Vector low = __builtin_shufflevector(factor, factor, 0, 0, 1, 1, 4, 4, 5, 5) * s.low;
    const Vector high = __builtin_shufflevector(factor, factor, 2, 2, 3, 3, 6, 6, 7, 7) * s.high;
    scatter<-1>(force, group->first, low);
    scatter<-1>(force, group->first + 4, high);
    if constexpr (both) {
      scatter<1>(force, group->second, low);
      scatter<1>(force, group->second + 4, high);
    }
  }
}

PERFORA_CLONES void chunk_forces(const ChunkPairs& pairs, const Float2* moved, const Float2* all_moved, Float2* force,
                                 float scale) {
  const Point* own = reinterpret_cast<const Point*>(moved);
  add_forces<true>(pairs.inner, own, own, reinterpret_cast<Point*>(force), scale);
  add_forces<false>(pairs.outer, own, reinterpret_cast<const Point*>(all_moved), reinterpret_cast<Point*>(force),
                    scale);
}

/// Sums over arrays of numbers, `count` a multiple of the lanes.
PERFORA_CLONES void sum_forces(const float* force, const float* speed, const float* inverse_mass, std::size_t count,
                               double* sums) {
  Vector squared{}, power{};
  for (std::size_t k = 0; k < count; k += lanes) {
    const Vector f = load(force + k);
    squared += f * f * load(inverse_mass + k);
    power += f * load(speed + k);
  }
  sums[0] = sum(squared);
  sums[1] = sum(power);
}

PERFORA_CLONES void move(const float* force, const float* inverse_mass, float* speed, float* moved, std::size_t count,
                         const Motion& motion) {
  const float momentum = motion.momentum, next_momentum = motion.next_momentum, push = motion.push;
  for (std::size_t k = 0; k < count; ++k) {
    const float pushed = push * (force[k] * inverse_mass[k]);
    speed[k] = momentum * speed[k] + pushed;
    moved[k] += next_momentum * speed[k] + pushed;
  }
}

PERFORA_CLONES float farthest(const float* moved, const float* from, std::size_t count) {
  Vector largest{};
  for (std::size_t k = 0; k < count; k += lanes) {
    Vector v = load(moved + k) - load(from + k);
    v *= v;
    v += __builtin_shufflevector(v, v, 1, 0, 3, 2, 5, 4, 7, 6);
    largest = v > largest ? v : largest;
  }
  float result = 0.0F;
  for (int lane = 0; lane < lanes; ++lane) result = largest[lane] > result ? largest[lane] : result;
  return result;
}

template <class Index>
PERFORA_INLINE void add_overlaps(const PairTable<Index>& table, const Float2* first, const Float2* second,
                                 const float* first_radius, const float* second_radius, float scale, double ends,
                                 OverlapSums& sums) {
  Vector overlaps{}, virial{}, squared{}, contacts{}, ratio{};
  for (std::size_t g = 0; g < table.near_groups; ++g) {
    const PairGroup<Index>& group = table.near[g];
    const Separation s =
        separation(group, reinterpret_cast<const Point*>(first), reinterpret_cast<const Point*>(second));
    const Vector distance = root(s.squared), overlap = positive_part(scale * reach_of(group) - distance);
    Vector smaller;
    for (int k = 0; k < lanes; ++k) {
      const float a = first_radius[group.first[k]], b = second_radius[group.second[k]];
      smaller[lane_of_reach[k]] = a < b ? a : b;
    }
    overlaps += overlap;
    virial += overlap * distance;
    squared += overlap > 0.0F ? s.squared : Vector{};
    contacts += overlap > 0.0F ? Vector{} + 1.0F : Vector{};
    const Vector here = overlap / smaller;
    ratio = here > ratio ? here : ratio;
  }
  sums.overlap += ends * sum(overlaps);
  sums.virial += ends * sum(virial);
  sums.distance_squared += ends * sum(squared);
  sums.contacts += ends * sum(contacts);
  for (int k = 0; k < lanes; ++k) {
    const double here = 0.5 * static_cast<double>(ratio[k]) / static_cast<double>(scale);
    sums.max_ratio = here > sums.max_ratio ? here : sums.max_ratio;
  }
}

PERFORA_CLONES void chunk_overlaps(const ChunkPairs& pairs, const ChunkDiscs& discs, const float* radius,
                                   const float* all_radii, float scale, OverlapSums& sums) {
  add_overlaps(pairs.inner, discs.moved, discs.moved, radius, radius, scale, 2.0, sums);
  add_overlaps(pairs.outer, discs.moved, discs.all_moved, radius, all_radii, scale, 1.0, sums);
}

template <class Index>
PERFORA_INLINE void keep_near(PairTable<Index>& table, const Float2* first, const Float2* second, float scale,
                              float skin) {
  std::size_t kept = 0;
  PairGroup<Index>* near = table.near.data();
  for (const PairGroup<Index>*group = table.candidates.data(), *end = group + table.candidates.size(); group != end;
       ++group) {
    const Separation s =
        separation(*group, reinterpret_cast<const Point*>(first), reinterpret_cast<const Point*>(second));
    const Vector far = scale * reach_of(*group) + skin;
    const auto is_near = s.squared < far * far;
    for (int k = 0; k < lanes; ++k) {
      // Written in any case and kept where near: no branch to guess.
      PairGroup<Index>& to = near[kept / lanes];
      const std::size_t lane = kept % lanes;
      to.apart[lane] = group->apart[k];
      to.reach[lane_of_reach[lane]] = group->reach[lane_of_reach[k]];
      to.first[lane] = group->first[k];
      to.second[lane] = group->second[k];
      kept += is_near[lane_of_reach[k]] != 0;
    }
  }
  table.near_groups = (kept + lanes - 1) / lanes;
  for (; kept % lanes != 0; ++kept) {
    PairGroup<Index>& to = near[kept / lanes];
    const std::size_t lane = kept % lanes;
    to.apart[lane] = {};
    to.reach[lane_of_reach[lane]] = 0.0F;
    to.first[lane] = 0;
    to.second[lane] = 0;
  }
}

PERFORA_CLONES void chunk_selection(ChunkPairs& pairs, const Float2* moved, const Float2* all_moved, float scale,
                                    float skin) {
  keep_near(pairs.inner, moved, moved, scale, skin);
  keep_near(pairs.outer, moved, all_moved, scale, skin);
}

}  // namespace

PERFORA_CLONES void mark_near(const float* x, const float* y, const float* radius, float at_x, float at_y, float reach,
                              std::size_t count, std::int32_t* is_near) {
  for (std::size_t k = 0; k < count; ++k) {
    const float dx = x[k] - at_x, dy = y[k] - at_y, far = radius[k] + reach;
    is_near[k] = dx * dx + dy * dy < far * far ? 1 : 0;
  }
}

ForceSums compute_forces(const ChunkPairs& pairs, const ChunkDiscs& discs, double scale) {
  std::fill_n(discs.force, discs.count, Float2{});
  chunk_forces(pairs, discs.moved, discs.all_moved, discs.force, static_cast<float>(scale));
  double sums[2];
  sum_forces(&discs.force->x, &discs.speed->x, &discs.inverse_mass->x, 2 * discs.count, sums);
  return {sums[0], sums[1]};
}

OverlapSums measure_overlaps(const ChunkPairs& pairs, const ChunkDiscs& discs, const float* radius,
                             const float* all_radii, double scale) {
  OverlapSums sums;
  chunk_overlaps(pairs, discs, radius, all_radii, static_cast<float>(scale), sums);
  return sums;
}

double move_discs(const ChunkDiscs& discs, const Motion& motion) {
  move(&discs.force->x, &discs.inverse_mass->x, &discs.speed->x, &discs.moved->x, 2 * discs.count, motion);
  return static_cast<double>(farthest(&discs.moved->x, &discs.selected->x, 2 * discs.count));
}

void select_near(ChunkPairs& pairs, const Float2* moved, const Float2* all_moved, double scale, double skin) {
  chunk_selection(pairs, moved, all_moved, static_cast<float>(scale), static_cast<float>(skin));
}

}  // namespace perfora::geometry
