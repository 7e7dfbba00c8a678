// What is here: text into numbers, the same whatever locale the process has. What is not: units (units.h), numbers for
// people (text.h).
#pragma once

#include <optional>
#include <string_view>

namespace perfora::io {

/// The decimal number that `text` begins with, which loses it; a leading + is taken, NaN and infinity too. Nothing, and
/// `text` as it was, where none begins or where it is too large or too small for a double.
std::optional<double> take_number(std::string_view& text);
/// The whole of `text` as such a number; nothing for any other text, blanks around it included.
std::optional<double> number_from(std::string_view text);

}  // namespace perfora::io
