// What is here: the descent and when its lists are renewed.
// What is not: decisions about scales and pressures (jam.cpp).
#include "geometry/overlap_minimiser.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "geometry/plane.h"

namespace perfora::geometry {

namespace {
/// Fewer discs than this a thread cost more in waiting than they save.
constexpr std::size_t discs_per_thread = 8192;

/// Displacement over force and mass. Stiffnesses are of order one; 0.16 suits discs of alike size. Where a few large
/// discs touch very many small ones it is too much: going uphill soon after a start says so, and it is cut.
constexpr double first_push = 0.16;
constexpr double push_cut = 0.8;
constexpr double least_push = 0.01;
constexpr std::int64_t short_run = 50;
/// The momentum grows as k/(k + 3) with the iterations k since the last start (Nesterov's own sequence) up to this:
/// without a limit the soft modes of a nearly jammed packing swing back and forth between starts.
constexpr double momentum_delay = 3.0;
constexpr double largest_momentum = 0.985;

/// Near pairs, in the unit of length (about one diameter): wide while discs travel, narrow when they hardly move.
constexpr double wide_skin = 0.3;
constexpr double narrow_skin = 0.12;
/// A selection that lasted fewer iterations than this asks for the wide skin.
constexpr std::int64_t short_lived = 40;
/// How much farther the candidates reach: wide enough that discs on their way from a random start to rest are searched
/// a few times only.
constexpr double candidate_margin = 1.6;
constexpr std::int64_t iterations_between_checks = 10;

double momentum(std::int64_t age) {
  return std::min(largest_momentum, static_cast<double>(age) / (static_cast<double>(age) + momentum_delay));
}

}  // namespace

OverlapMinimiser::OverlapMinimiser(SoftDiscs discs, int threads, io::Cancellation cancellation)
    : discs_(std::move(discs)),
      threads_(std::clamp(threads, 1, static_cast<int>(1 + discs_.x.size() / discs_per_thread))),
      cancellation_(std::move(cancellation)),
      chunks_(static_cast<std::int64_t>((discs_.x.size() + chunk_size - 1) / chunk_size)),
      lists_(discs_.width, discs_.height, discs_.radius, threads_),
      push_(first_push),
      places_(discs_.x.size()),
      radius_(discs_.radius.begin(), discs_.radius.end()),
      force_sums_(static_cast<std::size_t>(chunks_)),
      overlap_sums_(force_sums_.size()),
      farthest_(force_sums_.size()) {
  const std::size_t n = discs_.x.size();
  constexpr std::size_t whole = static_cast<std::size_t>(lanes) / 2;  // discs in one vector
  for (auto* array : {&moved_, &selected_, &speed_, &force_, &inverse_mass_})
    array->resize((n + whole - 1) / whole * whole);
  double mean = 0.0;
  for (double r : discs_.radius) mean += r;
  mean /= static_cast<double>(std::max<std::size_t>(n, 1));
  for (std::size_t i = 0; i < n; ++i) {
    largest_radius_ = std::max(largest_radius_, discs_.radius[i]);
    places_[i] = {discs_.x[i], discs_.y[i]};
    const float inverse = static_cast<float>(mean / discs_.radius[i]);
    inverse_mass_[i] = {inverse, inverse};
  }
}

ChunkDiscs OverlapMinimiser::chunk(std::size_t k) {
  const std::size_t begin = k * chunk_size;
  ChunkDiscs discs;
  discs.count = std::min(chunk_size, moved_.size() - begin);
  discs.all_moved = moved_.data();
  discs.moved = moved_.data() + begin;
  discs.selected = selected_.data() + begin;
  discs.inverse_mass = inverse_mass_.data() + begin;
  discs.speed = speed_.data() + begin;
  discs.force = force_.data() + begin;
  return discs;
}

void OverlapMinimiser::take_over_moves() {
  for (std::size_t i = 0; i < places_.size(); ++i) {
    places_[i].x += static_cast<double>(moved_[i].x);
    places_[i].y += static_cast<double>(moved_[i].y);
    moved_[i] = {};
  }
}

void OverlapMinimiser::renew_lists(double scale, double skin) {
  float farthest = 0.0F;
  for (const Float2& m : moved_) farthest = std::max(farthest, m.x * m.x + m.y * m.y);
  const double growth = 2.0 * largest_radius_ * std::max(0.0, scale - searched_scale_);
  const double travelled = 2.0 * std::sqrt(static_cast<double>(farthest));
  if (!(skin + travelled + growth <= searched_margin_)) {
    take_over_moves();
    searched_scale_ = scale;
    searched_margin_ = candidate_margin;
    lists_.search(places_, scale, searched_margin_);
  }
  lists_.select(moved_, scale, skin);
  selected_ = moved_;
}

ForceSums OverlapMinimiser::sum_forces(double scale) {
#pragma omp parallel for schedule(static) num_threads(threads_)
  for (std::int64_t c = 0; c < chunks_; ++c) {
    const std::size_t k = static_cast<std::size_t>(c);
    force_sums_[k] = compute_forces(lists_.of_chunk(k), chunk(k), scale);
  }
  ForceSums total;
  for (const ForceSums& part : force_sums_) {
    total.squared += part.squared;
    total.power += part.power;
  }
  return total;
}

double OverlapMinimiser::move(const Motion& motion) {
#pragma omp parallel for schedule(static) num_threads(threads_)
  for (std::int64_t c = 0; c < chunks_; ++c) {
    const std::size_t k = static_cast<std::size_t>(c);
    farthest_[k] = move_discs(chunk(k), motion);
  }
  return *std::max_element(farthest_.begin(), farthest_.end());
}

OverlapState OverlapMinimiser::measure(double scale, const ForceSums& forces, const StopRule& stop,
                                       std::int64_t iteration) {
#pragma omp parallel for schedule(static) num_threads(threads_)
  for (std::int64_t c = 0; c < chunks_; ++c) {
    const std::size_t k = static_cast<std::size_t>(c);
    overlap_sums_[k] =
        measure_overlaps(lists_.of_chunk(k), chunk(k), radius_.data() + k * chunk_size, radius_.data(), scale);
  }
  OverlapSums sums;
  for (const OverlapSums& part : overlap_sums_) {
    sums.overlap += part.overlap;
    sums.virial += part.virial;
    sums.distance_squared += part.distance_squared;
    sums.contacts += part.contacts;
    sums.max_ratio = std::max(sums.max_ratio, part.max_ratio);
  }
  OverlapState state;
  const double area = discs_.width * discs_.height;
  // Each pair was met from both ends.
  state.pressure = 0.25 * sums.virial / area;
  state.stiffness = 0.25 * sums.distance_squared / area;
  state.mean_overlap = sums.contacts > 0.0 ? sums.overlap / sums.contacts : 0.0;
  state.max_overlap_ratio = sums.max_ratio;
  const double force = std::sqrt(forces.squared / static_cast<double>(places_.size()));
  state.residual = sums.contacts > 0.0 ? force / state.mean_overlap : 0.0;
  state.iterations = iteration;
  state.converged = state.residual <= stop.residual || state.max_overlap_ratio <= stop.negligible_overlap;
  return state;
}

OverlapState OverlapMinimiser::minimise(double scale, const StopRule& stop) {
  std::fill(speed_.begin(), speed_.end(), Float2{});
  double skin = narrow_skin;
  renew_lists(scale, skin);
  OverlapState state;
  std::int64_t listed_at = 0, age = 0;
  for (std::int64_t iteration = 0;; ++iteration) {
    const ForceSums forces = sum_forces(scale);
    if (iteration % iterations_between_checks == 0 || iteration >= stop.maximum_iterations) {
      if (cancellation_.requested()) throw io::Cancelled();
      state = measure(scale, forces, stop, iteration);
      if (state.converged || iteration >= stop.maximum_iterations) break;
    }
    if (forces.power < 0.0) {
      if (age < short_run) push_ = std::max(push_cut * push_, least_push);
      age = 0;
    }
    Motion motion;
    motion.momentum = static_cast<float>(momentum(age));
    motion.next_momentum = static_cast<float>(momentum(++age));
    motion.push = static_cast<float>(push_);
    if (move(motion) > 0.25 * skin * skin) {
      skin = iteration - listed_at < short_lived ? wide_skin : narrow_skin;
      listed_at = iteration;
      renew_lists(scale, skin);
    }
  }
  for (std::size_t i = 0; i < places_.size(); ++i) {
    discs_.x[i] = wrapped(places_[i].x + static_cast<double>(moved_[i].x), discs_.width);
    discs_.y[i] = wrapped(places_[i].y + static_cast<double>(moved_[i].y), discs_.height);
  }
  return state;
}

}  // namespace perfora::geometry
