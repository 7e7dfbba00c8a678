// What is here: evaluations of another folder for a study of the same space, and what a journal says of the designs
// beside its own search. What is not: writing them down (campaign.h), what is the same space (study_space.h).
#pragma once

#include <filesystem>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "optimize/search/driver.h"

namespace perfora::optimize {

/// The evaluations in the journal of a map or a study, as events of a journal. Throws io::InputError, with `origin`,
/// where the folder holds no such work, results of another version, or those of another space (the first key that
/// differs is named).
std::vector<nlohmann::json> evaluations_of(const std::filesystem::path& folder, const Study& study,
                                           const io::Origin& origin);

/// The study's designs that evaluation events are of, each once, by arm and values; others are left out.
std::vector<const Candidate*> designs_of(const std::vector<nlohmann::json>& events, const Study& study,
                                         CandidateBook& book);

/// What a study would take from the folder in its map.from. Throws io::InputError as evaluations_of() does.
TakenMap taken_map(const Study& study, const io::Origin& origin);

/// Gives a driver what the journal of its folder (events of `kind`: "study" or "map") holds beside the evaluations:
/// batches, an end before the time, designs of other folders. Where the target was changed, the candidates from before
/// are designs like those of a map, and their batches are done with. Returns how many evaluations are of such designs.
int tell_driver(Driver& driver, const Study& study, const std::vector<nlohmann::json>& events, const std::string& kind);

}  // namespace perfora::optimize
