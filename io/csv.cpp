// What is here: reading a table of numbers with named columns. What is not: what the columns mean.
#include "io/csv.h"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <cmath>
#include <optional>
#include <string_view>

#include "io/error.h"
#include "io/letters.h"
#include "io/numbers.h"
#include "io/text.h"
#include "io/text_file.h"
#include "io/units.h"

namespace perfora::io {
namespace {

constexpr std::string_view blanks = " \t\r\v\f";

std::string_view unquoted(std::string_view text) {
  const bool quotes = text.size() >= 2 && text.front() == '"' && text.back() == '"';
  return quotes ? trimmed(text.substr(1, text.size() - 2)) : text;
}

std::vector<std::string_view> fields_of(std::string_view line) {
  std::vector<std::string_view> fields;
  const bool commas = line.find(',') != std::string_view::npos;
  while (!line.empty()) {
    const std::size_t end = commas ? line.find(',') : line.find_first_of(blanks);
    fields.push_back(unquoted(trimmed(line.substr(0, end))));
    if (end == std::string_view::npos) return fields;
    line.remove_prefix(end + 1);
    if (!commas) line = trimmed(line);
    if (commas && line.empty()) fields.emplace_back();  // a comma at the end leaves an empty last value
  }
  return fields;
}

/// Walks the lines that hold something, comments cut off.
class Lines {
 public:
  explicit Lines(std::string_view text) : rest_(text) {
    constexpr std::string_view byte_order_mark = "\xEF\xBB\xBF";
    if (rest_.substr(0, byte_order_mark.size()) == byte_order_mark) rest_.remove_prefix(byte_order_mark.size());
  }

  bool next() {
    while (!rest_.empty()) {
      const std::size_t end = rest_.find('\n');
      const std::string_view line = rest_.substr(0, end);
      rest_.remove_prefix(end == std::string_view::npos ? rest_.size() : end + 1);
      ++number_;
      line_ = trimmed(line.substr(0, line.find('#')));
      if (!line_.empty()) return true;
    }
    return false;
  }

  std::string_view line() const { return line_; }
  int number() const { return number_; }

 private:
  std::string_view rest_, line_;
  int number_ = 0;
};

/// A wanted column: its name in messages, and the unit that its numbers are in ("": as they are).
struct Column {
  std::string name, unit;
  Dimension dimension = Dimension::none;
};

struct Layout {
  std::size_t fields = 0;              ///< values in each line
  std::vector<std::size_t> positions;  ///< of the wanted columns
  std::vector<Column> columns;         ///< the wanted ones
  bool header = false;
};

std::size_t position_of(const std::string& name, const std::vector<std::string>& names, const Origin& origin) {
  const auto found = std::find(names.begin(), names.end(), lower(name));
  if (found == names.end())
    throw InputError(origin, fmt::format("has no column {}", name), "its columns are " + joined(names),
                     names.size() == 1 && names.front().find(';') != std::string::npos
                         ? "separate columns by commas, and write decimal points"
                         : fmt::format("name a column {}", name));
  if (std::find(found + 1, names.end(), *found) != names.end())
    throw InputError(origin, fmt::format("names the column {} twice", name), "", "remove one of them");
  return static_cast<std::size_t>(found - names.begin());
}

Layout layout_of(const std::vector<std::string_view>& first, const std::vector<std::string>& wanted,
                 const Origin& origin) {
  Layout layout{.fields = first.size(), .positions = {}, .columns = {}, .header = false};
  for (const std::string& name : wanted) layout.columns.push_back({.name = name, .unit = {}});
  layout.header =
      std::none_of(first.begin(), first.end(), [](std::string_view field) { return number_from(field).has_value(); });
  if (!layout.header) {
    layout.fields = wanted.size();
    for (std::size_t k = 0; k < wanted.size(); ++k) layout.positions.push_back(k);
    return layout;
  }
  std::vector<std::string> names;
  for (const std::string_view field : first) names.push_back(lower(field));
  for (const std::string& name : wanted) layout.positions.push_back(position_of(name, names, origin));
  return layout;
}

/// A header field such as "Stress [MPa]": lower-case name, unit as written.
struct Heading {
  std::string name, unit;
};

Heading heading_of(std::string_view field) {
  const std::size_t open = field.find_first_of("[(");
  if (open == std::string_view::npos) return {lower(field), ""};
  const std::size_t close = field.find_first_of("])", open);
  const std::string_view unit = trimmed(field.substr(open + 1, close - open - 1));
  return {lower(trimmed(field.substr(0, open))), std::string(unit == "-" ? "" : unit)};
}

/// Fields of a header; between blanks a unit stands apart from its name.
std::vector<std::string> header_fields(std::string_view line) {
  std::vector<std::string> fields;
  for (const std::string_view field : fields_of(line)) {
    if (!fields.empty() && !field.empty() && (field.front() == '[' || field.front() == '('))
      fields.back().append(field);
    else
      fields.emplace_back(field);
  }
  return fields;
}

Column column_of(const CsvQuantity& quantity, const Heading& heading, const Origin& origin) {
  if (!heading.unit.empty() && !is_unit(heading.unit, quantity.dimension))
    throw InputError(origin,
                     fmt::format("column {}: {} is no unit of a {}", heading.name, in_quotes(heading.unit),
                                 dimension_name(quantity.dimension)),
                     "accepted are " + accepted_units(quantity.dimension), "correct the unit or leave it out for SI");
  return {heading.name, heading.unit, quantity.dimension};
}

Layout layout_of(std::string_view line, const std::vector<CsvQuantity>& wanted, const Origin& origin) {
  std::vector<std::string> examples;
  for (const CsvQuantity& quantity : wanted) examples.push_back(quantity.example);
  const std::string example = fmt::format("a first line such as \"{}\" is wanted", joined(examples));
  if (line.find(';') != std::string_view::npos)
    throw InputError(origin, "values are separated by semicolons", "commas, tabs or blanks are allowed",
                     "export it with commas and decimal points");
  const std::vector<std::string> fields = header_fields(line);
  Layout layout{.fields = fields.size(), .positions = {}, .columns = {}, .header = true};
  std::vector<Heading> headings;
  std::vector<std::string> names;
  for (const std::string& field : fields) {
    if (number_from(field))
      throw InputError(origin, "the first line does not name the columns", example, "add one (without #)");
    headings.push_back(heading_of(field));
    names.push_back(headings.back().name);
  }
  for (const CsvQuantity& quantity : wanted) {
    const auto named = std::find_if(quantity.names.begin(), quantity.names.end(), [&](const std::string& name) {
      return std::find(names.begin(), names.end(), name) != names.end();
    });
    if (named == quantity.names.end())
      throw InputError(origin, fmt::format("has no column {}", fmt::join(quantity.names, " or ")),
                       "its columns are " + joined(names), example);
    layout.positions.push_back(position_of(*named, names, origin));
    layout.columns.push_back(column_of(quantity, headings[layout.positions.back()], origin));
  }
  return layout;
}

double value_of(std::string_view text, const Column& column, const Origin& origin) {
  const std::optional<double> number = number_from(text);
  if (number && std::isfinite(*number))
    return column.unit.empty() ? *number
                               : parse_quantity({fmt::format("{} {}", text, column.unit)}, column.dimension, origin);
  const std::string found = text.empty() ? "is empty" : fmt::format("{} is not a finite number", in_quotes(text));
  throw InputError(
      origin, fmt::format("column {}: {}", column.name, found),
      fmt::format("plain numbers in {} with a decimal point are wanted", column.unit.empty() ? "SI" : column.unit),
      "correct this line");
}

void add_row(CsvTable& table, const Layout& layout, const Lines& at, const Origin& origin) {
  const std::vector<std::string_view> fields = fields_of(at.line());
  if (fields.size() != layout.fields) {
    std::vector<std::string> names;
    for (const Column& column : layout.columns) names.push_back(column.name);
    throw InputError(origin, fmt::format("has {} values", fields.size()),
                     layout.header ? fmt::format("the header names {} columns", layout.fields)
                                   : fmt::format("the {} columns {} are wanted", layout.fields, joined(names)),
                     layout.header ? "correct this line" : "correct this line or name the columns in a first line");
  }
  for (std::size_t k = 0; k < layout.columns.size(); ++k)
    table.columns[k].push_back(value_of(fields[layout.positions[k]], layout.columns[k], origin));
  table.lines.push_back(at.number());
}

constexpr std::size_t largest_table = std::size_t{1} << 30;

/// The rows of `text`; `layout_for` reads its first line.
template <class LayoutOf>
CsvTable rows_of(std::string_view text, const std::string& name, const std::vector<std::string>& wanted,
                 std::size_t maximum_rows, const LayoutOf& layout_for) {
  CsvTable table;
  table.columns.resize(wanted.size());
  Lines lines(text);
  std::optional<Layout> layout;
  while (lines.next()) {
    const Origin origin{name, lines.number(), ""};
    if (!layout) {
      layout = layout_for(lines.line(), origin);
      if (layout->header) continue;
    }
    if (table.rows() == maximum_rows)
      throw InputError(origin, fmt::format("is more than the {} rows allowed", maximum_rows), "", "shorten the file");
    add_row(table, *layout, lines, origin);
  }
  if (table.rows() == 0)
    throw InputError({name, 0, ""}, "holds no rows of numbers", fmt::format("columns {} are wanted", joined(wanted)),
                     "check the path");
  return table;
}

}  // namespace

CsvTable read_csv(const std::filesystem::path& path, const std::vector<std::string>& wanted, std::size_t maximum_rows) {
  return parse_csv(read_text_file(path, largest_table, "a CSV table"), path.string(), wanted, maximum_rows);
}

CsvTable parse_csv(std::string_view text, const std::string& name, const std::vector<std::string>& wanted,
                   std::size_t maximum_rows) {
  return rows_of(text, name, wanted, maximum_rows, [&](std::string_view line, const Origin& origin) {
    return layout_of(fields_of(line), wanted, origin);
  });
}

CsvTable read_csv(const std::filesystem::path& path, const std::vector<CsvQuantity>& wanted, std::size_t maximum_rows) {
  std::vector<std::string> names;
  for (const CsvQuantity& quantity : wanted) names.push_back(quantity.names.front());
  return rows_of(read_text_file(path, largest_table, "a CSV table"), path.string(), names, maximum_rows,
                 [&](std::string_view line, const Origin& origin) { return layout_of(line, wanted, origin); });
}

namespace {

/// Fields of one line, without their quotes.
std::vector<std::string> quoted_fields(std::string_view line) {
  std::vector<std::string> fields(1);
  bool quoted = false;
  for (std::size_t k = 0; k < line.size(); ++k) {
    const char c = line[k];
    if (quoted && c == '"' && k + 1 < line.size() && line[k + 1] == '"')
      fields.back() += line[++k];
    else if (c == '"')
      quoted = !quoted;
    else if (c == ',' && !quoted)
      fields.emplace_back();
    else
      fields.back() += c;
  }
  return fields;
}

/// Fields of a line of someone else's file.
std::vector<std::string> text_fields(std::string_view line) {
  std::vector<std::string> fields;
  if (line.find(',') == std::string_view::npos) {
    for (const std::string_view field : fields_of(line)) fields.emplace_back(field);
    return fields;
  }
  for (const std::string& field : quoted_fields(line)) fields.emplace_back(trimmed(field));
  return fields;
}

}  // namespace

std::vector<std::string> csv_names(const std::filesystem::path& path) {
  const std::string text = read_text_file(path, largest_table, "a CSV table");
  Lines lines(text);
  if (!lines.next()) return {};
  std::vector<std::string> names;
  for (const std::string& field : text_fields(lines.line())) {
    if (number_from(field)) return {};
    names.push_back(lower(field));
  }
  return names;
}

CsvTexts read_csv_texts(const std::filesystem::path& path, std::size_t maximum_rows) {
  const std::string text = read_text_file(path, largest_table, "a CSV table");
  CsvTexts table;
  Lines lines(text);
  while (lines.next()) {
    const Origin origin{path.string(), lines.number(), ""};
    std::vector<std::string> fields = text_fields(lines.line());
    if (table.names.empty()) {
      if (lines.line().find(',') == std::string_view::npos) fields = header_fields(lines.line());
      for (const std::string& field : fields) {
        Heading heading = heading_of(field);
        table.names.push_back(std::move(heading.name));
        table.units.push_back(std::move(heading.unit));
      }
      continue;
    }
    if (table.rows.size() == maximum_rows)
      throw InputError(origin, fmt::format("is more than the {} rows allowed", maximum_rows), "", "shorten the file");
    if (fields.size() != table.names.size())
      throw InputError(origin, fmt::format("has {} values", fields.size()),
                       fmt::format("the header names {} columns", table.names.size()),
                       "correct this line; a text with commas stands in quotes");
    table.rows.push_back(std::move(fields));
    table.lines.push_back(lines.number());
  }
  return table;
}

std::size_t TextTable::column(const std::string& name) const {
  const auto found = std::find(names.begin(), names.end(), name);
  if (found == names.end()) throw InputError({path.string(), 1, ""}, "has no column " + name, "", "check the path");
  return static_cast<std::size_t>(found - names.begin());
}

TextTable read_text_table(const std::filesystem::path& path) {
  const std::string text = read_text_file(path, std::size_t{1} << 32, "a CSV table");
  TextTable table;
  table.path = path;
  int number = 0;
  for (std::size_t start = 0; start < text.size();) {
    const std::size_t end = std::min(text.find('\n', start), text.size());
    std::vector<std::string> fields = quoted_fields(std::string_view(text).substr(start, end - start));
    ++number;
    start = end + 1;
    if (number == 1) {
      table.names = std::move(fields);
      continue;
    }
    if (fields.size() != table.names.size())
      throw InputError({path.string(), number, ""},
                       fmt::format("has {} fields, the first line names {}", fields.size(), table.names.size()), "",
                       "perfora writes this file anew when its work goes on");
    table.rows.push_back(std::move(fields));
  }
  if (table.names.empty()) throw InputError({path.string(), 0, ""}, "is empty", "", "check the path");
  return table;
}

double number_in(const std::string& field) {
  return number_from(field).value_or(std::numeric_limits<double>::quiet_NaN());
}

std::string csv_quoted(std::string_view text) {
  std::string quoted(1, '"');
  for (const char c : text) quoted.append(c == '"' ? 2 : 1, c);
  quoted += '"';
  return quoted;
}

}  // namespace perfora::io
