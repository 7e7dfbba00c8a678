// What is here: Dakota's files read and written around one evaluation. What is not: flags of `perfora evaluate`.
#include "app/dakota.h"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <optional>
#include <sstream>

#include "io/error.h"
#include "io/files.h"
#include "io/lock.h"
#include "io/text.h"
#include "optimize/evaluate/evaluation.h"
#include "results/measure_table.h"

namespace perfora::app {

namespace {

namespace fs = std::filesystem;

constexpr const char* failure = "FAIL\n";

/// A line as its value and its name: "7e-3 layout.diameter", "{ layout.diameter = 7e-3 }".
struct Entry {
  std::string name, value;
};

std::optional<Entry> entry_of(const std::string& line) {
  std::istringstream words(line);
  std::string first, second, third, fourth;
  words >> first >> second >> third >> fourth;
  if (first == "{") {
    const bool whole = third == "=" && line.find('}') != std::string::npos && !fourth.empty() && fourth != "}";
    if (!whole) return std::nullopt;
    if (fourth.size() > 1 && (fourth.front() == '"' || fourth.front() == '\'') && fourth.back() == fourth.front())
      fourth = fourth.substr(1, fourth.size() - 2);
    return Entry{second, fourth};
  }
  if (second.empty() || !third.empty()) return std::nullopt;
  return Entry{second, first};
}

/// The lines of a parameters file one after another.
class Lines {
 public:
  explicit Lines(const fs::path& file) : file_(file), text_(io::read_file(file)) {}

  Entry next() {
    for (std::string line; std::getline(text_, line);) {
      ++line_;
      if (line.find_first_not_of(" \t\r") == std::string::npos) continue;
      if (auto entry = entry_of(line)) return *entry;
      refuse("found " + io::in_quotes(line));
    }
    refuse("ends too early");
  }

  /// The number of entries that follow, which stands beside one of these names.
  int count(const char* standard, const char* aprepro) {
    const Entry entry = next();
    if (entry.name != standard && entry.name != aprepro)
      refuse(fmt::format("found {} where \"{}\" is due", io::in_quotes(entry.name), standard));
    return whole(entry, 0);
  }

  int whole(const Entry& entry, int least) {
    int number = 0;
    const char* const end = entry.value.data() + entry.value.size();
    const auto [stop, error] = std::from_chars(entry.value.data(), end, number);
    constexpr int most = 100000;
    if (error != std::errc() || stop != end || number < least || number > most)
      refuse(fmt::format("{} is {}, no number of entries", entry.name, io::in_quotes(entry.value)));
    return number;
  }

  [[noreturn]] void refuse(const std::string& problem) const {
    throw io::InputError({file_.string(), line_, ""}, problem, "a parameters file of Dakota is wanted",
                         "in its standard form, or with the keyword aprepro of its interface");
  }

 private:
  fs::path file_;
  std::istringstream text_;
  int line_ = 0;
};

/// "ASV_1:plateau_stress" -> "plateau_stress"
std::string response_named(const Lines& lines, const std::string& label) {
  const std::size_t colon = label.find(':');
  if (!label.starts_with("ASV_") || colon == std::string::npos || colon + 1 == label.size())
    lines.refuse(fmt::format("{} names no response", io::in_quotes(label)));
  return label.substr(colon + 1);
}

/// Measures of the responses, in order; what Dakota cannot be given is refused before anything is evaluated.
std::vector<const results::Measure*> measures_asked(const DakotaRequest& request, const fs::path& file) {
  std::vector<const results::Measure*> found;
  for (const auto& [name, active] : request.responses) {
    const io::Origin origin{file.string(), 0, name};
    const results::Measure* measure = results::measure_called(name);
    if (!measure) {
      std::vector<std::string> names;
      for (const results::Measure& one : results::measures()) names.emplace_back(one.key);
      const std::string nearest = io::nearest_name(name, names);
      throw io::InputError(origin,
                           "there is no such measure" + (nearest.empty() ? "" : "; did you mean " + nearest + "?"),
                           "response_descriptors are measures of docs/user/formats.md");
    }
    if ((active & ~1) != 0)
      throw io::InputError(origin, "its gradient or Hessian is asked", "values alone are given",
                           "take numerical_gradients or a method without gradients");
    if ((active & 1) != 0) found.push_back(measure);
  }
  return found;
}

/// A variable that is no key is the study's mistake; a value that the key does not take is this point's.
void check_keys(const optimize::DesignFile& design, const DakotaRequest& request, const fs::path& file) {
  std::vector<std::string> names;
  for (const io::Key& key : design.schema().keys()) names.push_back(key.full_name());
  for (const auto& [name, value] : request.variables) {
    if (design.schema().find(name.substr(0, name.find('[')))) continue;
    const std::string nearest = io::nearest_name(name, names);
    throw io::InputError({file.string(), 0, name},
                         "there is no such key" + (nearest.empty() ? "" : "; did you mean " + nearest + "?"),
                         "descriptors of variables are keys of docs/user/design-files.md");
  }
}

/// The evaluation; nothing for variables that make no block.
std::optional<optimize::Evaluation> evaluated(const DakotaFiles& files, const DakotaRequest& request,
                                              const CommonFlags& flags, std::vector<std::string> overrides) {
  for (const auto& [name, value] : request.variables) overrides.push_back(name + "=" + value);
  try {
    const optimize::DesignFile design(files.design, overrides);
    log_warnings(design.validate());
    check_cost(design, flags);
    optimize::EvaluateOptions options;
    options.threads = flags.thread_count();
    options.cancellation = stop_token();
    options.command_line = command_line();
    return optimize::evaluate_design(design, options, 0);
  } catch (const io::InputError& error) {
    io::log_warning(error.what());
    return std::nullopt;
  }
}

}  // namespace

DakotaRequest read_dakota_parameters(const fs::path& file) {
  Lines lines(file);
  DakotaRequest request;
  for (int left = lines.count("variables", "DAKOTA_VARS"); left > 0; --left) {
    const Entry entry = lines.next();
    request.variables.emplace_back(entry.name, entry.value);
  }
  for (int left = lines.count("functions", "DAKOTA_FNS"); left > 0; --left) {
    const Entry entry = lines.next();
    request.responses.emplace_back(response_named(lines, entry.name), lines.whole(entry, 0));
  }
  return request;
}

int evaluate_for_dakota(const DakotaFiles& files, const CommonFlags& flags, const std::vector<std::string>& overrides) {
  const io::OutputLock lock = io::claim_new_output(files.results, flags.force);
  const DakotaRequest request = read_dakota_parameters(files.parameters);
  const auto measures = measures_asked(request, files.parameters);
  check_keys(optimize::DesignFile(files.design, overrides), request, files.parameters);
  const auto evaluation = evaluated(files, request, flags, overrides);
  // A stop says nothing of the design: no results.
  if (evaluation && evaluation->status == results::RunStatus::stopped) return exit_stopped;
  std::string text;
  for (const results::Measure* measure : measures) {
    const double value = evaluation ? results::value_of(*measure, *evaluation) : std::nan("");
    if (!std::isfinite(value)) {
      if (evaluation) io::log_warning(fmt::format("{} was not reached: {}", measure->key, evaluation->reason));
      text = failure;
      break;
    }
    text += fmt::format("{} {}\n", value, measure->key);
  }
  if (!evaluation || evaluation->status == results::RunStatus::failed) text = failure;
  io::write_file(files.results, text);
  return exit_ok;
}

}  // namespace perfora::app
