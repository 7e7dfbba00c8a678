// What is here: [fidelity.NAME] of a study file: named changes of the design, and which of them the study uses. What is
// not: making the changes (optimize/evaluate/fidelity.h).
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "optimize/campaign/table_file.h"
#include "optimize/search/study.h"

namespace perfora::optimize {

/// Where a key of the study file stands.
using OriginOf = std::function<io::Origin(const std::string& key)>;

/// Sets study.fidelities, map_fidelity, verify_fidelity, costs and ladder from the entries of the table "fidelity"
/// ("NAME.layout.rows"; "NAME.cost" is the measured time of a run) and the names in study.keys. All run to `until`.
/// Throws io::InputError for a name that is not there, a key that is none of the design or that no fidelity may change.
void set_fidelities(Study& study, const std::vector<TableEntry>& entries, double until, const OriginOf& origin);

}  // namespace perfora::optimize
