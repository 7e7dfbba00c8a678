// What is here: reading a table of numbers with named columns from a text file; quoting of a text field.
// What is not: what the columns mean; writing of whole tables.
#pragma once

#include <cstddef>
#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include "io/schema.h"

namespace perfora::io {

struct CsvTable {
  std::vector<std::vector<double>> columns;  ///< one for each wanted name, in that order, equally long
  std::vector<int> lines;                    ///< line of the file each row stands on, for messages
  std::size_t rows() const { return lines.size(); }
};

/// Reads the columns `wanted`. The first line that is not blank may name the columns (in any order, any case; others
/// are skipped); without such a line there must be exactly as many columns as wanted, in that order. Values are
/// separated by commas, or by blanks where a line has no comma; '#' starts a comment. Numbers are taken as they are
/// (SI). Throws InputError with file and line for a missing or empty file, a missing column, a wrong number of values,
/// anything that is not a finite number, or more than `maximum_rows` rows.
CsvTable read_csv(const std::filesystem::path& path, const std::vector<std::string>& wanted, std::size_t maximum_rows);
/// The same from text; `name` stands for the file in messages.
CsvTable parse_csv(std::string_view text, const std::string& name, const std::vector<std::string>& wanted,
                   std::size_t maximum_rows);

/// A column that may carry a unit in its header: any of `names`, then the unit in brackets ("stress [MPa]",
/// "stress (MPa)"); without one, or with [-] for a ratio, the numbers are SI.
struct CsvQuantity {
  std::vector<std::string> names;  ///< the first one stands in messages
  Dimension dimension = Dimension::none;
  std::string example;  ///< of a header, for messages: "stress [MPa]"
};
/// The same with units, numbers turned into SI. The first line that is not blank must name the columns.
CsvTable read_csv(const std::filesystem::path& path, const std::vector<CsvQuantity>& wanted, std::size_t maximum_rows);

/// Names of the columns, in lower case; none where the first line that is not blank holds a number.
std::vector<std::string> csv_names(const std::filesystem::path& path);

/// A table with named columns whose fields are texts: names of shapes beside numbers.
struct CsvTexts {
  std::vector<std::string> names;              ///< in lower case, without units
  std::vector<std::string> units;              ///< of the columns, as in "x [mm]"; "": the header names none
  std::vector<std::vector<std::string>> rows;  ///< each as long as names
  std::vector<int> lines;                      ///< as in CsvTable
};
/// Reads a file as read_csv does, but for quoted fields, which may hold commas; the first line that is not blank must
/// name the columns. Throws InputError for a missing file, a line with a wrong number of fields, too many rows.
CsvTexts read_csv_texts(const std::filesystem::path& path, std::size_t maximum_rows);

/// A table that perfora wrote: every field as text.
struct TextTable {
  std::filesystem::path path;
  std::vector<std::string> names;
  std::vector<std::vector<std::string>> rows;  ///< each as long as names

  /// Place of the column called so. Throws InputError where there is none.
  std::size_t column(const std::string& name) const;
};
/// Reads lines of fields that are quoted as csv_quoted does where they need it; the first line names the columns.
/// Throws InputError for a missing or empty file and a line with a wrong number of fields.
TextTable read_text_table(const std::filesystem::path& path);
/// The number in a field; NaN for an empty one or one that is no number.
double number_in(const std::string& field);

/// `text` as one field of a CSV line: in quotes, quotes inside it doubled (RFC 4180).
std::string csv_quoted(std::string_view text);

}  // namespace perfora::io
