// What is here: values as text, inside io only: for messages ("the text "abc""), as TOML literals, and back.
// What is not: units (units.cpp), TOML files (toml_reader.cpp).
#pragma once

#include <optional>
#include <string>
#include <string_view>

#include "io/schema.h"

namespace perfora::io {

/// What a value is, in words for a message: `the text "abc"`, `the number 3.5`, `a list of 3 values`.
std::string describe_value(const Value& value);
/// Text in double quotes, shortened to what fits in a message.
std::string in_quotes(std::string_view text);
/// "a, b, c".
std::string joined(const std::vector<std::string>& names);
/// A number with as few digits as bring back the same bits.
std::string shortest(double number);

enum class Digits { shortest, all_17 };
/// The value in TOML syntax. Rows of a list of lists stand on lines of their own when there is more than one.
std::string toml_literal(const Value& value, Digits digits);

/// The value of a text in TOML syntax; nothing when it is not one (then it is a bare string). Defined in
/// toml_reader.cpp.
std::optional<Value> parse_toml_value(std::string_view text);

}  // namespace perfora::io
