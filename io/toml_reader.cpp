// What is here: TOML text into entries; the only file that includes toml++ (it costs seconds to compile).
// What is not: what the keys mean.
#include <fmt/format.h>

#include <algorithm>

// toml++ 3.3.0 asserts (with NDEBUG: lets the compiler assume) that a key starts with a key character, just before it
// reports the contrary as a parse error. What a user writes must reach that report: neither assertion nor assumption is
// wanted.
#undef NDEBUG
#define TOML_ASSERT(expression) static_cast<void>(0)
#include <toml++/toml.h>

#include "io/journal.h"
#include "io/schema.h"
#include "io/value_text.h"

namespace perfora::io {
namespace {

constexpr std::size_t largest_file = std::size_t{16} << 20;
/// toml++ walks nested tables recursively; a dotted key of more parts is refused before it can exhaust the stack.
constexpr int deepest_key = 500;

struct PlacedEntry {
  Entry entry;
  toml::source_index column = 0;
};

int line_of(const toml::node& node) {
  return static_cast<int>(node.source().begin.line);
}

Value convert(const toml::node& node, const Origin& key_origin) {
  const int line = line_of(node);
  if (const auto* flag = node.as_boolean()) return {flag->get(), line};
  if (const auto* whole = node.as_integer()) return {whole->get(), line};
  if (const auto* number = node.as_floating_point()) return {number->get(), line};
  if (const auto* text = node.as_string()) return {text->get(), line};
  if (const auto* array = node.as_array()) {
    ValueList list;
    list.reserve(array->size());
    for (const toml::node& element : *array) list.push_back(convert(element, key_origin));
    return {std::move(list), line};
  }
  Origin origin = key_origin;
  origin.line = line;
  throw InputError(origin, node.is_table() ? "has a table among other values of a list" : "found a date or time",
                   "numbers, texts, true, false and lists of them are allowed",
                   node.is_table() ? "" : "write it as a text in quotes");
}

/// A name that itself contains a dot cannot be a key of ours; quotes keep it from looking like section.key.
std::string key_part(std::string_view name) {
  const bool plain = !name.empty() && name.find('.') == std::string_view::npos;
  return plain ? std::string(name) : fmt::format("\"{}\"", name);
}

void flatten(const toml::table& table, const std::string& prefix, const std::string& file,
             std::vector<PlacedEntry>& entries) {
  for (const auto& [name, node] : table) {
    const std::string key = prefix + key_part(name.str());
    if (const auto* inner = node.as_table()) {
      flatten(*inner, key + ".", file, entries);
    } else if (node.is_array_of_tables()) {
      std::size_t index = 0;
      for (const toml::node& element : *node.as_array())
        flatten(*element.as_table(), fmt::format("{}.{}.", key, index++), file, entries);
    } else {
      Value value = convert(node, {file, line_of(node), key});
      entries.push_back({{key, std::move(value)}, node.source().begin.column});
    }
  }
}

void refuse_deep_keys(std::string_view text, const std::string& file) {
  int line = 1, dots = 0;
  for (const char c : text) {
    if (c == '\n') ++line;
    if (c == '\n' || c == ',' || c == '=') dots = 0;
    if (c == '.' && ++dots > deepest_key)
      throw InputError({file, line, ""}, "a key has too many parts", "section.key is wanted", "check this line");
  }
}

/// A value that stands in no file has no line.
void forget_lines(Value& value) {
  value.line = 0;
  if (auto* list = std::get_if<ValueList>(&value.data))
    for (Value& element : *list) forget_lines(element);
}

[[noreturn]] void refuse(const toml::parse_error& error, const std::string& file) {
  const std::string said(error.description());
  std::string remedy = "texts and quantities with a unit need quotes, as in diameter = \"20 mm\"";
  if (said.find("redefine") != std::string::npos) remedy = "give each key and each section once";
  if (said.find("UTF-8") != std::string::npos || said.find("utf-8") != std::string::npos)
    remedy = "save the file as UTF-8 text";
  throw InputError({file, static_cast<int>(error.source().begin.line), ""}, "not valid TOML: " + said, "", remedy);
}

}  // namespace

std::vector<Entry> parse_toml(std::string_view text, const std::string& name) {
  if (text.size() > largest_file)
    throw InputError({name, 0, ""}, "is larger than 16 MB", "",
                     "put long lists into a CSV file and name it by a path key");
  refuse_deep_keys(text, name);
  std::vector<PlacedEntry> placed;
  try {
    const toml::table table = toml::parse(text, name);
    flatten(table, "", name, placed);
  } catch (const toml::parse_error& error) {
    refuse(error, name);
  }
  // toml++ keeps tables sorted by name; the file's own order is that of the positions.
  std::stable_sort(placed.begin(), placed.end(), [](const PlacedEntry& a, const PlacedEntry& b) {
    return std::pair(a.entry.value.line, a.column) < std::pair(b.entry.value.line, b.column);
  });
  std::vector<Entry> entries;
  entries.reserve(placed.size());
  for (PlacedEntry& one : placed) entries.push_back(std::move(one.entry));
  return entries;
}

std::vector<Entry> read_toml(const std::filesystem::path& path) {
  return parse_toml(read_file(path, largest_file), path.string());
}

std::optional<Value> parse_toml_value(std::string_view text) {
  constexpr std::string_view line_ends = "\r\n";
  if (text.find_first_of(line_ends) != std::string_view::npos) return std::nullopt;
  try {
    std::vector<Entry> entries = parse_toml(fmt::format("value = {}\n", text), "--set");
    if (entries.size() != 1 || entries.front().key != "value") return std::nullopt;
    forget_lines(entries.front().value);
    return std::move(entries.front().value);
  } catch (const InputError&) {
    return std::nullopt;
  }
}

}  // namespace perfora::io
