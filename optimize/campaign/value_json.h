// What is here: the value of a key of a design in records. What is not: keys (io/schema.h).
#pragma once

#include <nlohmann/json.hpp>

#include "io/schema.h"

namespace perfora::optimize {

/// SI numbers, truths and texts as they are; lists as the text of a design file; null for what is no finite number.
nlohmann::json value_json(const io::Value& value);

}  // namespace perfora::optimize
