// What is here: TOML text into entries. What is not: what the keys mean (schema.h).
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "io/schema.h"

namespace perfora::io {

/// Reads a TOML file. Throws InputError for a missing, unreadable, over-large (> 16 MB) or malformed file.
std::vector<Entry> read_toml(const std::filesystem::path& path);
/// The same from text; `name` stands for the file in messages.
std::vector<Entry> parse_toml(std::string_view text, const std::string& name);
/// The free text `title` at the top of a file; empty where it has none.
std::string title_in(const std::vector<Entry>& entries);
/// The value of a text in TOML syntax; nothing when it is not one (then it is a bare string).
std::optional<Value> parse_toml_value(std::string_view text);

}  // namespace perfora::io
