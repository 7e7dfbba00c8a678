// What is here: Verlet lists, overlap forces and the FIRE loop.
// What is not: decisions about scales and pressures (jam.cpp).
#include "geometry/overlap_minimiser.h"

#include <algorithm>
#include <cmath>

#include "geometry/cell_grid.h"

namespace perfora::geometry {

namespace {

/// Fewer discs than this a thread cost more in waiting than they save, above all on a busy machine.
constexpr std::size_t discs_per_thread = 8192;
/// Discs a reduction sums in one go: fixed, so that sums do not depend on the number of threads.
constexpr std::size_t chunk_size = 1024;

// FIRE as in Guenole et al. 2020, table 2, for masses and stiffnesses of order one (highest frequency about 4, so that
// a step of 0.42 is stable).
constexpr double first_step = 0.1;
constexpr double longest_step = 0.42;
constexpr double shortest_step = 0.02;
constexpr double first_steer = 0.25;
constexpr double steer_decay = 0.99;
constexpr double step_growth = 1.1;
constexpr double step_cut = 0.5;
constexpr int steps_before_growth = 20;
/// Verlet skin, in the unit of length (about one diameter): wide while discs travel, narrow when they hardly move.
constexpr double wide_skin = 0.45;
constexpr double narrow_skin = 0.12;
/// A list that lasted fewer iterations than this asks for the wide skin.
constexpr std::int64_t short_lived_list = 40;
constexpr std::int64_t iterations_between_checks = 10;
/// Added to squared distances so that coincident centres do not divide by zero.
constexpr double coincident = 1e-30;

}  // namespace

OverlapMinimiser::OverlapMinimiser(SoftDiscs discs, int threads)
    : discs_(std::move(discs)),
      chunks_((discs_.x.size() + chunk_size - 1) / chunk_size),
      team_(std::clamp(threads, 1, static_cast<int>(1 + discs_.x.size() / discs_per_thread))),
      places_(discs_.x.size()),
      neighbours_(chunks_),
      list_end_(discs_.x.size()) {
  const std::size_t n = discs_.x.size();
  for (auto* array : {&mass_, &inverse_mass_, &force_x_, &force_y_, &speed_x_, &speed_y_, &listed_x_, &listed_y_})
    array->assign(n, 0.0);
  double mean = 0.0;
  for (double r : discs_.radius) mean += r;
  mean /= static_cast<double>(std::max<std::size_t>(n, 1));
  for (std::size_t i = 0; i < n; ++i) {
    mass_[i] = discs_.radius[i] / mean;
    inverse_mass_[i] = 1.0 / mass_[i];
    places_[i] = {discs_.x[i], discs_.y[i], discs_.radius[i], 0.0};
  }
}

void OverlapMinimiser::wrap_positions() {
  const auto wrap = [](double value, double period) {
    value -= period * std::floor(value / period);
    return value < period ? value : 0.0;
  };
  for (Place& place : places_) {
    place.x = wrap(place.x, discs_.width);
    place.y = wrap(place.y, discs_.height);
  }
}

void OverlapMinimiser::build_lists(double skin) {
  wrap_positions();
  const std::size_t n = places_.size();
  double largest = 0.0;
  for (const Place& place : places_) largest = std::max(largest, place.radius);
  const CellGrid grid(discs_.width, discs_.height, 2.0 * largest + skin, n,
                      [this](std::size_t i) { return places_[i]; });
  const double half_width = 0.5 * discs_.width, half_height = 0.5 * discs_.height;
  team_.for_each(chunks_, [&](std::size_t chunk) {
    std::vector<std::int32_t>& list = neighbours_[chunk];
    list.clear();
    for (std::size_t i = chunk * chunk_size; i < std::min(n, (chunk + 1) * chunk_size); ++i) {
      const Place here = places_[i];
      grid.for_each_near(here.x, here.y, [&](std::int32_t other) {
        const Place& there = places_[static_cast<std::size_t>(other)];
        const double ax = nearest_image(there.x - here.x, discs_.width, half_width);
        const double ay = nearest_image(there.y - here.y, discs_.height, half_height);
        const double reach = here.radius + there.radius + skin;
        if (ax * ax + ay * ay < reach * reach && static_cast<std::size_t>(other) != i) list.push_back(other);
      });
      list_end_[i] = static_cast<std::int32_t>(list.size());
      listed_x_[i] = places_[i].x;
      listed_y_[i] = places_[i].y;
    }
  });
}

template <bool measured>
OverlapMinimiser::Sums OverlapMinimiser::forces_of_chunk(std::size_t chunk) {
  Sums sums;
  const std::size_t first = chunk * chunk_size, last = std::min(places_.size(), first + chunk_size);
  const double width = discs_.width, height = discs_.height, half_width = 0.5 * width, half_height = 0.5 * height;
  const Place* places = places_.data();
  const std::int32_t* list = neighbours_[chunk].data();
  std::int32_t k = 0;
  for (std::size_t i = first; i < last; ++i) {
    const Place here = places[i];
    double fx = 0.0, fy = 0.0;
    for (const std::int32_t end = list_end_[i]; k < end; ++k) {
      const Place& there = places[list[k]];
      const double ax = nearest_image(there.x - here.x, width, half_width);
      const double ay = nearest_image(there.y - here.y, height, half_height);
      const double squared = ax * ax + ay * ay + coincident;
      const double distance = std::sqrt(squared);
      // The positive part without a branch: about half of the listed pairs overlap, which no branch predictor guesses.
      const double approach = here.radius + there.radius - distance;
      const double overlap = 0.5 * (approach + std::abs(approach));
      const double factor = overlap / distance;
      fx -= factor * ax;
      fy -= factor * ay;
      if constexpr (measured) {
        if (overlap <= 0.0) continue;
        sums.overlap += overlap;
        sums.virial += overlap * distance;
        sums.distance_squared += squared;
        ++sums.contacts;
        sums.max_ratio = std::max(sums.max_ratio, 0.5 * overlap / std::min(here.radius, there.radius));
      }
    }
    force_x_[i] = fx;
    force_y_[i] = fy;
    const double inverse_mass = inverse_mass_[i];
    sums.force_squared += (fx * fx + fy * fy) * inverse_mass;
    sums.speed_squared += (speed_x_[i] * speed_x_[i] + speed_y_[i] * speed_y_[i]) * mass_[i];
    sums.power += fx * speed_x_[i] + fy * speed_y_[i];
  }
  return sums;
}

OverlapMinimiser::Sums OverlapMinimiser::compute_forces(bool measured) {
  std::vector<Sums> partial(chunks_);
  team_.for_each(chunks_, [&](std::size_t chunk) {
    partial[chunk] = measured ? forces_of_chunk<true>(chunk) : forces_of_chunk<false>(chunk);
  });
  Sums total;
  for (const Sums& part : partial) {
    total.force_squared += part.force_squared;
    total.speed_squared += part.speed_squared;
    total.power += part.power;
    total.overlap += part.overlap;
    total.virial += part.virial;
    total.distance_squared += part.distance_squared;
    total.contacts += part.contacts;
    total.max_ratio = std::max(total.max_ratio, part.max_ratio);
  }
  return total;
}

double OverlapMinimiser::move_discs(double keep, double steer, double step, bool stopped) {
  std::vector<double> farthest(chunks_, 0.0);
  team_.for_each(chunks_, [&](std::size_t chunk) {
    double largest = 0.0;
    for (std::size_t i = chunk * chunk_size; i < std::min(places_.size(), (chunk + 1) * chunk_size); ++i) {
      const double ax = force_x_[i] * inverse_mass_[i], ay = force_y_[i] * inverse_mass_[i];
      // Going uphill: half a step back, then from rest (Guenole et al. 2020).
      const double back = stopped ? 0.5 * step : 0.0;
      const double x = places_[i].x - back * speed_x_[i], y = places_[i].y - back * speed_y_[i];
      const double base_x = stopped ? 0.0 : speed_x_[i], base_y = stopped ? 0.0 : speed_y_[i];
      const double vx = keep * (base_x + step * ax) + steer * ax, vy = keep * (base_y + step * ay) + steer * ay;
      speed_x_[i] = vx;
      speed_y_[i] = vy;
      places_[i].x = x + step * vx;
      places_[i].y = y + step * vy;
      const double mx = places_[i].x - listed_x_[i], my = places_[i].y - listed_y_[i];
      largest = std::max(largest, mx * mx + my * my);
    }
    farthest[chunk] = largest;
  });
  return *std::max_element(farthest.begin(), farthest.end());
}

OverlapState OverlapMinimiser::measure(const Sums& sums) const {
  OverlapState state;
  const double area = discs_.width * discs_.height;
  const double contacts = static_cast<double>(std::max<std::int64_t>(sums.contacts, 1));
  // Each pair was met from both ends.
  state.pressure = 0.25 * sums.virial / area;
  state.stiffness = 0.25 * sums.distance_squared / area;
  state.mean_overlap = sums.overlap / contacts;
  state.max_overlap_ratio = sums.max_ratio;
  const double force = std::sqrt(sums.force_squared / static_cast<double>(places_.size()));
  state.residual = sums.contacts > 0 ? force / state.mean_overlap : 0.0;
  return state;
}

OverlapState OverlapMinimiser::minimise(double scale, const StopRule& stop) {
  for (std::size_t i = 0; i < places_.size(); ++i) places_[i].radius = scale * discs_.radius[i];
  std::fill(speed_x_.begin(), speed_x_.end(), 0.0);
  std::fill(speed_y_.begin(), speed_y_.end(), 0.0);
  double skin = narrow_skin, step = first_step, steer = first_steer;
  int downhill = 0;
  std::int64_t listed_at = 0;
  build_lists(skin);
  OverlapState state;
  for (std::int64_t iteration = 0;; ++iteration) {
    const bool check = iteration % iterations_between_checks == 0 || iteration >= stop.maximum_iterations;
    const Sums sums = compute_forces(check);
    if (check) {
      state = measure(sums);
      state.iterations = iteration;
      state.converged = state.residual <= stop.residual || state.max_overlap_ratio <= stop.negligible_overlap;
      if (state.converged || iteration >= stop.maximum_iterations) break;
    }
    const bool stopped = sums.power < 0.0;
    if (sums.power > 0.0) {
      if (++downhill > steps_before_growth) {
        step = std::min(step * step_growth, longest_step);
        steer *= steer_decay;
      }
    } else {
      downhill = 0;
      step = std::max(step * step_cut, shortest_step);
      steer = first_steer;
    }
    const double ratio = sums.force_squared > 0.0 ? std::sqrt(sums.speed_squared / sums.force_squared) : 0.0;
    const double farthest = move_discs(1.0 - steer, stopped ? 0.0 : steer * ratio, step, stopped);
    if (farthest > 0.25 * skin * skin) {
      skin = iteration - listed_at < short_lived_list ? wide_skin : narrow_skin;
      listed_at = iteration;
      build_lists(skin);
    }
  }
  wrap_positions();
  for (std::size_t i = 0; i < places_.size(); ++i) {
    discs_.x[i] = places_[i].x;
    discs_.y[i] = places_[i].y;
  }
  return state;
}

}  // namespace perfora::geometry
