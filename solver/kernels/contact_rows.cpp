// What is here: making and changing the sliced rows of near pairs.
#include "solver/kernels/contact_rows.h"
#include "solver/index.h"

namespace perfora::solver {
void ContactRows::build(const NeighbourList& pairs, const DiscState& discs, const ContactLaw& law) {
  const std::int32_t n = discs.size();
  std::vector<std::int32_t> length(at(n));
  for (std::int32_t i = 0; i < n; ++i) length[at(i)] = pairs.row_end(i) - pairs.row_begin(i);
  rows_.build(length);
  place_.resize(pairs.slots().size());
  for (std::int32_t i = 0; i < n; ++i)
    for (std::int32_t k = 0; k < length[at(i)]; ++k)
      place_[at(pairs.row_begin(i) + k)] = static_cast<std::int32_t>(rows_.place(i, k));
  const std::size_t groups = rows_.groups(), places = groups * at(lanes_);
  neighbour_.resize(places);
  for (auto* field : {&contact_distance_, &damping_, &shear_, &viscous_force_}) field->assign(places, 0.0f);
  active_.assign(groups, 0);
  slice_active_.assign(rows_.slices(), 0);
  rows_.for_each_place([&](std::int64_t place, std::int32_t disc) { neighbour_[at(place)] = record_offset(disc); });
  for (std::int32_t i = 0; i < n; ++i)
    for (std::int32_t pair = pairs.row_begin(i); pair < pairs.row_end(i); ++pair)
      if (pairs.slots()[at(pair)].bonded == 0) open(pairs, i, pair, discs, law);
}

void ContactRows::open(const NeighbourList& pairs, std::int32_t i, std::int32_t pair, const DiscState& discs,
                       const ContactLaw& law) {
  const NeighbourSlot& slot = pairs.slots()[at(pair)];
  const std::size_t place = at(place_[at(pair)]), j = at(slot.neighbour);
  const double effective_mass = discs.mass[at(i)] * discs.mass[j] / (discs.mass[at(i)] + discs.mass[j]);
  neighbour_[place] = record_offset(slot.neighbour);
  contact_distance_[place] = static_cast<float>(slot.contact_distance);
  damping_[place] = static_cast<float>(contact_damping(law, effective_mass));
  shear_[place] = static_cast<float>(slot.history.shear);
  viscous_force_[place] = static_cast<float>(slot.history.viscous_force);
  std::uint8_t& active = active_[place / at(lanes_)];
  if (active == 0) ++slice_active_[at(rows_.slice_of(i))];
  active = 1;
}

void ContactRows::export_history(NeighbourList& pairs) const {
  for (std::size_t pair = 0; pair < place_.size(); ++pair) {
    NeighbourSlot& slot = pairs.slots()[pair];
    if (slot.bonded != 0) continue;
    const std::size_t place = at(place_[pair]);
    slot.contact_distance = static_cast<double>(contact_distance_[place]);
    slot.history = {static_cast<double>(shear_[place]), static_cast<double>(viscous_force_[place])};
  }
}

void ContactRows::aim(ContactTask& task, std::int32_t chunk) {
  task.neighbour = neighbour_.data();
  task.contact_distance = contact_distance_.data();
  task.damping = damping_.data();
  task.shear = shear_.data();
  task.viscous_force = viscous_force_.data();
  task.active = active_.data();
  task.slice_active = slice_active_.data();
  rows_.aim(task, chunk);
}

}  // namespace perfora::solver
