// What is here: the one module for text of values. For people: a quantity with the prefix that gives 1 to 999 and four
// significant digits, plain numbers, counts, durations, values of keys. Exact: texts that tell values apart, TOML
// literals, values in messages. What is not: reading such texts (units.cpp, toml.cpp), layout of tables.
#pragma once

#include <concepts>
#include <limits>
#include <string>
#include <string_view>
#include <vector>

#include "io/schema.h"

namespace perfora::io {

/// What stands for NaN where the caller has no better words.
inline constexpr std::string_view no_value = "-";

/// A unit as printed: its name with prefix, and the power of ten it has in SI ("kPa": 3). Name "": plain numbers.
struct PrintUnit {
  std::string name;
  int exponent = 0;
};
/// The unit that shows `largest` (SI) as 1 to 999: for several values that are compared or share a heading.
/// Lengths go from nm to m, stresses from Pa to GPa; a ratio is in %, an angle in degrees; densities, rates and
/// areas have few units, so that their numbers may be larger.
PrintUnit unit_for(double largest, Dimension dimension);
/// A value (SI) in a given unit, with four significant digits and the name of the unit.
std::string in_unit(double value, const PrintUnit& unit, std::string_view none = no_value);
/// Number per SI unit: what a drawn value is multiplied with to stand in `unit`.
double scale_of(const PrintUnit& unit);

/// A value (SI) as people read it: "5.29 kPa", "25.67 mm", "1.282 us", "24.8 MB", "9.701 kJ/m3", "35 %", "36,607" for
/// a count, "0.25" for a plain number. NaN reads `none`; infinities "infinity", "-infinity".
std::string quantity(double value, Dimension dimension, std::string_view none = no_value);
/// Several values in one unit, that of the largest, which is named once: {0.05, 0.1}, " x " -> "50 x 100 mm".
std::string quantities(const std::vector<double>& values, Dimension dimension, std::string_view between,
                       std::string_view none = no_value);
/// A plain number with four significant digits: "0.25", "12,350", "2.195e+07".
std::string number(double value, std::string_view none = no_value);
/// A count: "1,234,567"; all its digits up to 2^53.
std::string count(double value, std::string_view none = no_value);
template <std::integral Integer>
std::string count(Integer value) {
  return count(static_cast<double>(value));
}
/// "520 ms", "3.2 s", "45 s", "3 min 05 s", "2 h 07 min", "14 d 3 h", "more than a year"; "unknown time" for NaN and
/// negative values.
std::string duration(double seconds);
/// A value of a key as it was written, numbers with six digits: part of the names of a sweep's cases, which result
/// files hold. A list of more than `most_items` is only counted.
std::string readable(const Value& value, std::size_t most_items = std::numeric_limits<std::size_t>::max());

/// A number rounded to 12 significant digits.
double rounded(double value);
/// A value as text that tells values apart (17 digits): part of the identity of studies and sweeps, so it never
/// changes.
std::string value_text(const Value& value);
/// A number with as few digits as bring back the same bits.
std::string shortest(double number);
enum class Digits { shortest, all_17 };
/// The value in TOML syntax. Rows of a list of lists stand on lines of their own when there is more than one.
std::string toml_literal(const Value& value, Digits digits);

/// What a value is, in words for a message: `the text "abc"`, `the number 3.5`, `a list of 3 values`.
std::string describe_value(const Value& value);
/// Text in double quotes, shortened to what fits in a message.
std::string in_quotes(std::string_view text);
/// Its beginning, at most `most_bytes` long, without half a character of UTF-8 at the end.
std::string_view beginning(std::string_view text, std::size_t most_bytes);
/// "a, b, c".
std::string joined(const std::vector<std::string>& names);
/// "diameter" of "layout.diameter".
std::string after_section(const std::string& key);

}  // namespace perfora::io
