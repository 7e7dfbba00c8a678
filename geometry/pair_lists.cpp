// What is here: candidate pairs found by cells, and the near pairs among them laid out for the force loop.
// What is not: the cells (cell_grid.h).
#include "geometry/pair_lists.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "geometry/pair_forces.h"
#include "geometry/plane.h"

namespace perfora::geometry {

/// Everything in and around one cell of the grid, relative to the middle of that cell.
struct PairLists::Surroundings {
  Place middle;
  std::size_t count = 0;
  std::vector<float> x, y, radius;  ///< radius: scaled
  std::vector<Image> image;
  std::vector<std::int32_t> is_near, near;

  void add(double at_x, double at_y, double scaled_radius, const Image& which) {
    if (count == x.size()) {
      const std::size_t room = 2 * count + 64;
      for (auto* array : {&x, &y, &radius}) array->resize(room);
      image.resize(room);
      is_near.resize(room);
      near.resize(room + 1);
    }
    x[count] = static_cast<float>(at_x);
    y[count] = static_cast<float>(at_y);
    radius[count] = static_cast<float>(scaled_radius);
    image[count++] = which;
  }

  /// Fills `near` with those closer to `place` than `reach` plus their radius; returns their number. Without a branch:
  /// one in five is near, which no branch predictor guesses.
  std::size_t find(const Place& place, double reach) {
    mark_near(x.data(), y.data(), radius.data(), static_cast<float>(place.x - middle.x),
              static_cast<float>(place.y - middle.y), static_cast<float>(reach), count, is_near.data());
    std::size_t found = 0;
    for (std::size_t k = 0; k < count; ++k) {
      near[found] = static_cast<std::int32_t>(k);
      found += static_cast<std::size_t>(is_near[k]);
    }
    return found;
  }
};

/// Partners of a chunk's discs.
struct PairLists::Found {
  std::vector<Image> partners;
  std::vector<std::size_t> begin, end;  ///< of each disc's partners
};

PairLists::PairLists(double width, double height, const std::vector<double>& radius, int threads)
    : width_(width),
      height_(height),
      radius_(radius),
      threads_(threads),
      pairs_((radius.size() + chunk_size - 1) / chunk_size) {
  for (double r : radius_) largest_radius_ = std::max(largest_radius_, r);
}

void PairLists::search(std::vector<Place>& places, double scale, double margin) {
  for (Place& place : places) place = {wrapped(place.x, width_), wrapped(place.y, height_)};
  places_ = places;
  const double reach = 2.0 * scale * largest_radius_ + margin;
  // Three reaches along each side: then no disc meets two images of another.
  narrow_ = std::min(width_, height_) < 3.0 * reach;
  const CellGrid grid(width_, height_, reach, places.size(), [&](std::size_t i) { return places[i]; });
  const std::int64_t chunks = static_cast<std::int64_t>(pairs_.size());
#pragma omp parallel for schedule(static) num_threads(threads_)
  for (std::int64_t chunk = 0; chunk < chunks; ++chunk)
    search_chunk(static_cast<std::size_t>(chunk), grid, scale, margin);
}

void PairLists::gather(const CellGrid& grid, std::size_t cell, double scale, Surroundings& around) const {
  around.count = 0;
  around.middle = {grid.middle_x(cell), grid.middle_y(cell)};
  const auto to_nearest = [](double d, double period) { return (d < -0.5 * period) - (d > 0.5 * period); };
  const int images = narrow_ ? 1 : 0;
  grid.for_each_near(around.middle.x, around.middle.y, [&](std::int32_t disc) {
    const std::size_t j = static_cast<std::size_t>(disc);
    const double dx = places_[j].x - around.middle.x, dy = places_[j].y - around.middle.y;
    const int nearest_x = to_nearest(dx, width_), nearest_y = to_nearest(dy, height_);
    for (int px = nearest_x - images; px <= nearest_x + images; ++px)
      for (int py = nearest_y - images; py <= nearest_y + images; ++py)
        around.add(dx + px * width_, dy + py * height_, scale * radius_[j],
                   {disc, static_cast<std::int8_t>(px), static_cast<std::int8_t>(py)});
  });
}

void PairLists::search_chunk(std::size_t chunk, const CellGrid& grid, double scale, double margin) {
  const std::size_t begin = chunk * chunk_size, end = std::min(radius_.size(), begin + chunk_size);
  Found found[2];  // inner, outer
  for (Found& list : found) {
    list.begin.resize(end - begin);
    list.end.resize(end - begin);
  }
  // Cell by cell, so that what surrounds a cell is gathered once.
  std::vector<std::pair<std::size_t, std::size_t>> order;
  for (std::size_t i = begin; i < end; ++i) order.emplace_back(grid.cell_at(places_[i].x, places_[i].y), i);
  std::sort(order.begin(), order.end());
  Surroundings around;
  for (std::size_t n = 0; n < order.size(); ++n) {
    const auto [cell, i] = order[n];
    if (n == 0 || cell != order[n - 1].first) gather(grid, cell, scale, around);
    for (Found& list : found) list.begin[i - begin] = list.partners.size();
    const std::size_t count = around.find(places_[i], scale * radius_[i] + margin);
    for (std::size_t k = 0; k < count; ++k) {
      const Image& image = around.image[static_cast<std::size_t>(around.near[k])];
      const std::size_t j = static_cast<std::size_t>(image.disc);
      const bool inner = j >= begin && j < end;
      if (!inner || j > i) found[inner ? 0 : 1].partners.push_back(image);
    }
    for (Found& list : found) list.end[i - begin] = list.partners.size();
  }
  lay_out(found[0], begin, begin, pairs_[chunk].inner);
  lay_out(found[1], begin, 0, pairs_[chunk].outer);
}

/// First every disc's first partner, then every disc's second one: a disc whose force is written is not written again
/// soon, for which the processor would have to wait.
template <class Index>
void PairLists::lay_out(const Found& found, std::size_t begin, std::size_t origin, PairTable<Index>& table) const {
  const std::size_t pairs = found.partners.size(), discs = found.begin.size();
  table.candidates.assign((pairs + lanes - 1) / lanes, {});
  table.near.resize(table.candidates.size() + 1);  // selection writes one ahead
  table.near_groups = 0;
  std::size_t placed = 0;
  for (std::size_t rank = 0; placed < pairs; ++rank)
    for (std::size_t first = 0; first < discs; ++first) {
      if (found.begin[first] + rank >= found.end[first]) continue;
      const Image& image = found.partners[found.begin[first] + rank];
      const std::size_t i = begin + first, j = static_cast<std::size_t>(image.disc);
      PairGroup<Index>& group = table.candidates[placed / lanes];
      const std::size_t lane = placed++ % lanes;
      group.apart[lane] = {static_cast<float>(places_[j].x - places_[i].x + image.periods_x * width_),
                           static_cast<float>(places_[j].y - places_[i].y + image.periods_y * height_)};
      group.reach[lane_of_reach[lane]] = static_cast<float>(radius_[i] + radius_[j]);
      group.first[lane] = static_cast<std::uint16_t>(first);
      group.second[lane] = static_cast<Index>(j - origin);
    }
}

void PairLists::select(const std::vector<Float2>& moved, double scale, double skin) {
  const std::int64_t chunks = static_cast<std::int64_t>(pairs_.size());
#pragma omp parallel for schedule(static) num_threads(threads_)
  for (std::int64_t k = 0; k < chunks; ++k) {
    ChunkPairs& pairs = pairs_[static_cast<std::size_t>(k)];
    select_near(pairs, moved.data() + static_cast<std::size_t>(k) * chunk_size, moved.data(), scale, skin);
  }
}

}  // namespace perfora::geometry
