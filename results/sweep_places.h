// What is here: where a picture puts the cases of a sweep, told from their labels and what the journal says of its
// table. What is not: reading results (sweep_record.h).
#pragma once

#include <string>
#include <vector>

namespace perfora::results {

struct SweepRecord;

/// Sets group, axis, place and series of every case. One key of a grid runs along x, everything else that the label
/// says makes the series; rows without a grid stand along x under their names; values of [each] make a group a key.
/// `columns` are the keys that some case sets. Where the journal of an older program does not say what was a grid, the
/// labels do.
void place_cases(SweepRecord& record, const std::vector<std::string>& columns);

}  // namespace perfora::results
