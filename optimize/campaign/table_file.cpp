// What is here: reading of files that say what to do with a design. What is not: the design's own file
// (optimize/evaluate/design.h).
#include "optimize/campaign/table_file.h"

#include <fmt/format.h>

#include <algorithm>

#include "io/error.h"
#include "io/files.h"
#include "io/text.h"
#include "io/toml.h"
#include "results/describe.h"

namespace perfora::optimize {
namespace {

constexpr const char* set_table = "set";

std::string section_of(const std::string& key) {
  return key.substr(0, key.find('.'));
}

bool among(const std::vector<std::string>& names, const std::string& name) {
  return std::find(names.begin(), names.end(), name) != names.end();
}

/// Refuses a section of another name than those of the keys and of the tables, which the keys alone do not tell.
void check_section(const io::Entry& entry, const TableFileForm& form, const io::Schema& schema,
                   const std::string& source) {
  const std::string section = section_of(entry.key);
  std::vector<std::string> known = schema.section_names();
  if (section == entry.key || among(known, section) || schema.name_today(entry.key) != entry.key) return;
  known.insert(known.end(), form.tables.begin(), form.tables.end());
  known.emplace_back(set_table);
  std::string all;
  for (const std::string& name : known)
    all += fmt::format("{}[{}{}]", all.empty() ? "" : ", ", name, name == "fidelity" ? ".NAME" : "");
  const std::string nearest = io::nearest_name(section, known);
  throw io::InputError({source, entry.value.line, entry.key}, fmt::format("unknown section [{}]", section),
                       "sections are " + all,
                       nearest.empty() ? fmt::format("keys of the design stand in its own file, or in [{}]", set_table)
                                       : fmt::format("did you mean [{}]?", nearest));
}

}  // namespace

TableFile::TableFile(const std::filesystem::path& path, const TableFileForm& form, io::Schema& schema,
                     const std::vector<std::string>& overrides)
    : path_(path), form_(form), schema_(schema) {
  std::vector<io::Entry> entries = io::read_toml(path);
  results::require_kind(entries, path, form_.kind);
  for (io::Entry& entry : entries) take(std::move(entry), path.string());
  for (const std::string& text : overrides) {
    const std::string section = section_of(text);
    if (among(form_.sections, section))
      schema_.set_override(text);
    else if (section == set_table || among(form_.tables, section))
      for (io::Entry& entry : io::parse_toml(text, "--set")) take(std::move(entry), "--set");
    else
      of_design_.push_back(text);
  }
}

void TableFile::take(io::Entry entry, const std::string& source) {
  const std::string table = section_of(entry.key);
  if (table != set_table && !among(form_.tables, table)) {
    if (entry.key == "title") title_ = io::title_in({entry});
    if (form_.look) form_.look(entry, source);
    check_section(entry, form_, schema_, source);
    return io::apply_entries(schema_, {entry}, source);
  }
  std::erase_if(entry.key,
                [](char c) { return c == '"' || c == '\''; });  // "layout.diameter" is one quoted key in TOML.
  auto& list = table == set_table ? fixed_ : entries_;
  const std::string given = io::after_section(entry.key), key = DesignFile().schema().name_today(given);
  if (key != given) old_names_.push_back({source, entry.value.line, given});
  std::erase_if(list, [&](const TableEntry& other) { return other.table == table && other.key == key; });
  list.push_back({table, key, std::move(entry.value), source});
}

io::Origin TableFile::origin(const std::string& key) const {
  const io::Origin known = schema_.find(key) ? schema_.origin(key) : io::Origin{path_.string(), 0, key};
  return known.file == "default" || known.file.empty() ? io::Origin{path_.string(), 0, key} : known;
}

std::shared_ptr<DesignFile> TableFile::start(const std::filesystem::path& design) const {
  const std::string& section = form_.sections.front();
  if (design.empty())
    throw io::InputError({path_.string(), 0, section + ".design"}, "no design is named to start from",
                         "the path of a design file", fmt::format("add design = \"quick.toml\" under [{}]", section));
  io::require_existing(design, origin(section + ".design"));
  auto start = std::make_shared<DesignFile>(design, of_design_);
  for (const TableEntry& entry : fixed_) io::apply_entries(start->schema(), {{entry.key, entry.value}}, path_.string());
  for (const io::Origin& origin : old_names_) start->schema().note_old_name(origin);
  for (const std::string& text : of_design_) start->schema().set_override(text);  // The command line has the last word.
  return start;
}

}  // namespace perfora::optimize
