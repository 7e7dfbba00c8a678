// What is here: reading and writing the file of a calibrated material. What is not: the keys themselves (describe() of
// geometry and solver).
#include "optimize/evaluate/calibrated_material.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <sstream>
#include <string_view>

#include "io/text.h"
#include "io/toml.h"

namespace perfora::optimize {
namespace {

constexpr const char* from_key = "material.from";
constexpr std::array<std::string_view, 3> sections = {"material", "packing", "noise"};
/// Keys of these sections that belong to one block, not to its material.
constexpr std::array<std::string_view, 3> of_a_block = {from_key, "packing.clip", "packing.file"};

bool of_material(const std::string& key) {
  const std::string_view section = std::string_view(key).substr(0, key.find('.'));
  return std::find(sections.begin(), sections.end(), section) != sections.end() &&
         std::find(of_a_block.begin(), of_a_block.end(), key) == of_a_block.end();
}

void refuse_unless_of_material(const std::string& key, const std::filesystem::path& path, int line,
                               const io::Origin& named) {
  if (of_material(key)) return;
  const std::string at = fmt::format("named by material.from of {}", named.file);
  if (key == from_key)
    throw io::InputError({path.string(), line, key}, "a material file that takes its material from another one", at,
                         "name that other file in the design");
  throw io::InputError({path.string(), line, key}, "is no key of a material",
                       at + "; [material], [packing] and [noise]",
                       "take it out, or name the calibrated.toml of perfora calibrate");
}

}  // namespace

void apply_calibrated_material(io::Schema& schema, const std::filesystem::path& path, const io::Origin& origin) {
  if (!std::filesystem::is_regular_file(path))
    throw io::InputError(origin, fmt::format("there is no file {}", path.string()),
                         "a file such as the calibrated.toml of perfora calibrate, relative to the design file",
                         "check the path");
  std::vector<io::Entry> entries = io::read_toml(path);
  for (const io::Entry& entry : entries)
    if (entry.key.find('.') != std::string::npos)
      refuse_unless_of_material(schema.name_today(entry.key), path, entry.value.line, origin);
  io::apply_entries(schema, entries, path.string());
}

std::string calibrated_material(const DesignFile& design, const std::string& remarks) {
  std::string text, line;
  for (std::istringstream lines(remarks); std::getline(lines, line);) text += "# " + line + "\n";
  const bool imported = !design.design().packing.file.empty();
  for (const std::string_view section : sections) {
    if (imported && section == "packing") continue;
    text += fmt::format("\n[{}]\n", section);
    for (const io::Key& key : design.schema().keys())
      if (key.section == section && of_material(key.full_name()))
        text += fmt::format("{} = {}\n", key.name, io::toml_literal(key.get(), io::Digits::shortest));
  }
  return text;
}

}  // namespace perfora::optimize
