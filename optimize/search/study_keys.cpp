// What is here: finding the keys that a study varies, and what is wrong with them. What is not: arms (study_arms.cpp).
#include "optimize/search/study_keys.h"

#include <fmt/format.h>
#include <algorithm>

#include "io/text.h"
#include "io/units.h"

namespace perfora::optimize {
namespace {

/// Why no study varies a key; empty where it may.
std::string reason_against(const io::Key& key) {
  if (key.section == "output") return "it changes what is written, not the result";
  if (key.section == "material_test") return "a run does not look at it";
  if (key.section == "measures" || key.section.starts_with("target") || key.full_name() == "loading.until")
    return "the study says it for all candidates: target.window, study.until";
  return {};
}

bool can_vary(const std::string& table, const io::Key& key) {
  const bool name = key.type == io::KeyType::choice || key.type == io::KeyType::boolean;
  return (key.numeric() || (table == "arms" && name)) && reason_against(key).empty();
}

[[noreturn]] void refuse_key(const Study& study, const std::string& table, const io::Entry& entry,
                             const std::string& name, const io::Key* key) {
  const io::Origin origin = origin_in(study, table, entry);
  if (key && !reason_against(*key).empty())
    throw io::InputError(origin, "a study cannot vary this key: " + reason_against(*key), "", "leave it out");
  if (key && key->list())
    throw io::InputError(origin, "a study varies one number, this is a list", "",
                         fmt::format("name an element: \"{}[0]{}\"", key->full_name(),
                                     key->type == io::KeyType::real_rows ? "[0]" : ""));
  std::vector<std::string> allowed, of_layout;
  for (const io::Key& other : study.start->schema().keys()) {
    if (!can_vary(table, other)) continue;
    allowed.push_back(other.full_name());
    if (other.section == "layout") of_layout.push_back(other.full_name());
  }
  const std::string bare = entry.key.substr(0, entry.key.find('['));
  for (const io::Key& other : study.start->schema().keys())
    if (!key && other.name == bare && can_vary(table, other))
      throw io::InputError(origin, "the section of the key is missing (that of [layout] alone may be left out)", "",
                           fmt::format("write \"{}\"", other.full_name()));
  const std::string nearest = io::nearest_name(name, allowed);
  throw io::InputError(origin, key ? "a study cannot vary this key" : "there is no such key",
                       fmt::format("numbers of the design, such as {}", fmt::join(of_layout, ", ")),
                       nearest.empty() ? "take one of these" : fmt::format("did you mean {}?", nearest));
}

}  // namespace

io::Origin origin_in(const Study& study, const std::string& table, const io::Entry& entry) {
  return {study.file.string(), entry.value.line, table + "." + entry.key};
}

NamedKey design_key(const Study& study, const std::string& table, const io::Entry& entry) {
  const io::Schema& schema = study.start->schema();
  const std::size_t section_end = std::min(entry.key.find('['), entry.key.size());
  const bool has_section = entry.key.substr(0, section_end).find('.') != std::string::npos;
  const std::string name = schema.name_today(has_section ? entry.key : "layout." + entry.key);
  const io::Key* key = schema.find(name);
  if (key && key->type == io::KeyType::choice && table == "variables")
    throw io::InputError(origin_in(study, table, entry), "names have no bounds", "",
                         fmt::format("list them in [arms]: {} = [\"{}\", \"{}\"]",
                                     key->section == "layout" ? key->name : "\"" + name + "\"", key->choices.front(),
                                     key->choices.back()));
  const bool element = key && key->full_name() != name;
  if (!key || !reason_against(*key).empty() || !(element ? key->list() : can_vary(table, *key)))
    refuse_key(study, table, entry, name, key);
  try {
    if (element) static_cast<void>(schema.get_number(name));
  } catch (const io::InputError& error) {
    throw io::InputError(origin_in(study, table, entry), error.problem(), "",
                         fmt::format("give the design {} with as many values", key->full_name()));
  }
  return {name, *key};
}

const io::ValueList& list_of(const Study& study, const std::string& table, const io::Entry& entry,
                             const std::string& allowed) {
  const auto* list = std::get_if<io::ValueList>(&entry.value.data);
  if (!list || list->empty())
    throw io::InputError(origin_in(study, table, entry), "a list is wanted here", allowed, "");
  return *list;
}

std::pair<double, double> bounds(const Study& study, const io::Key& key, const io::Entry& entry) {
  const io::Origin origin = origin_in(study, "variables", entry);
  const auto& list = list_of(study, "variables", entry, "[lowest, highest]");
  if (list.size() != 2)
    throw io::InputError(origin, fmt::format("bounds are two numbers, not {}", list.size()), "[lowest, highest]", "");
  double bound[2];
  for (std::size_t k = 0; k < 2; ++k) {
    bound[k] = io::parse_quantity(list[k], key.dimension, origin);
    if (!key.range.contains(bound[k]))
      throw io::InputError(origin, fmt::format("the bound {:g} is out of range", bound[k]), key.range.text(), "");
  }
  return {bound[0], bound[1]};
}

void refuse_metres(const Study& study, const io::Key& key, const io::Entry& entry, double low, double high) {
  const geometry::LayoutOptions& layout = study.start->design().layout;
  constexpr double implausible = 0.5;  // m: what is meant in mm
  const bool of_pattern = key.section == "layout" || key.section == "packing";
  if (key.dimension != io::Dimension::length || !of_pattern) return;
  if (low < std::max({implausible, layout.width, layout.height})) return;
  throw io::InputError(origin_in(study, "variables", entry),
                       fmt::format("{:g} to {:g} m are larger than the cell; plain numbers are in m", low, high), "",
                       fmt::format("did you mean [\"{:g} mm\", \"{:g} mm\"]?", low, high));
}

[[noreturn]] void refuse_empty_bounds(const Study& study, const io::Entry& entry, double low, double high) {
  throw io::InputError(origin_in(study, "variables", entry),
                       fmt::format("nothing lies between the bounds {:g} and {:g} (SI)", low, high), "lowest < highest",
                       "write the smaller one first, or set the key in the design instead");
}

}  // namespace perfora::optimize
