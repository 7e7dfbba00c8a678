// What is here: the value of a key of a design in records, and the window of its plateau. What is not: keys
// (io/schema.h).
#pragma once

#include <nlohmann/json.hpp>

#include "io/schema.h"
#include "results/measure_options.h"

namespace perfora::optimize {

/// SI numbers, truths and texts as they are; lists as the text of a design file; null for what is no finite number.
nlohmann::json value_json(const io::Value& value);

/// [start, end] in engineering strain of the window where the plateau is measured; null where that is the found
/// plateau.
nlohmann::json window_json(const results::MeasureOptions& measures);

}  // namespace perfora::optimize
