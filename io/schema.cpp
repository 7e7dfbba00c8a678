// What is here: the table of keys: finding, setting by name, elements of lists, unknown names, --set, entries of a
// file.
// What is not: how one key takes its value (schema_keys.cpp), printing (schema_print.cpp), TOML syntax
// (toml.cpp).
#include "io/schema.h"
#include "io/toml.h"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <optional>

#include "io/letters.h"
#include "io/text.h"

namespace perfora::io {
namespace {

struct SplitName {
  std::string section, name;
};

SplitName split(std::string_view full_name, const std::vector<std::string>& sections) {
  std::size_t dot = full_name.rfind('.');
  if (dot == std::string_view::npos) return {"", std::string(full_name)};
  if (std::find(sections.begin(), sections.end(), full_name.substr(0, dot)) == sections.end())
    dot = full_name.find('.');
  return {std::string(full_name.substr(0, dot)), std::string(full_name.substr(dot + 1))};
}

std::string in_brackets(const std::vector<std::string>& sections) {
  std::vector<std::string> names;
  for (const std::string& section : sections) names.push_back(fmt::format("[{}]", section));
  return joined(names);
}

std::vector<std::string> sections_with(const std::vector<Key>& keys, std::string_view name) {
  std::vector<std::string> sections;
  for (const Key& key : keys)
    if (key.name == name) sections.push_back(key.section);
  return sections;
}

/// A key outside every section, or of a section nobody knows.
[[noreturn]] void refuse_section(const SplitName& given, const std::vector<Key>& keys,
                                 const std::vector<std::string>& sections, Origin origin) {
  const std::vector<std::string> homes = sections_with(keys, given.name);
  const std::string all = "sections are " + in_brackets(sections);
  const std::string home = homes.empty() ? "" : fmt::format("the key {} belongs in {}", given.name, in_brackets(homes));
  if (given.section.empty()) {
    if (std::find(sections.begin(), sections.end(), given.name) != sections.end())
      throw InputError(origin, "is a section, not a key",
                       fmt::format("write [{}] on a line of its own, its keys below it", given.name));
    throw InputError(origin, "stands outside every section", all, home);
  }
  const std::string nearest = nearest_name(given.section, sections);
  std::string remedy = home;
  if (!nearest.empty()) remedy = fmt::format("did you mean [{}]?", nearest);
  throw InputError(origin, fmt::format("unknown section [{}]", given.section), all, remedy);
}

[[noreturn]] void refuse_name(const SplitName& given, const std::vector<Key>& keys, const std::vector<NoKey>& no_keys,
                              Origin origin) {
  for (const NoKey& one : no_keys)
    if (one.name == given.section + "." + given.name) throw InputError(origin, one.problem, "", one.remedy);
  std::vector<std::string> here, everywhere;
  for (const Key& key : keys) {
    everywhere.push_back(key.name);
    if (key.section == given.section) here.push_back(key.name);
  }
  const std::string problem = fmt::format("unknown key in [{}]", given.section);
  const std::vector<std::string> homes = sections_with(keys, given.name);
  const std::string nearest = nearest_name(given.name, here);
  std::vector<std::string> hints;
  if (!nearest.empty()) hints.push_back(fmt::format("did you mean {}.{}?", given.section, nearest));
  if (!homes.empty()) hints.push_back(fmt::format("{} is a key of {}", given.name, in_brackets(homes)));
  if (hints.empty()) {
    const std::string elsewhere = nearest_name(given.name, everywhere);
    if (!elsewhere.empty())
      hints.push_back(fmt::format("did you mean {} in {}?", elsewhere, in_brackets(sections_with(keys, elsewhere))));
  }
  throw InputError(origin, problem, nearest.empty() ? fmt::format("its keys are {}", joined(here)) : "",
                   fmt::format("{}", fmt::join(hints, "; ")));
}

void check_schema_version(const Value& value, const Origin& origin) {
  const auto* version = std::get_if<std::int64_t>(&value.data);
  if (version == nullptr || *version < 1)
    throw InputError(origin, "found " + describe_value(value),
                     fmt::format("a whole number from 1 to {} is wanted", schema_version));
  if (*version > schema_version)
    throw InputError(origin, fmt::format("the file has keys of version {}", *version),
                     fmt::format("this program knows the keys up to version {}", schema_version),
                     "read it with a newer program");
}

/// A renaming of a section has no dot.
bool is_section(std::string_view name) {
  return name.find('.') == std::string_view::npos;
}

/// "layout.holes[3][2]" taken apart.
struct ElementName {
  std::string_view key;
  std::string_view places;  ///< "[3][2]"; empty: the key itself
};

ElementName split_element(std::string_view full_name) {
  const std::size_t bracket = std::min(full_name.find('['), full_name.size());
  return {full_name.substr(0, bracket), full_name.substr(bracket)};
}

/// The first place of "[3][2]", taken off; nothing where there is no whole number in brackets.
std::optional<std::size_t> take_place(std::string_view& places) {
  const std::size_t end = places.find(']');
  if (!places.starts_with('[') || end == std::string_view::npos) return std::nullopt;
  std::size_t place = 0;
  const char* last = places.data() + end;
  const auto [stop, error] = std::from_chars(places.data() + 1, last, place);
  if (error != std::errc() || stop != last) return std::nullopt;
  places.remove_prefix(end + 1);
  return place;
}

/// The element of `whole`, the value of `key`, that `places` names; throws InputError for one that is not there.
Value& element_at(const Key& key, Value& whole, std::string_view places, const Origin& origin) {
  if (!key.list()) throw InputError(origin, "is an element, but the key is no list", "", "write " + key.full_name());
  Value* at = &whole;
  for (std::size_t depth = key.type == KeyType::real_rows ? 2 : 1; depth > 0; --depth) {
    const std::optional<std::size_t> place = take_place(places);
    auto* const list = std::get_if<ValueList>(&at->data);
    if (!list)
      throw InputError(origin, "is an element, but the key holds one value here", "", "write " + key.full_name());
    if (!place)
      throw InputError(origin, "does not name an element of the list",
                       fmt::format("{}[0]{}", key.full_name(), key.type == KeyType::real_rows ? "[0]" : ""));
    if (*place >= list->size())
      throw InputError(origin, fmt::format("the list has {} values here", list->size()),
                       list->empty() ? "" : fmt::format("[0] to [{}]", list->size() - 1),
                       "set the list first: an element must be there already");
    at = &(*list)[*place];
  }
  if (!places.empty()) throw InputError(origin, "names more than an element of the list");
  return *at;
}

bool holds_text(const Value& value) {
  return std::holds_alternative<std::string>(value.data);
}

/// The value of a --set: TOML syntax where it is, otherwise the bare text; keys that hold text take any text.
Value override_value(const Key* key, std::string_view text, const Origin& origin) {
  Value bare{std::string(text)};
  if (!parse_toml_value(toml_literal(bare, Digits::shortest)))
    throw InputError(origin, "the value is not valid UTF-8 text", "", "write it in UTF-8");
  const std::optional<Value> parsed = parse_toml_value(text);
  if (!parsed) return bare;
  const bool wants_text =
      key != nullptr && (key->type == KeyType::text || key->type == KeyType::choice || key->type == KeyType::path);
  return wants_text && !holds_text(*parsed) ? bare : *parsed;
}

}  // namespace

Section Schema::section(std::string name, std::string help) {
  const auto same = [&name](const auto& section) { return section.first == name; };
  if (std::none_of(sections_.begin(), sections_.end(), same)) sections_.emplace_back(name, std::move(help));
  return Section(*this, std::move(name));
}

std::vector<std::string> Schema::section_names() const {
  std::vector<std::string> names;
  for (const auto& section : sections_) names.push_back(section.first);
  return names;
}

const std::string& Schema::section_help(std::string_view section) const {
  static const std::string none;
  for (const auto& [name, help] : sections_)
    if (name == section) return help;
  return none;
}

std::string Schema::name_today(std::string_view full_name) const {
  if (const ElementName element = split_element(full_name); !element.places.empty())
    return name_today(element.key) + std::string(element.places);
  for (const Renaming& renaming : renamings_) {
    if (full_name == renaming.old_name) return renaming.name;
    if (is_section(renaming.old_name) && full_name.starts_with(renaming.old_name + "."))
      return renaming.name + std::string(full_name.substr(renaming.old_name.size()));
  }
  return std::string(full_name);
}

std::string Schema::first_name(std::string_view full_name) const {
  if (const ElementName element = split_element(full_name); !element.places.empty())
    return first_name(element.key) + std::string(element.places);
  for (const Renaming& renaming : renamings_) {
    if (full_name == renaming.name) return renaming.old_name;
    if (is_section(renaming.name) && full_name.starts_with(renaming.name + "."))
      return renaming.old_name + std::string(full_name.substr(renaming.name.size()));
  }
  return std::string(full_name);
}

std::vector<std::string> Schema::notices() const {
  std::vector<std::string> sentences;
  for (const Origin& origin : used_old_names_)
    sentences.push_back(
        InputError(origin, "is now called " + name_today(origin.key), "the old name is still read").what());
  return sentences;
}

void Schema::note_old_name(const Origin& origin) {
  const auto same = [&](const Origin& other) { return other.file == origin.file && other.key == origin.key; };
  if (std::none_of(used_old_names_.begin(), used_old_names_.end(), same)) used_old_names_.push_back(origin);
}

const Key* Schema::find(std::string_view full_name) const {
  const std::string today = name_today(split_element(full_name).key);
  for (const Key& key : keys_) {
    const std::size_t dot = key.section.size();
    if (today.size() == dot + 1 + key.name.size() && today[dot] == '.' && today.starts_with(key.section) &&
        today.ends_with(key.name))
      return &key;
  }
  return nullptr;
}

const Key& Schema::at(std::string_view full_name, Origin origin) const {
  if (const Key* key = find(full_name)) return *key;
  origin.key = full_name;
  const std::vector<std::string> sections = section_names();
  const SplitName given = split(name_today(full_name), sections);
  if (std::find(sections.begin(), sections.end(), given.section) == sections.end())
    refuse_section(given, keys_, sections, origin);
  refuse_name(given, keys_, no_keys_, origin);
}

void Schema::set(std::string_view full_name, const Value& value, Origin origin) {
  const std::string today = name_today(full_name);
  origin.key = full_name;
  if (origin.line == 0) origin.line = value.line;
  const Key& key = at(full_name, origin);
  if (const std::string_view places = split_element(today).places; places.empty()) {
    key.set(value, origin);
  } else {
    Value whole = key.get();
    element_at(key, whole, places, origin) = value;
    key.set(whole, origin);
  }
  if (today != full_name) note_old_name(origin);
  const auto same = [&today](const auto& entry) { return entry.first == today; };
  const auto known = std::find_if(origins_.begin(), origins_.end(), same);
  if (known != origins_.end())
    known->second = std::move(origin);
  else
    origins_.emplace_back(today, std::move(origin));
}

bool Schema::is_number(std::string_view full_name) const {
  const Key* key = find(full_name);
  if (key == nullptr) return false;
  return split_element(full_name).places.empty() ? key->numeric() : key->list();
}

void Schema::set_number(std::string_view full_name, double value, Origin origin) {
  if (const Key* key = find(full_name); key != nullptr && !is_number(full_name)) {
    origin.key = full_name;
    throw InputError(origin, "is not a number that could be varied", "",
                     key->list() ? fmt::format("name an element, such as {}[0]", key->full_name())
                                 : "choose a key that holds one number");
  }
  set(full_name, Value{value}, std::move(origin));
}

double Schema::get_number(std::string_view full_name) const {
  const Key& key = at(full_name);
  const Origin origin{"", 0, std::string(full_name)};
  if (!is_number(full_name)) throw InputError(origin, "is not a number", "a key that holds one number is wanted");
  Value whole = key.get();
  const std::string_view places = split_element(full_name).places;
  const Value& value = places.empty() ? whole : element_at(key, whole, places, origin);
  if (const auto* integer = std::get_if<std::int64_t>(&value.data)) return static_cast<double>(*integer);
  return std::get<double>(value.data);
}

void Schema::set_override(std::string_view text) {
  const std::size_t equals = text.find('=');
  if (equals == std::string_view::npos)
    throw InputError({"--set", 0, ""}, in_quotes(text) + " has no equals sign", "section.key=value is wanted",
                     "for example --set layout.diameter=22mm");
  const std::string name(trimmed(text.substr(0, equals)));
  const Origin origin{"--set", 0, name};
  Value value = override_value(find(name), trimmed(text.substr(equals + 1)), origin);
  set(name, value, origin);
}

Origin Schema::origin(std::string_view full_name) const {
  const std::string today = name_today(full_name);
  for (const auto& [name, origin] : origins_)
    if (name == today) return origin;
  return {"default", 0, std::string(full_name)};
}

void apply_toml(Schema& schema, const std::filesystem::path& path) {
  apply_entries(schema, read_toml(path), path.string());
}

void apply_entries(Schema& schema, const std::vector<Entry>& entries, const std::string& file) {
  for (const Entry& entry : entries) {
    const Origin origin{file, entry.value.line, entry.key};
    if (entry.key == "schema_version")
      check_schema_version(entry.value, origin);
    else if (entry.key != "title" && entry.key != "description")
      schema.set(entry.key, entry.value, origin);
    else if (!holds_text(entry.value))
      throw InputError(origin, "found " + describe_value(entry.value), "a text in quotes is wanted");
  }
}

}  // namespace perfora::io
