// What is here: the generic table of keys (name, type, dimension, default, range, help) that the reader, --set, check,
// nearest-key errors, study variables, the resolved configuration and the printed reference all use.
// What is not: any physics; each room describes its own options struct to this table.
#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <limits>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <variant>
#include <vector>

#include "io/error.h"

namespace perfora::io {

/// Physical dimension of a key. Plain numbers are SI; strings such as "20 mm", "2 MPa", "25 %" are taken for any
/// dimension but `none`. `ratio` is a pure number that may be written in percent.
/// From `count` on they are those of results: no key has them.
enum class Dimension {
  none,
  ratio,
  length,
  area,
  stress,
  stiffness,
  density,
  time,
  rate,
  angle,
  count,
  energy_density,
  surface_energy,
  memory
};

/// Closed or half-open interval of allowed numbers; `text()` prints it for messages.
struct Range {
  double low = -std::numeric_limits<double>::infinity();
  double high = std::numeric_limits<double>::infinity();
  bool low_open = false;              ///< true: `low` itself is not allowed
  bool high_open = false;             ///< true: `high` itself is not allowed
  bool contains(double value) const;  ///< false for NaN
  std::string text() const;

  static Range positive() { return {0.0, std::numeric_limits<double>::infinity(), true, true}; }
  static Range non_negative() { return {0.0, std::numeric_limits<double>::infinity(), false, true}; }
  static Range between(double low, double high) { return {low, high, false, false}; }
  static Range at_least(double low) { return {low, std::numeric_limits<double>::infinity(), false, true}; }
};

/// A value as written in a file or on the command line, before its key gives it a type.
struct Value;
using ValueList = std::vector<Value>;
struct Value {
  std::variant<bool, std::int64_t, double, std::string, ValueList> data;
  int line = 0;
};

enum class KeyType { real, integer, boolean, text, choice, path, real_list, real_rows };

/// One row of the table. `set` throws InputError with the given origin; `get` returns the current value (SI).
struct Key {
  std::string section;
  std::string name;
  KeyType type = KeyType::real;
  Dimension dimension = Dimension::none;
  Range range;
  std::vector<std::string> choices;  ///< only for KeyType::choice
  std::string default_text;          ///< the value the field had when it was described
  std::string help;
  bool only_where_set = false;  ///< resolved configurations leave it out at its default
  std::function<void(const Value&, const Origin&)> set;
  std::function<Value()> get;

  std::string full_name() const { return section + "." + name; }
  bool at_default() const;  ///< the value is now what it was when the key was described
  bool numeric() const { return type == KeyType::real || type == KeyType::integer; }
  bool list() const { return type == KeyType::real_list || type == KeyType::real_rows; }
};

class Schema;

/// Whether a list may be written as one number, without brackets.
enum class OneNumber { refused, taken };

/// Behind the name of a key of a file, that of the key of its content.
inline constexpr const char* checksum_suffix = "_checksum";

/// Adds the keys of one section; every call binds a key to a field that must outlive the Schema. The field's value at
/// that moment is the default.
class Section {
 public:
  Section& real(std::string name, double& field, Dimension dimension, Range range, std::string help);
  Section& integer(std::string name, std::int64_t& field, Range range, std::string help);
  Section& integer(std::string name, int& field, Range range, std::string help);
  Section& boolean(std::string name, bool& field, std::string help);
  Section& text(std::string name, std::string& field, std::string help);
  /// A relative path is resolved against the folder of the file it is written in.
  Section& path(std::string name, std::filesystem::path& field, std::string help);
  /// A path, resolved as above, of a file that counts by what it holds: `checksum` becomes that of the content whenever
  /// the path is set (empty where it cannot be read: whoever reads it says so). NAME_checksum is a key as well, set
  /// after the path: records carry it, so that what a file held then is not taken for what it holds now.
  Section& file(std::string name, std::filesystem::path& field, std::string& checksum, std::string help);
  /// A path, resolved as above, whose file gives other keys their values: `read` is called when the key is set and sets
  /// them, so what is set later counts. The key itself stays empty: a resolved configuration names no such file.
  Section& source(std::string name, std::function<void(const std::filesystem::path&, const Origin&)> read,
                  std::string help);
  Section& real_list(std::string name, std::vector<double>& field, Dimension dimension, Range range, std::string help,
                     OneNumber one = OneNumber::refused);
  /// A number (kept as a list of one), a list of numbers, or one of `words` (kept in `*word`, which is empty where
  /// numbers stand). Number k of a list has dimensions[k], those behind the last one its.
  struct NumbersForm {
    std::vector<Dimension> dimensions;
    std::string* word = nullptr;  ///< must outlive the Schema; nullptr: no words
    std::vector<std::string> words = {};
    std::size_t fewest = 0, most = 2;  ///< numbers; an empty list takes the key back where fewest is 0
  };
  Section& numbers(std::string name, std::vector<double>& field, NumbersForm form, std::string help);
  /// A list of rows of `columns` numbers each, flattened row by row into `field` (size rows x columns).
  Section& real_rows(std::string name, std::vector<double>& field, int columns, Dimension dimension, std::string help);
  template <class Enum>
  Section& choice(std::string name, Enum& field, std::vector<std::pair<std::string, Enum>> values, std::string help) {
    std::vector<std::string> names;
    for (const auto& value : values) names.push_back(value.first);
    auto set_index = [&field, values](std::size_t index) { field = values[index].second; };
    auto get_index = [&field, values]() -> std::size_t {
      for (std::size_t k = 0; k < values.size(); ++k)
        if (values[k].second == field) return k;
      return 0;
    };
    return add_choice(std::move(name), std::move(names), std::move(set_index), std::move(get_index), std::move(help));
  }

 private:
  friend class Schema;
  Section(Schema& schema, std::string name) : schema_(&schema), name_(std::move(name)) {}
  Section& add_choice(std::string name, std::vector<std::string> names, std::function<void(std::size_t)> set_index,
                      std::function<std::size_t()> get_index, std::string help);
  Section& add(Key key);
  Schema* schema_;
  std::string name_;
};

/// An old name of a key or, without a dot, of a section, and what it is called now.
struct Renaming {
  std::string old_name, name;
};

/// A name that people expect to be a key and that is none: what is wrong with it, and what to do instead.
struct NoKey {
  std::string name, problem, remedy;
};

/// Which names a text of keys is written with: those of today, or those the keys had at first (hashes and keys of
/// journals are made of these, so that a renaming leaves them as they are).
enum class Names { today, first };

/// The table of keys of one options object. An element of a list goes by the name of its key and its place from 0:
/// "layout.row_diameter[1]", in a list of rows "layout.holes[3][2]"; it must be there already. Not copyable: its keys
/// are bound to that object's fields.
class Schema {
 public:
  Schema() = default;
  Schema(const Schema&) = delete;
  Schema& operator=(const Schema&) = delete;
  Schema(Schema&&) = delete;

  Section section(std::string name, std::string help);
  const std::vector<Key>& keys() const { return keys_; }
  std::vector<std::string> section_names() const;
  const std::string& section_help(std::string_view section) const;
  /// nullptr when there is no such key; the list where an element is named. Takes old names, as all functions here do
  /// that are given a name.
  const Key* find(std::string_view full_name) const;

  /// The key of that name. Throws InputError naming the nearest one where there is none.
  const Key& at(std::string_view full_name, Origin origin = {}) const;

  /// Old names that are still taken: of a key ("material.critical_normal_stretch") or of a section ("test"). This is
  /// the one place where names are resolved: files, --set, variables, arms, headers of journals, stored configurations.
  void renamed(Renaming renaming) { renamings_.push_back(std::move(renaming)); }
  /// A name that is refused with a remedy of its own, wherever it is used.
  void no_key(NoKey no_key) { no_keys_.push_back(std::move(no_key)); }
  /// What a key is called now; the name itself where it was never renamed.
  std::string name_today(std::string_view full_name) const;
  /// What a key was called at first.
  std::string first_name(std::string_view full_name) const;
  /// One sentence for each old name that a file or --set used.
  std::vector<std::string> notices() const;
  /// Remembers that the old name origin.key stands at `origin`.
  void note_old_name(const Origin& origin);

  /// Whether the name stands for one number, which a study may vary: a numeric key, or an element of a list.
  bool is_number(std::string_view full_name) const;

  /// Sets one key or one element of a list. Throws InputError naming the nearest key for an unknown one, the wanted
  /// type, unit or range for a bad value.
  void set(std::string_view full_name, const Value& value, Origin origin);
  /// Sets one number (is_number()) in SI; throws as set() does.
  void set_number(std::string_view full_name, double value, Origin origin);
  double get_number(std::string_view full_name) const;
  /// "section.key=value" as on the command line (value in TOML syntax, or a bare string).
  void set_override(std::string_view text);
  /// Where a key was last set: file and line, or "--set"; the default origin (file "default") otherwise.
  Origin origin(std::string_view full_name) const;

  /// Says of every key what `other` says: for a copy of the options it is bound to.
  void take_origins(const Schema& other) { origins_ = other.origins_; }

  /// The complete resolved configuration as TOML text (SI numbers that give every double back, every key).
  std::string to_toml(Names names = Names::today) const;
  /// The same without keys at their defaults: it stays as it is when the program learns a new key.
  std::string changed_toml(Names names = Names::today) const;
  /// The printed reference: a Markdown table a section.
  std::string reference() const;

 private:
  friend class Section;
  std::string toml(Names names, bool changed_only) const;
  std::vector<std::pair<std::string, std::string>> sections_;
  std::vector<Key> keys_;
  std::vector<std::pair<std::string, Origin>> origins_;
  std::vector<Renaming> renamings_;
  std::vector<NoKey> no_keys_;
  std::vector<Origin> used_old_names_;
};

/// One "section.key = value" of a TOML file, in file order. Array-of-table and deeper tables are flattened with dots.
struct Entry {
  std::string key;
  Value value;
};

/// Version of the keys of all files, which a file may name at its top as `schema_version`: raised when a key changes
/// its meaning. A file that names none is of this one.
inline constexpr std::int64_t schema_version = 1;
/// Sets every entry of the file in the schema. At the top level `title` and `description` are free texts, and a
/// `schema_version` above the program's is refused (io::InputError).
void apply_toml(Schema& schema, const std::filesystem::path& path);
void apply_entries(Schema& schema, const std::vector<Entry>& entries, const std::string& file);

}  // namespace perfora::io
