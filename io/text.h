// What is here: values as text for people and for identities. What is not: values in messages of the reader and TOML
// literals (value_text.h, inside io only).
#pragma once

#include <string>

#include "io/schema.h"

namespace perfora::io {

/// A number rounded to 12 significant digits.
double rounded(double value);

/// A value as text that tells values apart (17 digits).
std::string value_text(const Value& value);

/// "16.2 mm", "0.25": a value of a key as people read it.
std::string readable(double value, Dimension dimension);
/// The same of a stress in Pa; "none" where it was not reached.
std::string readable_stress(double stress);
/// "diameter" of "layout.diameter".
std::string after_section(const std::string& key);
/// A value as it was written, with as few digits as tell it.
std::string readable(const Value& value);

}  // namespace perfora::io
