// What is here: some cases of a sweep chosen by their labels (--only). What is not: the cases (sweep.h).
#pragma once

#include <string>
#include <vector>

#include "optimize/sweep.h"

namespace perfora::optimize {

/// Does `label` have one of `texts` in it? All labels are chosen where `texts` is empty.
bool is_chosen(const std::string& label, const std::vector<std::string>& texts);

/// Leaves in `sweep` the chosen cases, with the numbers they have in the file, and the design itself where they are
/// compared to it. Without `texts` nothing is left out. Throws io::InputError when no other case that can be run is
/// left.
void choose_cases(Sweep& sweep, const std::vector<std::string>& texts);

}  // namespace perfora::optimize
