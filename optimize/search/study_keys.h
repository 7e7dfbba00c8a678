// What is here: the keys that the tables of a study file name, and their bounds. What is not: what a study makes of
// them (study_arms.h).
#pragma once

#include <string>
#include <utility>

#include "optimize/search/study.h"

namespace perfora::optimize {

/// A key of the design or an element of one of its lists, as a table of the study names it.
struct NamedKey {
  std::string name;  ///< of today, with its section: "layout.row_diameter[0]"
  const io::Key& key;
};

io::Origin origin_in(const Study& study, const std::string& table, const io::Entry& entry);

/// The key of the design that an entry of `table` ("variables" or "arms") names; the section "layout" may be left out.
/// Throws io::InputError for one that no study can vary: texts, whole lists, keys that the study itself sets, output,
/// and in [variables] names.
NamedKey design_key(const Study& study, const std::string& table, const io::Entry& entry);

/// The list that an entry holds; throws io::InputError, with `allowed` in it, where there is none.
const io::ValueList& list_of(const Study& study, const std::string& table, const io::Entry& entry,
                             const std::string& allowed);

/// Both bounds of an entry of [variables] in SI, checked against the key's range. Throws io::InputError.
std::pair<double, double> bounds(const Study& study, const io::Key& key, const io::Entry& entry);

/// Throws InputError for lengths of a pattern that are larger than the cell: plain numbers are in metres.
void refuse_metres(const Study& study, const io::Key& key, const io::Entry& entry, double low, double high);

[[noreturn]] void refuse_empty_bounds(const Study& study, const io::Entry& entry, double low, double high);

}  // namespace perfora::optimize
