// What is here: cases of a sweep chosen by a piece of their label. What is not: the cases.
#include "optimize/campaign/case_choice.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>

#include "io/error.h"

namespace perfora::optimize {

bool is_chosen(const std::string& label, const std::vector<std::string>& texts) {
  return texts.empty() || std::any_of(texts.begin(), texts.end(),
                                      [&](const auto& text) { return label.find(text) != std::string::npos; });
}

void refuse_choice(const std::filesystem::path& file, const std::vector<std::string>& texts,
                   const std::vector<std::string>& labels) {
  constexpr std::size_t most_named = 12;
  const std::size_t named = std::min(labels.size(), most_named);
  throw io::InputError(
      {file.string(), 0, "--only"}, fmt::format("no case has \"{}\" in its name", fmt::join(texts, "\" or \"")),
      fmt::format("the names are \"{}\"{}",
                  fmt::join(labels.begin(), labels.begin() + static_cast<std::ptrdiff_t>(named), "\", \""),
                  named < labels.size() ? ", ..." : ""),
      "give a part of a name as perfora check lists them");
}

}  // namespace perfora::optimize
