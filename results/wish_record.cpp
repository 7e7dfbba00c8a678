// What is here: bounds of wishes as numbers or null. What is not: the records that hold them.
#include "results/wish_record.h"

#include <limits>
#include <string>

#include "results/json.h"

namespace perfora::results {
namespace {

using nlohmann::json;

double bound(const json& object, const char* key, double open) {
  const json& value = object.at(key);
  return value.is_null() ? open : value.get<double>();
}

}  // namespace

json to_json(const Wish& wish) {
  return {{"measure", wish.measure->key}, {"low", number(wish.low)}, {"high", number(wish.high)}};
}

json to_json(std::span<const Wish> wishes) {
  json list = json::array();
  for (const Wish& wish : wishes) list.push_back(to_json(wish));
  return list;
}

std::optional<Wish> wish_from_json(const json& object) {
  constexpr double infinite = std::numeric_limits<double>::infinity();
  const Measure* measure = measure_called(object.at("measure").get<std::string>());
  if (!measure) return std::nullopt;
  return Wish{measure, bound(object, "low", -infinite), bound(object, "high", infinite)};
}

std::vector<Wish> wishes_from_json(const json& list) {
  std::vector<Wish> wishes;
  for (const json& one : list)
    if (const auto wish = wish_from_json(one)) wishes.push_back(*wish);
  return wishes;
}

}  // namespace perfora::results
