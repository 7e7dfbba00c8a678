// What is here: files that say what to do with a design (studies, sweeps, calibrations): sections of keys of their own,
// tables whose keys are the design's, [set], and which --set goes where. What is not: what the keys and tables mean.
#pragma once

#include <filesystem>
#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "optimize/evaluate/design.h"

namespace perfora::optimize {

/// What such a file holds besides [set].
struct TableFileForm {
  std::string kind;                   ///< results::kind_of_toml()
  std::vector<std::string> sections;  ///< whose keys a schema knows; the first one has the key `design`
  std::vector<std::string> tables;    ///< whose keys are those of the design, with values that are not the design's
  /// Looks at an entry of a section, or of no section that is known, before the schema takes it; may change its value
  /// or throw io::InputError. May be empty.
  std::function<void(io::Entry&, const std::string& source)> look = {};
};

/// An entry of a table.
struct TableEntry {
  std::string table;
  std::string key;  ///< of the design, its name of today, without quotes: "layout.diameter"
  io::Value value;
  std::string source;  ///< the file, or "--set"

  io::Origin origin() const { return {source, value.line, table + "." + key}; }
};

/// Reads such a file; where two entries of a table have one key, the later one counts, in its place.
class TableFile {
 public:
  /// Keys of form.sections go to `schema`. `overrides` are "section.key=value": those of the file's sections, tables
  /// and [set] belong to the file, all others to the design. Throws io::InputError.
  TableFile(const std::filesystem::path& path, const TableFileForm& form, io::Schema& schema,
            const std::vector<std::string>& overrides);

  /// The file's own title, otherwise its name without the ending.
  std::string title() const { return title_.empty() ? path_.stem().string() : title_; }
  const std::vector<TableEntry>& entries() const { return entries_; }       ///< in order, without [set]
  const std::vector<TableEntry>& fixed() const { return fixed_; }           ///< of [set]
  const std::vector<std::string>& of_design() const { return of_design_; }  ///< overrides that are the design's
  /// Where a key of a section was set; the file itself where it was not.
  io::Origin origin(const std::string& key) const;
  /// The design named `design`, with what [set] says and then the overrides. Throws io::InputError when it is empty.
  std::shared_ptr<DesignFile> start(const std::filesystem::path& design) const;

 private:
  void take(io::Entry entry, const std::string& source);

  std::filesystem::path path_;
  std::string title_;
  TableFileForm form_;
  io::Schema& schema_;
  std::vector<TableEntry> entries_, fixed_;
  std::vector<std::string> of_design_;
  std::vector<io::Origin> old_names_;  ///< of keys in the tables that have another name today
};

}  // namespace perfora::optimize
