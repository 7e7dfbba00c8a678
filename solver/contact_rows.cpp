// What is here: making and changing the sliced rows of near pairs.
#include "solver/contact_rows.h"

#include <algorithm>
#include <cmath>
#include <numeric>

namespace perfora::solver {
namespace {

std::size_t at(std::int64_t k) {
  return static_cast<std::size_t>(k);
}

std::int32_t record_offset(std::int32_t disc) {
  return static_cast<std::int32_t>(static_cast<std::int64_t>(disc) * std::int64_t{sizeof(DiscRecord)});
}

}  // namespace

void ContactRows::build(const NearPairs& pairs, const DiscState& discs, const ContactLaw& law) {
  const std::int32_t n = discs.size();
  const auto length = [&](std::int32_t d) { return pairs.row_end(d) - pairs.row_begin(d); };
  const std::int32_t chunks = (n + chunk_discs - 1) / chunk_discs;
  slice_first_.assign(1, 0);
  slice_disc_.clear();
  chunk_first_.assign(1, 0);
  slice_of_.resize(at(n));
  place_.resize(pairs.slots().size());
  std::vector<std::int32_t> order;
  for (std::int32_t chunk = 0; chunk < chunks; ++chunk) {
    const std::int32_t begin = chunk * chunk_discs, end = std::min(n, begin + chunk_discs);
    order.resize(at(end - begin));
    std::iota(order.begin(), order.end(), begin);
    std::stable_sort(order.begin(), order.end(), [&](std::int32_t a, std::int32_t b) { return length(a) > length(b); });
    for (std::size_t k = 0; k < order.size(); k += at(lanes_)) {
      const auto slice = static_cast<std::int32_t>(slice_first_.size()) - 1;
      for (int lane = 0; lane < lanes_; ++lane) {
        const bool real = k + at(lane) < order.size();
        const std::int32_t disc = real ? order[k + at(lane)] : -1;
        slice_disc_.push_back(disc);
        if (!real) continue;
        slice_of_[at(disc)] = slice;
        for (std::int32_t pair = pairs.row_begin(disc), row = 0; pair < pairs.row_end(disc); ++pair, ++row)
          place_[at(pair)] = (slice_first_.back() + row) * lanes_ + lane;
      }
      slice_first_.push_back(slice_first_.back() + length(order[k]));  // the longest row comes first
    }
    chunk_first_.push_back(static_cast<std::int32_t>(slice_first_.size()) - 1);
  }
  const auto groups = at(slice_first_.back()), places = groups * at(lanes_);
  neighbour_.resize(places);
  for (auto* field : {&touch_, &damping_, &shear_, &viscous_force_}) field->assign(places, 0.0f);
  active_.assign(groups, 0);
  slice_active_.assign(slice_first_.size() - 1, 0);
  for (std::size_t slice = 0; slice + 1 < slice_first_.size(); ++slice)
    for (std::int32_t g = slice_first_[slice]; g < slice_first_[slice + 1]; ++g)
      for (int lane = 0; lane < lanes_; ++lane) {
        const std::int32_t* const disc = &slice_disc_[slice * at(lanes_)];
        neighbour_[at(g) * at(lanes_) + at(lane)] = record_offset(disc[lane] >= 0 ? disc[lane] : disc[0]);
      }
  for (std::int32_t i = 0; i < n; ++i)
    for (std::int32_t pair = pairs.row_begin(i); pair < pairs.row_end(i); ++pair)
      if (pairs.slots()[at(pair)].bonded == 0) open(pairs, i, pair, discs, law);
}

void ContactRows::open(const NearPairs& pairs, std::int32_t i, std::int32_t pair, const DiscState& discs,
                       const ContactLaw& law) {
  const NearSlot& slot = pairs.slots()[at(pair)];
  const std::size_t place = at(place_[at(pair)]), j = at(slot.neighbour);
  const double effective_mass = discs.mass[at(i)] * discs.mass[j] / (discs.mass[at(i)] + discs.mass[j]);
  neighbour_[place] = record_offset(slot.neighbour);
  touch_[place] = static_cast<float>(slot.touch);
  damping_[place] = static_cast<float>(contact_damping(law, effective_mass));
  shear_[place] = static_cast<float>(slot.history.shear);
  viscous_force_[place] = static_cast<float>(slot.history.viscous_force);
  std::uint8_t& active = active_[place / at(lanes_)];
  if (active == 0) ++slice_active_[at(slice_of_[at(i)])];
  active = 1;
}

void ContactRows::collect(NearPairs& pairs) const {
  for (std::size_t pair = 0; pair < place_.size(); ++pair) {
    NearSlot& slot = pairs.slots()[pair];
    if (slot.bonded != 0) continue;
    const std::size_t place = at(place_[pair]);
    slot.touch = static_cast<double>(touch_[place]);
    slot.history = {static_cast<double>(shear_[place]), static_cast<double>(viscous_force_[place])};
  }
}

void ContactRows::aim(ContactSweep& sweep, std::int32_t chunk) {
  sweep.neighbour = neighbour_.data();
  sweep.touch = touch_.data();
  sweep.damping = damping_.data();
  sweep.shear = shear_.data();
  sweep.viscous_force = viscous_force_.data();
  sweep.active = active_.data();
  sweep.slice_first = slice_first_.data();
  sweep.slice_active = slice_active_.data();
  sweep.slice_disc = slice_disc_.data();
  sweep.slice_begin = chunk_first_[at(chunk)];
  sweep.slice_end = chunk_first_[at(chunk) + 1];
}

}  // namespace perfora::solver
