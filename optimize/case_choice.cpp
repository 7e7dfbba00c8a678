// What is here: see case_choice.h.
#include "optimize/case_choice.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>

#include "io/error.h"

namespace perfora::optimize {

bool is_chosen(const std::string& label, const std::vector<std::string>& texts) {
  return texts.empty() || std::any_of(texts.begin(), texts.end(),
                                      [&](const auto& text) { return label.find(text) != std::string::npos; });
}

void choose_cases(Sweep& sweep, const std::vector<std::string>& texts) {
  if (texts.empty()) return;
  constexpr std::size_t most_named = 12;
  std::vector<std::string> labels;
  for (const SweepCase& one : sweep.cases)
    if (one.number != 0 && labels.size() < most_named) labels.push_back(one.label);
  const auto asked = fmt::format("\"{}\"", fmt::join(texts, "\" or \""));
  std::erase_if(sweep.cases, [&](const SweepCase& one) { return one.number != 0 && !is_chosen(one.label, texts); });
  const io::Origin origin{sweep.file.string(), 0, "--only"};
  const SweepCase* other = nullptr;
  for (const SweepCase& one : sweep.cases) {
    if (one.number == 0) continue;
    if (one.problem.empty()) return;
    other = &one;
  }
  if (other)
    throw io::InputError(origin,
                         fmt::format("no case with {} in its name can be run; the last: {}", asked, other->problem), "",
                         "choose others, or mend the file");
  throw io::InputError(
      origin, fmt::format("no case has {} in its name", asked),
      fmt::format("the names are \"{}\"{}", fmt::join(labels, "\", \""), labels.size() == most_named ? ", ..." : ""),
      "give a part of a name as perfora check lists them");
}

}  // namespace perfora::optimize
