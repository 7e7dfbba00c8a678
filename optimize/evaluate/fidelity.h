// What is here: at what detail and how far a design is simulated: changes of its keys and a strain, with a name.
// What is not: which fidelities a study or a sweep uses (their own files).
#pragma once

#include <string>
#include <vector>

#include "optimize/evaluate/design.h"

namespace perfora::optimize {

/// One key of a design with the value it is given.
struct DesignChange {
  std::string key;  ///< "layout.rows"
  io::Value value;
};

/// How a design is simulated. A ladder of fidelities is a list of these: a coarser packing, a faster rate, a shorter
/// strain.
struct Fidelity {
  std::string name;                   ///< "": the only one there is; no part of a key
  std::vector<DesignChange> changes;  ///< made in this order
  double until = 0.0;                 ///< engineering strain to run to; 0: as the design says
};

/// Makes the changes and sets loading.until. `origin` stands in messages for where the fidelity is written. Throws
/// io::InputError when a key is unknown or refuses its value.
void apply(const Fidelity& fidelity, DesignFile& design, const io::Origin& origin);

/// Changes that make a run write no frames and checkpoints at the usual times: none of them changes a result.
std::vector<DesignChange> changes_without_output();

}  // namespace perfora::optimize
