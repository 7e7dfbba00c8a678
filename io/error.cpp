// What is here: how an InputError reads, and the search for the nearest known name.
// What is not: any particular error.
#include "io/error.h"
#include "io/letters.h"

#include <algorithm>
#include <cctype>
#include <utility>

namespace perfora::io {
namespace {

/// One sentence on one line, whatever control characters the user's own text carries.
std::string one_line(std::string text) {
  for (char& c : text)
    if (static_cast<unsigned char>(c) < 0x20 || c == 0x7f) c = ' ';
  return text;
}

std::string message(const Origin& origin, const std::string& problem, const std::string& allowed,
                    const std::string& remedy) {
  std::string text = origin.file;
  if (!origin.file.empty() && origin.line > 0) text.append(":").append(std::to_string(origin.line));
  for (const std::string* part : {&origin.key, &problem})
    if (!part->empty()) text.append(text.empty() ? "" : ": ").append(*part);
  for (const std::string* part : {&allowed, &remedy})
    if (!part->empty()) text.append("; ").append(*part);
  return one_line(std::move(text));
}

/// Optimal string alignment: insertions, deletions, substitutions and swaps of neighbours count one each.
std::size_t edit_distance(const std::string& a, const std::string& b) {
  std::vector<std::size_t> before(b.size() + 1), last(b.size() + 1), current(b.size() + 1);
  for (std::size_t j = 0; j <= b.size(); ++j) last[j] = j;
  for (std::size_t i = 1; i <= a.size(); ++i) {
    current[0] = i;
    for (std::size_t j = 1; j <= b.size(); ++j) {
      const std::size_t substitution = last[j - 1] + (a[i - 1] == b[j - 1] ? 0 : 1);
      current[j] = std::min({last[j] + 1, current[j - 1] + 1, substitution});
      if (i > 1 && j > 1 && a[i - 1] == b[j - 2] && a[i - 2] == b[j - 1])
        current[j] = std::min(current[j], before[j - 2] + 1);
    }
    std::swap(before, last);
    std::swap(last, current);
  }
  return last[b.size()];
}

}  // namespace

InputError::InputError(Origin origin, std::string problem, std::string allowed, std::string remedy)
    : std::runtime_error(message(origin, problem, allowed, remedy)),
      origin_(std::move(origin)),
      problem_(std::move(problem)) {}

std::string nearest_name(std::string_view name, const std::vector<std::string>& candidates) {
  // Longer than any key: no typing mistake, and the distance would cost too much.
  constexpr std::size_t longest_name = 200;
  if (name.empty() || name.size() > longest_name) return {};
  const std::string wanted = lower(name);
  std::string best;
  std::size_t best_distance = longest_name;
  for (const std::string& candidate : candidates) {
    if (candidate.size() > longest_name) continue;
    const std::size_t distance = edit_distance(wanted, lower(candidate));
    if (distance >= best_distance || 3 * distance > std::max(wanted.size(), candidate.size())) continue;
    best = candidate;
    best_distance = distance;
  }
  return best;
}

}  // namespace perfora::io
