// What is here: each type of value as JSON. What is not: who records it.
#include "optimize/campaign/value_json.h"

#include "io/text.h"
#include "results/json.h"

namespace perfora::optimize {

nlohmann::json value_json(const io::Value& value) {
  if (const auto* text = std::get_if<std::string>(&value.data)) return *text;
  if (const auto* whole = std::get_if<std::int64_t>(&value.data)) return *whole;
  if (const auto* real = std::get_if<double>(&value.data)) return results::number(*real);
  if (const auto* flag = std::get_if<bool>(&value.data)) return *flag;
  return io::value_text(value);
}

nlohmann::json window_json(const results::MeasureOptions& measures) {
  if (measures.plateau == results::PlateauPlace::found) return nullptr;
  return {measures.plateau_start, measures.plateau_end};
}

}  // namespace perfora::optimize
