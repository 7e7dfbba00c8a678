// What is here: a fidelity applied to a design. What is not: requests (request.cpp).
#include "optimize/evaluate/fidelity.h"

namespace perfora::optimize {

void apply(const Fidelity& fidelity, DesignFile& design, const io::Origin& origin) {
  for (const DesignChange& change : fidelity.changes) {
    io::Origin place = origin;
    if (change.value.line > 0) place.line = change.value.line;
    design.schema().set(change.key, change.value, place);
  }
  if (fidelity.until > 0.0) design.schema().set_number("loading.until", fidelity.until, origin);
}

std::vector<DesignChange> changes_without_output() {
  return {{"output.frames", {std::string("none")}},
          {"output.frame_strains", {io::ValueList{}}},
          {"output.checkpoint_interval", {solver::OutputOptions{}.checkpoint_interval}}};
}

}  // namespace perfora::optimize
