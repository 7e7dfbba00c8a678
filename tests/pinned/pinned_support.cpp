// What is here: running the program in a copy of the fixtures, and comparing. What is not: the program's own code,
// which may change: fixtures are compared through its command line and with a JSON parser. Of the library only the
// table of measures is asked, for what is new in it.
#include "tests/pinned/pinned_support.h"

#include <gnu/libc-version.h>
#include <stdlib.h>
#include <sys/wait.h>

#include <algorithm>
#include <cctype>
#include <cstdio>
#include <cstdlib>
#include <fstream>
#include <set>
#include <sstream>
#include <stdexcept>

#include "results/measure_table.h"

namespace perfora::test {
namespace {

namespace fs = std::filesystem;
using nlohmann::json;

const fs::path source = fs::path(PERFORA_SOURCE_DIR) / "tests" / "pinned";

std::string trimmed(const std::string& text) {
  const auto first = text.find_first_not_of(' '), last = text.find_last_not_of(' ');
  return first == std::string::npos ? "" : text.substr(first, last - first + 1);
}

std::vector<std::string> lines_of(const std::string& text) {
  std::vector<std::string> lines;
  std::istringstream stream(text);
  for (std::string line; std::getline(stream, line);) lines.push_back(line);
  return lines;
}

bool depends_on_the_clock(const std::string& key) {
  static const std::set<std::string> keys{"performance", "seconds", "memory", "threads"};
  return keys.contains(key);
}

/// Whether a key or a column belongs to a measure: its name, or that with what a table adds to it.
bool is_of_measure(const std::string& name) {
  return std::any_of(results::measures().begin(), results::measures().end(), [&](const results::Measure& measure) {
    const std::string key = measure.key;
    for (const char* end : {"", "_std", "_ci95", "_change", "_change_ci95"})
      if (name == key + end) return true;
    return false;
  });
}

/// The fields of a line of a table; quotes stay.
std::vector<std::string> fields_of(const std::string& line) {
  std::vector<std::string> fields(1);
  bool quoted = false;
  for (const char c : line) {
    if (c == '"') quoted = !quoted;
    if (c == ',' && !quoted)
      fields.emplace_back();
    else
      fields.back() += c;
  }
  return fields;
}

/// The lines of machine.txt as this machine and build have them.
std::vector<std::string> facts_here() {
  std::string avx2 = "no", fma = "no", vendor = "unknown";
#if defined(__x86_64__)
  if (__builtin_cpu_is("amd")) vendor = "AuthenticAMD";
  if (__builtin_cpu_is("intel")) vendor = "GenuineIntel";
  if (__builtin_cpu_supports("avx2")) avx2 = "yes";
  if (__builtin_cpu_supports("fma")) fma = "yes";
#endif
  return {"compiler " PERFORA_COMPILER_OF_THIS_BUILD, std::string("glibc ") + gnu_get_libc_version(), "avx2 " + avx2,
          "fma " + fma, "vendor " + vendor};
}

}  // namespace

std::string read_text(const fs::path& path) {
  std::ifstream file(path, std::ios::binary);
  if (!file) throw std::runtime_error("cannot read " + path.string());
  std::ostringstream text;
  text << file.rdbuf();
  return text.str();
}

fs::path pinned(const std::string& name) {
  return source / "data" / name;
}

std::string reworded(std::string text) {
  // Names of keys in texts of keys, and words of messages, since the fixtures were made.
  static const std::pair<std::string, std::string> changes[] = {
      {"critical_normal_stretch = ", "critical_normal_displacement = "},
      {"[test]", "[material_test]"},
      {"lastic answer", "lastic response"},
      {"the score holds the luck of one packing", "the score holds the scatter from packing to packing"}};
  for (const auto& [then, now] : changes)
    for (std::size_t at = 0; (at = text.find(then, at)) != std::string::npos; at += now.size())
      text.replace(at, then.size(), now);
  return text;
}

json pinned_json(const std::string& name) {
  return json::parse(reworded(read_text(pinned(name))));
}

WorkFolder::WorkFolder(const std::string& data) {
  std::string pattern = fs::temp_directory_path() / "perfora-pinned.XXXXXX";
  if (::mkdtemp(pattern.data()) == nullptr) throw std::runtime_error("no temporary folder " + pattern);
  folder_ = pattern;
  for (const std::string& part : {std::string("designs"), data})
    fs::copy(source / part, folder_, fs::copy_options::recursive | fs::copy_options::overwrite_existing);
}

WorkFolder::~WorkFolder() {
  std::error_code ignored;
  fs::remove_all(folder_, ignored);
}

Outcome WorkFolder::run(const std::string& arguments) const {
  const std::string line = "cd '" + folder_.string() + "' && OMP_NUM_THREADS=1 '" PERFORA_PROGRAM "' " + arguments +
                           " > now.out 2> now.err < /dev/null";
  const int status = std::system(line.c_str());
  return {WIFEXITED(status) ? WEXITSTATUS(status) : -1, read_text(folder_ / "now.out"), read_text(folder_ / "now.err")};
}

std::vector<PinnedCommand> pinned_commands(const std::string& file) {
  std::vector<PinnedCommand> commands;
  for (const std::string& line : lines_of(read_text(source / file))) {
    if (line.empty() || line.front() == '#') continue;
    const auto first = line.find('|'), second = line.find('|', first + 1);
    commands.push_back({trimmed(line.substr(0, first)), trimmed(line.substr(first + 1, second - first - 1)),
                        trimmed(line.substr(second + 1))});
  }
  return commands;
}

void PrintTo(const PinnedCommand& command, std::ostream* out) {
  *out << "perfora " << command.arguments;
}

std::string name_of(const ::testing::TestParamInfo<PinnedCommand>& command) {
  std::string name = command.param.name;
  std::replace(name.begin(), name.end(), '-', '_');
  return name;
}

std::string not_here(const std::string& instruction_set) {
  bool there = instruction_set == "portable";
#if defined(__x86_64__)
  const bool avx2 = __builtin_cpu_supports("avx2") && __builtin_cpu_supports("fma");
  there =
      there || (avx2 && instruction_set == "avx2") ||
      (avx2 && instruction_set == "avx512" && __builtin_cpu_supports("avx512f") && __builtin_cpu_supports("avx512dq") &&
       __builtin_cpu_supports("avx512bw") && __builtin_cpu_supports("avx512vl"));
#endif
  return there ? "" : "this machine has no " + instruction_set;
}

std::string other_bits(const std::string& instruction_set) {
  if (const std::string why = not_here(instruction_set); !why.empty()) return why;
  const std::vector<std::string> there = lines_of(read_text(pinned("machine.txt"))), here = facts_here();
  // AVX-512's first guess of an inverse root has other last bits on processors of another maker.
  const std::size_t facts = instruction_set == "avx512" ? here.size() : here.size() - 1;
  for (std::size_t k = 0; k < facts; ++k)
    if (here[k] != there.at(k))
      return "the fixtures were made with \"" + there[k] + "\", this is \"" + here[k] + "\": bits may differ";
  return "";
}

std::string differences(const json& expected, const json& actual, const std::string& place) {
  // What records say beside measures since the fixtures were made.
  static const std::set<std::string> learned{"warnings", "largest_overlap", "blocks"};
  std::string found;
  if (expected.is_object() && actual.is_object()) {
    std::set<std::string> keys;
    for (const json* object : {&expected, &actual})
      for (const auto& entry : object->items()) keys.insert(entry.key());
    for (const std::string& key : keys) {
      const std::string here = place + "/" + key;
      if (!actual.contains(key))
        found += here + ": missing\n";
      else if (!expected.contains(key) && (is_of_measure(key) || learned.contains(key)))
        continue;
      else if (!expected.contains(key))
        found += here + ": one key too many\n";
      else if (!depends_on_the_clock(key))
        found += differences(expected[key], actual[key], here);
    }
  } else if (expected.is_array() && actual.is_array() && expected.size() == actual.size()) {
    for (std::size_t k = 0; k < expected.size(); ++k)
      found += differences(expected[k], actual[k], place + "/" + std::to_string(k));
  } else if (expected.dump() != actual.dump()) {  // the shortest text that gives the same bits: equal texts, equal bits
    found = place + ": " + actual.dump() + " instead of " + expected.dump() + "\n";
  }
  return found;
}

std::string same_digits(const std::string& text) {
  std::string out;
  const auto belongs_to_a_word = [](char c) {
    return std::isalnum(static_cast<unsigned char>(c)) || c == '_' || c == '.';
  };
  for (std::size_t k = 0; k < text.size();) {
    const bool digit = std::isdigit(static_cast<unsigned char>(text[k])) ||
                       (text[k] == '-' && k + 1 < text.size() && std::isdigit(static_cast<unsigned char>(text[k + 1])));
    char* end = nullptr;
    const double number = digit && (k == 0 || !belongs_to_a_word(text[k - 1])) ? std::strtod(&text[k], &end) : 0.0;
    if (end == nullptr || belongs_to_a_word(*end)) {
      out += text[k++];
      continue;
    }
    char printed[32];
    std::snprintf(printed, sizeof printed, "%.17g", number);
    out += printed;
    k = static_cast<std::size_t>(end - text.data());
  }
  return out;
}

std::string comparable_table(const std::string& csv, const std::string& pinned) {
  const std::vector<std::string> pinned_lines = lines_of(pinned);
  const std::vector<std::string> known = pinned_lines.empty() ? std::vector<std::string>() : fields_of(pinned_lines[0]);
  std::vector<bool> kept;
  std::string text;
  for (const std::string& line : lines_of(csv)) {
    const std::vector<std::string> fields = fields_of(line);
    if (kept.empty())
      for (const std::string& name : fields) {
        const bool old = std::find(known.begin(), known.end(), name) != known.end();
        kept.push_back(name != "seconds" && (old || !is_of_measure(name)));
      }
    for (std::size_t k = 0; k < fields.size(); ++k)
      if (k >= kept.size() || kept[k]) text += fields[k] + ",";
    text += "\n";
  }
  return same_digits(text);
}

std::string comparable_text(const std::string& text, const std::string& pinned) {
  std::string kept;
  bool in_performance = false;
  for (const std::string& line : lines_of(reworded(text))) {
    in_performance = line == "Performance" || (in_performance && line.starts_with("  "));
    const bool estimate = line.starts_with("  time") && line.find("roughly") != std::string::npos;
    const bool memory = line.starts_with("  memory ");
    const bool learned =
        std::any_of(results::measures().begin(), results::measures().end(), [&](const results::Measure& measure) {
          for (const std::string name : {measure.label, measure.key})
            if (line.starts_with("  " + name + " ") && pinned.find("\n  " + name + " ") == std::string::npos)
              return true;
          return false;
        });
    if (!in_performance && !estimate && !memory && !learned) kept += line + "\n";
  }
  return kept;
}

std::vector<std::string> journal_lines(const fs::path& folder) {
  return lines_of(read_text(folder / "journal.jsonl"));
}

std::vector<std::string> finished_in(const fs::path& folder) {
  std::vector<std::string> names;
  bool ensemble = false;
  for (const std::string& line : journal_lines(folder)) {
    const json event = json::parse(reworded(line.substr(line.find('{'))));
    const std::string what = event.at("event");
    ensemble = ensemble || what == "ensemble";
    if (ensemble && what == "evaluation") names.push_back(event.at("evaluation").at("replicate").dump());
    if (ensemble && what == "evaluation") continue;
    // By what was asked, not by its key: keys may be made of less than they were.
    const bool asked = what == "evaluation" && event.contains("request");
    if (what == "point" || (what == "evaluation" && !asked)) names.push_back(event.at("key").dump());
    if (asked)
      names.push_back(same_digits(event.at("request").at("design").dump()) +
                      event.at("request").at("replicate").dump());
    if (what == "replicate") names.push_back(event.at("evaluation").at("replicate").dump());
  }
  return names;
}

}  // namespace perfora::test
