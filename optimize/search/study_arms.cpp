// What is here: variables and arms of a study. What is not: the file (study.cpp).
#include "optimize/search/study_arms.h"

#include <fmt/format.h>
#include <algorithm>
#include <cmath>
#include <numeric>
#include <optional>
#include <sstream>

#include "io/files.h"
#include "io/text.h"
#include "optimize/search/study_keys.h"

namespace perfora::optimize {
namespace {

/// Points on which the fraction of an arm's bounds that keeps the constraints is measured.
constexpr int samples = 64;
/// Points on which two arms are held against each other: those that differ have other holes at any of them.
constexpr int compared = 3;
/// A product of choices beyond this is a slip of the pen.
constexpr std::size_t most_arms = 1000;

struct Axis {
  std::string key;
  std::vector<io::Value> values;
};

std::string value_name(const io::Value& value) {
  if (const auto* text = std::get_if<std::string>(&value.data)) return *text;
  if (const auto* number = std::get_if<std::int64_t>(&value.data)) return fmt::format("{}", *number);
  if (const auto* flag = std::get_if<bool>(&value.data)) return *flag ? "true" : "false";
  return "?";
}

Axis range_axis(const Study& study, const io::Key& key, const io::Entry& entry) {
  const auto [low, high] = bounds(study, key, entry);
  if (low != std::floor(low) || high != std::floor(high))
    throw io::InputError(origin_in(study, "variables", entry), "the bounds of a whole number must be whole numbers",
                         "[2, 4]", "");
  if (low > high) refuse_empty_bounds(study, entry, low, high);
  Axis axis{key.full_name(), {}};
  for (auto value = static_cast<std::int64_t>(low); value <= static_cast<std::int64_t>(high); ++value) {
    io::Value item;
    item.data = value;
    item.line = entry.value.line;
    axis.values.push_back(item);
    if (axis.values.size() > most_arms)
      throw io::InputError(origin_in(study, "variables", entry), "far too many arms",
                           fmt::format("at most {}", most_arms), "narrow the range");
  }
  return axis;
}

Axis list_axis(const Study& study, const NamedKey& named, const io::Entry& entry) {
  const io::Key& key = named.key;
  Axis axis{key.full_name(), {}};
  DesignFile scratch(study.start->design());
  for (const io::Value& value :
       list_of(study, "arms", entry, "a list of values, such as [2, 3] or [\"square\", \"staggered\"]")) {
    if (key.type == io::KeyType::real || key.list())
      throw io::InputError(origin_in(study, "arms", entry), "arms are whole numbers or names", "",
                           fmt::format("move {} to [variables] with bounds", named.name));
    scratch.schema().set(key.full_name(), value, origin_in(study, "arms", entry));
    io::Value taken = value;
    if (key.type == io::KeyType::integer)
      taken.data = scratch.schema().at(key.full_name()).get().data;  // 2.0 is 2 where the key holds whole numbers
    const bool known = std::any_of(axis.values.begin(), axis.values.end(),
                                   [&](const io::Value& other) { return value_name(other) == value_name(taken); });
    if (!known) axis.values.push_back(std::move(taken));
  }
  return axis;
}

std::vector<Axis> collect_axes(const Study& study, const ArmEntries& entries) {
  std::vector<Axis> axes;
  auto add = [&](Axis axis, const io::Origin& origin) {
    for (const Axis& other : axes)
      if (other.key == axis.key)
        throw io::InputError(origin, "this key is enumerated twice", "", "name it in [variables] or in [arms]");
    for (const Variable& variable : study.variables)
      if (variable.key == axis.key)
        throw io::InputError(origin, "this key is a variable already", "", "name it in one table");
    axes.push_back(std::move(axis));
  };
  for (const io::Entry& entry : entries.arms)
    add(list_axis(study, design_key(study, "arms", entry), entry), origin_in(study, "arms", entry));
  for (const io::Entry& entry : entries.variables) {
    const io::Key& key = design_key(study, "variables", entry).key;
    if (key.type == io::KeyType::integer) add(range_axis(study, key, entry), origin_in(study, "variables", entry));
  }
  return axes;
}

std::string arm_name(const Arm& arm, int start, int starts) {
  std::string name;
  for (const DesignChange& choice : arm.choices)
    name += fmt::format("{}{}={}", name.empty() ? "" : " ", io::after_section(choice.key), value_name(choice.value));
  if (starts > 1) name += fmt::format("{}start={}", name.empty() ? "" : " ", start + 1);
  return name.empty() ? "all" : name;
}

/// The product of all axes, the last one running fastest.
std::vector<Arm> product(const std::vector<Axis>& axes) {
  std::vector<Arm> arms(1);
  for (const Axis& axis : axes) {
    std::vector<Arm> longer;
    for (const Arm& arm : arms)
      for (const io::Value& value : axis.values) {
        longer.push_back(arm);
        longer.back().choices.push_back({axis.key, value});
      }
    arms = std::move(longer);
    if (arms.size() > most_arms) break;
  }
  return arms;
}

std::vector<double> first_point(const Study& study, int start) {
  if (start > 0) return halton_point(start, static_cast<int>(study.variables.size()));
  std::vector<double> values;
  for (const Variable& variable : study.variables) values.push_back(study.start->schema().get_number(variable.key));
  return study.point_of(values);
}

/// Share of an arm's bounds that keeps the constraints; negative when the layout cannot be laid at any sampled point.
double feasible_fraction(const Study& study, const Arm& arm) {
  int laid = 0, kept = 0;
  for (int k = 0; k < samples; ++k) {
    const auto values = study.values_at(halton_point(k, static_cast<int>(study.variables.size())));
    const DesignFile design = study.design_at(&arm, values);
    const LayoutMeasure measure = measure_layout(design);
    if (!measure.placed) continue;
    ++laid;
    if (violation(constraint_values(study.constraints, design, measure)) == 0.0) ++kept;
  }
  return laid == 0 ? -1.0 : static_cast<double>(kept) / samples;
}

/// All keys of a design but those of its layout.
std::string beside_layout(const DesignFile& design) {
  std::string text;
  for (const io::Key& key : design.schema().keys())
    if (key.section != "layout") text += io::value_text(key.get()) + "\n";
  return text;
}

/// An arm's holes at the first points of its bounds, and what else a result depends on.
struct ArmHoles {
  bool complete = true;  ///< false: somewhere they cannot be placed
  std::vector<std::vector<geometry::Perforation>> holes;
  std::vector<std::string> others;  ///< keys beside the layout
  bool same(const ArmHoles& other) const {
    return complete && other.complete && holes == other.holes && others == other.others;
  }
};

/// `fixed`: this variable at one end of its bounds (0: low, 1: high) at all points.
ArmHoles holes_of(const Study& study, const Arm& arm, std::optional<std::size_t> fixed = {}, double end = 0.0) {
  ArmHoles found;
  const int dimension = static_cast<int>(study.variables.size());
  try {
    for (int k = 0; k < compared; ++k) {
      std::vector<double> point = halton_point(k, dimension);
      if (fixed) point[*fixed] = end;
      const DesignFile made = study.design_at(&arm, study.values_at(point));
      const Design& design = made.design();
      found.others.push_back(beside_layout(made));
      found.holes.push_back(geometry::place_perforations(design.layout, design.seeds.effective(0).layout).perforations);
    }
  } catch (const io::InputError&) {
    found.complete = false;  // drop_impossible says why
  }
  return found;
}

/// "a, b, c and 7 more".
std::string first_few(const std::vector<std::string>& names) {
  constexpr std::size_t most = 3;
  std::string text =
      io::joined({names.begin(), names.begin() + static_cast<std::ptrdiff_t>(std::min(names.size(), most))});
  if (names.size() > most) text += fmt::format(" and {} more", names.size() - most);
  return text;
}

/// Arms whose choices say nothing to their family (the turn of a square one) are one and the same search.
void drop_repeated(Study& study) {
  std::vector<Arm> different;
  std::vector<ArmHoles> known;
  std::vector<std::string> repeated;
  for (const Arm& arm : study.arms) {
    ArmHoles holes = holes_of(study, arm);
    std::size_t k = 0;
    while (k < known.size() && !(different[k].start == arm.start && known[k].same(holes))) ++k;
    if (k < known.size()) {
      repeated.push_back(fmt::format("{} (as {})", arm.name, different[k].name));
      continue;
    }
    different.push_back(arm);
    known.push_back(std::move(holes));
  }
  if (!repeated.empty())
    study.warnings.push_back(fmt::format(
        "{} left out, as another arm has the same holes: {}",
        repeated.size() == 1 ? "1 arm is" : fmt::format("{} arms are", repeated.size()), first_few(repeated)));
  study.arms = std::move(different);
}

/// A variable that leaves the holes of an arm as they are (the stagger of a square one) makes its candidates one
/// design.
void warn_about_idle_variables(Study& study) {
  for (std::size_t k = 0; k < study.variables.size(); ++k) {
    std::vector<std::string> arms;
    for (const Arm& arm : study.arms)
      if (holes_of(study, arm, k, 0.0).same(holes_of(study, arm, k, 1.0))) arms.push_back(arm.name);
    if (arms.empty()) continue;
    const bool one = arms.size() == 1;
    study.warnings.push_back(fmt::format(
        "variables.{} has no effect on {} {}: {} holes are the same for every value; take it out, or choose a "
        "layout that has it",
        study.variables[k].key, one ? "arm" : "arms", first_few(arms), one ? "its" : "their"));
  }
}

void drop_impossible(Study& study) {
  std::vector<Arm> possible;
  std::string problem;  // of the first arm that is left out
  for (const Arm& arm : study.arms) {
    const double fraction = feasible_fraction(study, arm);
    if (fraction < 0.0) {
      const auto middle = study.values_at(std::vector<double>(study.variables.size(), 0.5));
      const std::string reason = measure_layout(study.design_at(&arm, middle)).problem;
      if (problem.empty()) problem = reason;
      study.warnings.push_back(fmt::format("arm {} is left out: {}", arm.name, reason));
      continue;
    }
    if (fraction == 0.0)
      study.warnings.push_back(
          fmt::format("arm {}: none of {} points spread over its bounds keeps [constraints] (thinnest_wall, porosity): "
                      "widen [variables], or ask for less",
                      arm.name, samples));
    possible.push_back(arm);
    possible.back().fraction = fraction;
  }
  if (possible.empty())
    throw io::InputError({study.file.string(), 0, "variables"}, "no layout of the search can be laid: " + problem, "",
                         "change the bounds, or the layout of the design");
  study.arms = std::move(possible);
}

std::vector<int> listed(const Study& study, const io::Origin& origin) {
  std::vector<int> counts;
  std::istringstream text(study.keys.allocation);
  for (std::string item; std::getline(text, item, ',');) {
    char* end = nullptr;
    const long count = std::strtol(item.c_str(), &end, 10);
    while (end && *end == ' ') ++end;
    if (end == item.c_str() || *end != '\0' || count < 0)
      throw io::InputError(origin, fmt::format("\"{}\" is no allocation", study.keys.allocation),
                           "\"equal\", \"proportional\" or a list of whole numbers, one an arm", "");
    counts.push_back(static_cast<int>(std::min(count, 1000000000L)));
  }
  const auto sum = std::accumulate(counts.begin(), counts.end(), std::int64_t{0});
  if (counts.size() != study.arms.size())
    throw io::InputError(origin, fmt::format("{} numbers are given for {} arms", counts.size(), study.arms.size()),
                         "one number an arm", "see `perfora check` for the arms and their order");
  if (sum != study.keys.maxeval)
    throw io::InputError(origin, fmt::format("the list adds up to {}, maxeval is {}", sum, study.keys.maxeval), "",
                         "make them agree");
  return counts;
}

}  // namespace

void make_variables(Study& study, const ArmEntries& entries) {
  for (const io::Entry& entry : entries.variables) {
    const auto& [name, key] = design_key(study, "variables", entry);
    if (key.type == io::KeyType::integer) continue;
    const auto [low, high] = bounds(study, key, entry);
    if (!(low < high)) refuse_empty_bounds(study, entry, low, high);
    refuse_metres(study, key, entry, low, high);
    study.variables.push_back({name, low, high, key.dimension});
  }
  if (study.variables.empty())
    throw io::InputError({study.file.string(), 0, "variables"}, "no continuous variable is given", "",
                         "add \"layout.diameter\" = [\"16 mm\", \"20 mm\"] under [variables]");
}

void make_arms(Study& study, const ArmEntries& entries) {
  const auto axes = collect_axes(study, entries);
  study.arms.clear();
  for (const Arm& combination : product(axes))
    for (int start = 0; start < study.keys.starts; ++start) {
      Arm arm = combination;
      arm.name = arm_name(arm, start, study.keys.starts);
      arm.start = first_point(study, start);
      arm.seed = io::crc32(fmt::format("{} {}", study.start->design().seeds.effective(0).search, arm.name));
      study.arms.push_back(std::move(arm));
    }
  if (study.arms.size() > most_arms)
    throw io::InputError({study.file.string(), 0, "arms"}, fmt::format("the choices make more than {} arms", most_arms),
                         "", "narrow them");
  drop_repeated(study);
  drop_impossible(study);
  warn_about_idle_variables(study);
}

void allocate(Study& study, const io::Origin& origin) {
  std::vector<int> counts;
  std::vector<double> fractions;
  for (const Arm& arm : study.arms) fractions.push_back(arm.fraction);
  if (study.keys.allocation == "equal")
    counts = share_out(study.keys.maxeval, std::vector<double>(study.arms.size(), 1.0));
  else if (study.keys.allocation == "proportional")
    counts = share_out(study.keys.maxeval, fractions);
  else
    counts = listed(study, origin);
  if (study.keys.allocation == "equal" && study.keys.maxeval < static_cast<int>(study.arms.size()))
    throw io::InputError(origin, fmt::format("maxeval is {} for {} arms", study.keys.maxeval, study.arms.size()),
                         "at least one candidate an arm", "raise maxeval or take fewer arms");
  for (std::size_t k = 0; k < counts.size(); ++k) study.arms[k].maxeval = counts[k];
  std::erase_if(study.arms, [](const Arm& arm) { return arm.maxeval == 0; });
}

std::vector<double> halton_point(int index, int dimension) {
  std::vector<double> point;
  for (int base = 2; static_cast<int>(point.size()) < dimension; ++base) {
    bool prime = true;
    for (int divisor = 2; divisor * divisor <= base; ++divisor) prime = prime && base % divisor != 0;
    if (!prime) continue;
    double value = 0.0, digit = 1.0;
    for (int rest = index + 1; rest > 0; rest /= base) {
      digit /= base;
      value += digit * (rest % base);
    }
    point.push_back(value);
  }
  return point;
}

std::vector<int> share_out(int total, const std::vector<double>& weights) {
  const double sum = std::accumulate(weights.begin(), weights.end(), 0.0);
  const std::size_t n = weights.size();
  std::vector<int> counts(n);
  std::vector<double> remainders(n);
  int given = 0;
  for (std::size_t k = 0; k < n; ++k) {
    const double exact = total * (sum > 0.0 ? weights[k] / sum : 1.0 / static_cast<double>(n));
    counts[k] = static_cast<int>(std::floor(exact));
    remainders[k] = exact - counts[k];
    given += counts[k];
  }
  std::vector<std::size_t> order(n);
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::stable_sort(order.begin(), order.end(),
                   [&](std::size_t a, std::size_t b) { return remainders[a] > remainders[b]; });
  for (std::size_t k = 0; given < total; k = (k + 1) % n, ++given) ++counts[order[k]];
  return counts;
}

}  // namespace perfora::optimize
