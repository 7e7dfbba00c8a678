// What is here: the little that all readers of text share. What is not: text of values (text.h).
#pragma once

#include <string>
#include <string_view>

namespace perfora::io {

/// ASCII capitals as small letters.
inline std::string lower(std::string_view text) {
  std::string result(text);
  for (char& c : result)
    if (c >= 'A' && c <= 'Z') c = static_cast<char>(c - 'A' + 'a');
  return result;
}

/// Without the blanks at both ends: what isspace() takes for white space.
inline std::string_view trimmed(std::string_view text) {
  constexpr std::string_view blanks = " \t\r\n\v\f";
  const std::size_t first = text.find_first_not_of(blanks);
  if (first == std::string_view::npos) return {};
  return text.substr(first, text.find_last_not_of(blanks) - first + 1);
}

}  // namespace perfora::io
