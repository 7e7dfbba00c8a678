// What is here: how each kind of key takes a value into its field and gives it back.
// What is not: the table as a whole (schema.cpp), units (units.cpp).
#include <fmt/format.h>

#include <algorithm>
#include <cassert>
#include <cmath>
#include <optional>

#include "io/error.h"
#include "io/files.h"
#include "io/schema.h"
#include "io/text.h"
#include "io/units.h"

namespace perfora::io {
namespace {

Origin at_line_of(Origin origin, const Value& value) {
  if (value.line > 0) origin.line = value.line;
  return origin;
}

/// What to do about a number out of range: a ratio may be meant in percent.
std::string in_percent(double number, const Range& range, Dimension dimension) {
  constexpr double percent = 100.0, least = 2.0;  // 1.2 is no percent
  if (dimension != Dimension::ratio || number < least || !range.contains(number / percent))
    return "choose a value in that range";
  return fmt::format("did you mean {0}, which is \"{1} %\"?", shortest(rounded(number / percent)), shortest(number));
}

void check_range(double number, const Range& range, Dimension dimension, const Origin& origin,
                 const std::string& which = {}) {
  if (range.contains(number)) return;
  const std::string unit(si_unit(dimension));
  throw InputError(origin,
                   fmt::format("{}{}{} is out of range", which, shortest(number), unit.empty() ? "" : " " + unit),
                   fmt::format("allowed: {}{}", range.text(), unit.empty() ? "" : fmt::format(" (in {})", unit)),
                   in_percent(number, range, dimension));
}

[[noreturn]] void refuse(const Value& value, const std::string& wanted, const Origin& origin) {
  throw InputError(origin, "found " + describe_value(value), wanted);
}

/// Whole numbers, also when written as 6.0; nothing for anything else.
std::optional<std::int64_t> as_integer(const Value& value) {
  constexpr double largest_exact = 9007199254740992.0;  // 2^53: beyond it a double no longer names one whole number
  if (const auto* whole = std::get_if<std::int64_t>(&value.data)) return *whole;
  const auto* number = std::get_if<double>(&value.data);
  if (number == nullptr || !(std::abs(*number) <= largest_exact) || *number != std::floor(*number)) return std::nullopt;
  return static_cast<std::int64_t>(*number);
}

std::int64_t integer_in_range(const Value& value, const Range& range, std::int64_t low, std::int64_t high,
                              const Origin& origin) {
  const std::optional<std::int64_t> number = as_integer(value);
  if (!number) refuse(value, "a whole number is wanted, such as 6", origin);
  check_range(static_cast<double>(*number), range, Dimension::none, origin);
  if (*number < low || *number > high)
    throw InputError(origin, fmt::format("{} is too large a whole number", *number),
                     fmt::format("allowed: {} to {}", low, high));
  return *number;
}

const std::string& text_of(const Value& value, const std::string& wanted, const Origin& origin) {
  const auto* text = std::get_if<std::string>(&value.data);
  if (text == nullptr) refuse(value, wanted, origin);
  return *text;
}

std::vector<double> row_of(const Value& value, std::size_t number, int columns, Dimension dimension, Origin origin) {
  origin = at_line_of(origin, value);
  const auto* row = std::get_if<ValueList>(&value.data);
  const std::string wanted = fmt::format("each row is a list of {} numbers or quantities", columns);
  if (row == nullptr) throw InputError(origin, fmt::format("row {} is {}", number, describe_value(value)), wanted);
  if (row->size() != static_cast<std::size_t>(columns))
    throw InputError(origin,
                     row->empty() ? fmt::format("row {} is empty", number)
                                  : fmt::format("row {} has {} values", number, row->size()),
                     wanted, fmt::format("give row {} its {} values or remove it", number, columns));
  std::vector<double> numbers;
  for (const Value& element : *row) {
    try {
      numbers.push_back(parse_quantity(element, dimension, at_line_of(origin, element)));
    } catch (const InputError& error) {
      throw InputError(error.origin(), fmt::format("row {}, value {}: {}", number, numbers.size() + 1, error.problem()),
                       wanted);
    }
  }
  return numbers;
}

Key described(std::string name, KeyType type, std::string help, Dimension dimension = Dimension::none,
              const Range& range = {}) {
  Key key;
  key.name = std::move(name);
  key.type = type;
  key.dimension = dimension;
  key.range = range;
  key.help = std::move(help);
  return key;
}

Value list_value(std::vector<double>::const_iterator first, std::vector<double>::const_iterator last) {
  ValueList list;
  for (; first != last; ++first) list.push_back({*first});
  return {std::move(list)};
}

/// A path as written: nothing, or an absolute one, relative to the folder of the file that it stands in.
std::filesystem::path path_of(const Value& value, const Origin& origin) {
  const std::string& written = text_of(value, "a path in quotes is wanted", origin);
  if (written.find('\0') != std::string::npos)
    throw InputError(origin, "the path contains a null character", "", "write a plain path");
  if (written.empty()) return {};
  const std::filesystem::path folder = std::filesystem::path(origin.file).parent_path();
  return std::filesystem::absolute(folder / written).lexically_normal();
}

std::string checksum_if_readable(const std::filesystem::path& path) {
  try {
    return path.empty() ? std::string() : content_checksum(path);
  } catch (const InputError&) {
    return {};
  }
}

}  // namespace

Section& Section::add(Key key) {
  key.section = name_;
  key.default_text = toml_literal(key.get(), Digits::shortest);
  assert(schema_->find(key.full_name()) == nullptr && "a key is described once");
  schema_->keys_.push_back(std::move(key));
  return *this;
}

Section& Section::real(std::string name, double& field, Dimension dimension, Range range, std::string help) {
  assert(range.contains(field) && "a default lies in its own range");
  Key key = described(std::move(name), KeyType::real, std::move(help), dimension, range);
  key.set = [&field, dimension, range](const Value& value, const Origin& origin) {
    const double number = parse_quantity(value, dimension, origin);
    check_range(number, range, dimension, origin);
    field = number;
  };
  key.get = [&field] { return Value{field}; };
  return add(std::move(key));
}

Section& Section::integer(std::string name, std::int64_t& field, Range range, std::string help) {
  assert(range.contains(static_cast<double>(field)) && "a default lies in its own range");
  Key key = described(std::move(name), KeyType::integer, std::move(help), Dimension::none, range);
  key.set = [&field, range](const Value& value, const Origin& origin) {
    using Limits = std::numeric_limits<std::int64_t>;
    field = integer_in_range(value, range, Limits::min(), Limits::max(), origin);
  };
  key.get = [&field] { return Value{field}; };
  return add(std::move(key));
}

Section& Section::integer(std::string name, int& field, Range range, std::string help) {
  assert(range.contains(field) && "a default lies in its own range");
  Key key = described(std::move(name), KeyType::integer, std::move(help), Dimension::none, range);
  key.set = [&field, range](const Value& value, const Origin& origin) {
    using Limits = std::numeric_limits<int>;
    field = static_cast<int>(integer_in_range(value, range, Limits::min(), Limits::max(), origin));
  };
  key.get = [&field] { return Value{std::int64_t{field}}; };
  return add(std::move(key));
}

Section& Section::boolean(std::string name, bool& field, std::string help) {
  Key key = described(std::move(name), KeyType::boolean, std::move(help));
  key.set = [&field](const Value& value, const Origin& origin) {
    const auto* flag = std::get_if<bool>(&value.data);
    if (flag == nullptr) refuse(value, "true or false is wanted", origin);
    field = *flag;
  };
  key.get = [&field] { return Value{field}; };
  return add(std::move(key));
}

Section& Section::text(std::string name, std::string& field, std::string help) {
  Key key = described(std::move(name), KeyType::text, std::move(help));
  key.set = [&field](const Value& value, const Origin& origin) {
    field = text_of(value, "a text in quotes is wanted", origin);
  };
  key.get = [&field] { return Value{field}; };
  return add(std::move(key));
}

Section& Section::path(std::string name, std::filesystem::path& field, std::string help) {
  Key key = described(std::move(name), KeyType::path, std::move(help));
  key.set = [&field](const Value& value, const Origin& origin) { field = path_of(value, origin); };
  key.get = [&field] { return Value{field.string()}; };
  return add(std::move(key));
}

Section& Section::file(std::string name, std::filesystem::path& field, std::string& checksum, std::string help) {
  Key path = described(name, KeyType::path, std::move(help));
  path.set = [&field, &checksum](const Value& value, const Origin& origin) {
    field = path_of(value, origin);
    checksum = checksum_if_readable(field);
  };
  path.get = [&field] { return Value{field.string()}; };
  add(std::move(path));
  Key content =
      described(name + checksum_suffix, KeyType::text,
                fmt::format("What `{}` holds, written beside results: a file that was changed since is refused, "
                            "and one that was only moved is taken.",
                            name));
  content.set = [&checksum](const Value& value, const Origin& origin) {
    if (const std::string& given = text_of(value, "a text in quotes is wanted", origin); !given.empty())
      checksum = given;
  };
  content.only_where_set = true;
  content.get = [&checksum] { return Value{checksum}; };
  return add(std::move(content));
}

Section& Section::source(std::string name, std::function<void(const std::filesystem::path&, const Origin&)> read,
                         std::string help) {
  Key key = described(std::move(name), KeyType::path, std::move(help));
  key.set = [read = std::move(read)](const Value& value, const Origin& origin) {
    const std::filesystem::path path = path_of(value, origin);
    if (!path.empty()) read(path, origin);
  };
  key.get = [] { return Value{std::string()}; };
  return add(std::move(key));
}

Section& Section::real_list(std::string name, std::vector<double>& field, Dimension dimension, Range range,
                            std::string help, OneNumber one) {
  Key key = described(std::move(name), KeyType::real_list, std::move(help), dimension, range);
  key.set = [&field, dimension, range, one](const Value& value, const Origin& origin) {
    const auto* list = std::get_if<ValueList>(&value.data);
    if (list == nullptr && one == OneNumber::taken && !std::holds_alternative<bool>(value.data)) {
      const double number = parse_quantity(value, dimension, origin);
      check_range(number, range, dimension, origin);
      field = {number};
      return;
    }
    if (list == nullptr)
      refuse(value,
             one == OneNumber::taken ? "a number or a list of numbers in square brackets is wanted"
                                     : "a list of numbers in square brackets is wanted",
             origin);
    std::vector<double> numbers;
    for (const Value& element : *list) {
      const Origin here = at_line_of(origin, element);
      const double number = parse_quantity(element, dimension, here);
      check_range(number, range, dimension, here, fmt::format("value {}: ", numbers.size() + 1));
      numbers.push_back(number);
    }
    field = std::move(numbers);
  };
  key.get = [&field] { return list_value(field.begin(), field.end()); };
  return add(std::move(key));
}

Section& Section::numbers(std::string name, std::vector<double>& field, NumbersForm form, std::string help) {
  assert(!form.dimensions.empty());
  Key key = described(std::move(name), KeyType::real_list, std::move(help), form.dimensions.back());
  key.choices = form.words;
  const bool mixed = form.dimensions.size() > 1;  // the place of a number says what it is
  std::string wanted = form.most == 1 ? "a number is wanted" : "a number or a list of numbers is wanted";
  if (mixed) {
    std::string names, examples;
    for (const Dimension dimension : form.dimensions) {
      const char* before = names.empty() ? "" : ", ";
      names += fmt::format("{}{}", before, dimension_name(dimension));
      examples += fmt::format("{}\"{}\"", before, example_of(dimension));
    }
    wanted = fmt::format("[{}] is wanted, such as [{}]", names, examples);
  }
  for (const std::string& word : form.words) wanted += fmt::format(", or \"{}\"", word);
  key.set = [&field, form, wanted, mixed](const Value& value, const Origin& origin) {
    const auto* text = std::get_if<std::string>(&value.data);
    if (text && std::find(form.words.begin(), form.words.end(), *text) != form.words.end()) {
      *form.word = *text;
      return field.clear();
    }
    const auto* list = std::get_if<ValueList>(&value.data);
    std::vector<double> numbers;
    const auto take = [&](const Value& element) {
      const Dimension dimension = form.dimensions[std::min(numbers.size(), form.dimensions.size() - 1)];
      try {
        numbers.push_back(parse_quantity(element, dimension, at_line_of(origin, element)));
      } catch (const InputError& error) {
        if (!mixed) throw;
        throw InputError(error.origin(), fmt::format("value {}: {}", numbers.size() + 1, error.problem()), wanted);
      }
    };
    if (!list && mixed) refuse(value, wanted, origin);
    if (!list && !form.words.empty() && text && nearest_name(*text, form.words) != "") refuse(value, wanted, origin);
    if (list)
      std::for_each(list->begin(), list->end(), take);
    else
      take(value);
    if (numbers.size() < form.fewest || numbers.size() > form.most) refuse(value, wanted, origin);
    field = std::move(numbers);
    if (form.word) form.word->clear();
  };
  key.get = [&field, form] {
    if (form.word && !form.word->empty()) return Value{*form.word};
    if (field.size() == 1 && form.dimensions.size() == 1) return Value{field.front()};
    return list_value(field.begin(), field.end());
  };
  return add(std::move(key));
}

Section& Section::real_rows(std::string name, std::vector<double>& field, int columns, Dimension dimension,
                            std::string help) {
  assert(columns > 0 && field.size() % static_cast<std::size_t>(columns) == 0);
  Key key = described(std::move(name), KeyType::real_rows, std::move(help), dimension);
  key.set = [&field, columns, dimension](const Value& value, const Origin& origin) {
    const auto* rows = std::get_if<ValueList>(&value.data);
    if (rows == nullptr) refuse(value, fmt::format("a list of rows of {} numbers is wanted", columns), origin);
    std::vector<double> numbers;
    for (std::size_t k = 0; k < rows->size(); ++k) {
      const std::vector<double> row = row_of((*rows)[k], k + 1, columns, dimension, origin);
      numbers.insert(numbers.end(), row.begin(), row.end());
    }
    field = std::move(numbers);
  };
  key.get = [&field, columns] {
    ValueList rows;
    for (auto first = field.cbegin(); first != field.cend(); first += columns)
      rows.push_back(list_value(first, first + columns));
    return Value{std::move(rows)};
  };
  return add(std::move(key));
}

Section& Section::add_choice(std::string name, std::vector<std::string> names,
                             std::function<void(std::size_t)> set_index, std::function<std::size_t()> get_index,
                             std::string help) {
  assert(!names.empty());
  Key key = described(std::move(name), KeyType::choice, std::move(help));
  key.choices = names;
  key.set = [names, set_index = std::move(set_index)](const Value& value, const Origin& origin) {
    const std::string allowed = "allowed: " + joined(names);
    const auto* text = std::get_if<std::string>(&value.data);
    if (text == nullptr) refuse(value, allowed, origin);
    const auto found = std::find(names.begin(), names.end(), *text);
    if (found != names.end()) return set_index(static_cast<std::size_t>(found - names.begin()));
    const std::string nearest = nearest_name(*text, names);
    throw InputError(origin, in_quotes(*text) + " is not one of its values", allowed,
                     nearest.empty() ? "choose one of these" : fmt::format("did you mean \"{}\"?", nearest));
  };
  key.get = [names, get_index = std::move(get_index)] { return Value{names[get_index()]}; };
  return add(std::move(key));
}

}  // namespace perfora::io
