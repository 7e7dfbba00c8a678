// What is here: LAMMPS text dumps and data files read line by line. What is not: binary dumps, molecules. Format:
// LAMMPS manual, "dump", "read_data".
#include "geometry/lammps_file.h"

#include <algorithm>
#include <cmath>

#include "io/error.h"
#include "io/numbers.h"
#include "io/text.h"

namespace perfora::geometry {
namespace {

/// Lines with their numbers, and their words.
class Lines {
 public:
  Lines(std::string_view text, const std::string& name) : rest_(text), name_(name) {}

  bool next() {
    if (rest_.empty()) return false;
    const std::size_t end = rest_.find('\n');
    line_ = rest_.substr(0, end);
    rest_ = end == std::string_view::npos ? std::string_view{} : rest_.substr(end + 1);
    while (!line_.empty() && (line_.back() == '\r' || line_.back() == ' ')) line_.remove_suffix(1);
    ++number_;
    split();
    return true;
  }
  void need(const std::string& what) {
    if (!next()) refuse("the file ends where " + what + " should follow", "a file that is whole");
  }
  std::string_view text() const { return line_; }
  int number() const { return number_; }
  const std::vector<std::string_view>& words() const { return words_; }

  double real(std::size_t word) const {
    if (word >= words_.size())
      refuse("value " + std::to_string(word + 1) + " is missing", "as many values as there are columns");
    const std::optional<double> value = io::number_from(words_[word]);
    if (!value || !std::isfinite(*value)) refuse(io::in_quotes(words_[word]) + " is no finite number", "a number");
    return *value;
  }
  std::size_t count(std::size_t word, std::size_t most) const {
    const double value = real(word);
    if (!(value >= 0.0 && value <= static_cast<double>(most)) || value != std::floor(value))
      refuse(io::in_quotes(words_[word]) + " is no count of atoms", "0 to " + std::to_string(most));
    return static_cast<std::size_t>(value);
  }

  [[noreturn]] void refuse(const std::string& problem, const std::string& allowed,
                           const std::string& remedy = "write the file again") const {
    throw io::InputError({name_, number_, "packing.file"}, problem, allowed, remedy);
  }

 private:
  void split() {
    words_.clear();
    constexpr std::string_view blanks = " \t\r";
    for (std::size_t at = line_.find_first_not_of(blanks); at != std::string_view::npos;) {
      const std::size_t end = std::min(line_.find_first_of(blanks, at), line_.size());
      words_.push_back(line_.substr(at, end - at));
      at = line_.find_first_not_of(blanks, end);
    }
  }
  std::string_view rest_, line_;
  const std::string& name_;
  int number_ = 0;
  std::vector<std::string_view> words_;
};

void clear(LammpsSpheres& spheres) {
  for (auto& axis : spheres.place) axis.clear();
  spheres.radius.clear();
  spheres.lines.clear();
}

/// Where the columns of a dump stand.
struct Columns {
  std::array<std::size_t, 3> place{};
  bool scaled = false;
  std::size_t size = 0;
  double per_size = 1.0;  ///< radius over what the column holds
};

Columns columns_of(const Lines& lines) {
  const std::vector<std::string_view> names(lines.words().begin() + 2, lines.words().end());
  const auto find = [&](std::string_view name) {
    return static_cast<std::size_t>(std::find(names.begin(), names.end(), name) - names.begin());
  };
  Columns columns;
  bool found = false;
  for (const std::string_view suffix : {"", "u", "s", "su"}) {
    bool all = true;
    for (std::size_t axis = 0; axis < 3; ++axis) {
      columns.place[axis] = find(std::string(1, "xyz"[axis]) + std::string(suffix));
      all = all && columns.place[axis] < names.size();
    }
    columns.scaled = suffix.starts_with('s');
    if (all) {
      found = true;
      break;
    }
  }
  if (!found) lines.refuse("the dump has no places", "columns x, y, z (or xu, xs ...)");
  columns.size = find("radius");
  if (columns.size == names.size()) {
    columns.size = find("diameter");
    columns.per_size = 0.5;
  }
  if (columns.size == names.size())
    lines.refuse("the dump has no sizes", "a column radius or diameter",
                 "dump them: dump 1 all custom 1000 file id x y z radius");
  return columns;
}

void read_box(Lines& lines, LammpsSpheres& spheres) {
  std::size_t flag = 3;
  if (lines.words().size() > flag && lines.words()[flag] == "xy") lines.refuse("the box is tilted", "an upright box");
  if (lines.words().size() > flag && lines.words()[flag].starts_with("abc"))
    lines.refuse("the box is tilted", "an upright box");
  for (std::size_t axis = 0; axis < 3; ++axis, ++flag)
    spheres.periodic[axis] = flag >= lines.words().size() || lines.words()[flag].starts_with('p');
  for (std::size_t axis = 0; axis < 3; ++axis) {
    lines.need("the bounds of the box");
    spheres.low[axis] = lines.real(0);
    spheres.high[axis] = lines.real(1);
    if (!(spheres.high[axis] > spheres.low[axis])) lines.refuse("the box has no size", "a lower and a higher bound");
  }
}

void read_atoms_of_dump(Lines& lines, std::size_t count, LammpsSpheres& spheres) {
  const Columns columns = columns_of(lines);
  clear(spheres);
  for (std::size_t k = 0; k < count; ++k) {
    lines.need("atom " + std::to_string(k + 1) + " of " + std::to_string(count));
    for (std::size_t axis = 0; axis < 3; ++axis) {
      const double value = lines.real(columns.place[axis]);
      const double span = spheres.high[axis] - spheres.low[axis];
      spheres.place[axis].push_back(columns.scaled ? spheres.low[axis] + value * span : value);
    }
    spheres.radius.push_back(columns.per_size * lines.real(columns.size));
    spheres.lines.push_back(lines.number());
  }
}

/// Extra values behind x y z of one sub-style of a hybrid; nothing for one that is not known.
struct SubStyle {
  std::string_view name;
  std::size_t values;
};
constexpr SubStyle sub_styles[] = {{"atomic", 0}, {"bond", 1},   {"angle", 1}, {"molecular", 1},
                                   {"charge", 1}, {"sphere", 2}, {"full", 2}};

/// Where x and the diameter stand in a line of Atoms.
struct AtomStyle {
  std::size_t place = 0, diameter = 0;
};

AtomStyle style_of(const Lines& lines) {
  const std::string_view text = lines.text();
  const std::size_t mark = text.find('#');
  if (mark == std::string_view::npos)
    lines.refuse("the section does not say its style", "a line such as \"Atoms # sphere\"");
  std::vector<std::string_view> names;
  bool behind = false;
  for (const std::string_view word : lines.words()) {
    if (behind) names.push_back(word);
    if (word == "#") behind = true;
  }
  if (names.empty()) names.push_back(text.substr(mark + 1));
  if (names.front() == "sphere" || names.front() == "granular") return {4, 2};
  if (names.front() != "hybrid")
    lines.refuse("atoms of style " + io::in_quotes(names.front()) + " have no size",
                 "style sphere, or a hybrid with it");
  AtomStyle style{2, 0};
  std::size_t at = 5;
  for (std::size_t k = 1; k < names.size(); ++k) {
    const auto known = std::find_if(std::begin(sub_styles), std::end(sub_styles),
                                    [&](const SubStyle& one) { return one.name == names[k]; });
    if (known == std::end(sub_styles))
      lines.refuse("the style " + io::in_quotes(names[k]) + " of a hybrid is not known",
                   "atomic, bond, angle, molecular, charge, full, sphere");
    if (known->name == "sphere") style.diameter = at;
    at += known->values;
  }
  if (style.diameter == 0) lines.refuse("no style of this hybrid has a size", "a hybrid with sphere");
  return style;
}

}  // namespace

bool is_lammps_dump(std::string_view text) {
  return text.substr(0, 5) == "ITEM:";
}

bool is_lammps_data(std::string_view text) {
  constexpr std::size_t beginning = 4000;
  const std::string name;
  Lines lines(text.substr(0, beginning), name);
  if (!lines.next()) return false;  // the first line is a title
  while (lines.next())
    if (lines.words().size() == 2 && lines.words()[1] == "atoms") return true;
  return false;
}

LammpsSpheres read_lammps_dump(std::string_view text, const std::string& name, std::size_t most) {
  LammpsSpheres spheres;
  Lines lines(text, name);
  std::size_t count = 0;
  bool counted = false, boxed = false, read = false;
  while (lines.next()) {
    const std::string_view item = lines.text();
    if (item.empty()) continue;
    if (item.starts_with("ITEM: NUMBER OF ATOMS")) {
      lines.need("the number of atoms");
      count = lines.count(0, most);
      counted = true;
    } else if (item.starts_with("ITEM: BOX BOUNDS")) {
      read_box(lines, spheres);
      boxed = true;
    } else if (item.starts_with("ITEM: UNITS")) {
      lines.need("the units");
      spheres.units = std::string(lines.text());
    } else if (item.starts_with("ITEM: TIMESTEP") || item.starts_with("ITEM: TIME")) {
      lines.need("the time");
      static_cast<void>(lines.real(0));
    } else if (item.starts_with("ITEM: ATOMS")) {
      if (!counted || !boxed) lines.refuse("atoms stand before their number and box", "the items of a dump in order");
      read_atoms_of_dump(lines, count, spheres);
      read = true;
      counted = boxed = false;
    } else {
      lines.refuse(io::in_quotes(item) + " is no item of a dump", "ITEM: TIMESTEP, NUMBER OF ATOMS, BOX BOUNDS, ATOMS");
    }
  }
  if (!read || counted || boxed) lines.refuse("the file ends before its last frame does", "a file that is whole");
  return spheres;
}

LammpsSpheres read_lammps_data(std::string_view text, const std::string& name, std::size_t most) {
  LammpsSpheres spheres;
  Lines lines(text, name);
  lines.need("a title");
  const std::string title(lines.text());
  for (const char* mark : {"units si", "units = si"})
    if (title.find(mark) != std::string::npos) spheres.units = "si";
  std::size_t count = 0;
  std::array<bool, 3> bounds{};
  while (lines.next()) {
    const auto& words = lines.words();
    if (words.size() >= 2 && words[1] == "atoms") count = lines.count(0, most);
    for (std::size_t axis = 0; axis < 3; ++axis) {
      const char letter = "xyz"[axis];
      if (words.size() < 4 || words[2] != std::string(1, letter) + "lo") continue;
      spheres.low[axis] = lines.real(0);
      spheres.high[axis] = lines.real(1);
      bounds[axis] = true;
      if (!(spheres.high[axis] > spheres.low[axis])) lines.refuse("the box has no size", "a lower and a higher bound");
    }
    if (words.size() >= 6 && words[3] == "xy" && (lines.real(0) != 0.0 || lines.real(1) != 0.0 || lines.real(2) != 0.0))
      lines.refuse("the box is tilted", "an upright box");
    if (words.empty() || words[0] != "Atoms") continue;
    if (!bounds[0] || !bounds[1] || !bounds[2])
      lines.refuse("atoms stand before their box", "xlo xhi, ylo yhi, zlo zhi");
    const AtomStyle style = style_of(lines);
    for (std::size_t k = 0; k < count;) {
      lines.need("atom " + std::to_string(k + 1) + " of " + std::to_string(count));
      if (lines.words().empty()) continue;
      for (std::size_t axis = 0; axis < 3; ++axis) spheres.place[axis].push_back(lines.real(style.place + axis));
      spheres.radius.push_back(0.5 * lines.real(style.diameter));
      spheres.lines.push_back(lines.number());
      ++k;
    }
    return spheres;
  }
  lines.refuse("the file has no section Atoms", "a data file that is whole");
}

double metres_of_lammps_units(std::string_view units) {
  if (units == "si") return 1.0;
  if (units == "cgs") return 1e-2;
  if (units == "micro") return 1e-6;
  if (units == "nano") return 1e-9;
  if (units == "real" || units == "metal") return 1e-10;
  return 0.0;
}

}  // namespace perfora::geometry
