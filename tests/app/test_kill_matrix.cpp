// What is here: every command that takes over a second, killed by SIGKILL at random moments and while it writes, then
// taken up again with other numbers of threads and workers, ends with the bits of one that was never disturbed and
// leaves nothing behind; a second process on the same output is refused and harms nothing. Expected values: the
// undisturbed command. What is not: single runs over many kills (test_kill_resume.cpp).
#include <gmock/gmock.h>

#include <chrono>
#include <csignal>
#include <cstdlib>
#include <fstream>
#include <map>
#include <nlohmann/json.hpp>
#include <random>
#include <set>
#include <sstream>
#include <thread>

#include "io/hdf5.h"
#include "processes.h"

namespace perfora {
namespace {

namespace fs = std::filesystem;
using nlohmann::json;
using namespace std::chrono_literals;

constexpr const char* design = R"([cell]
width = "20 mm"
height = "20 mm"
[layout]
family = "square"
diameter = "8 mm"
rows = 1
columns = 1
[packing]
mean_diameter = "1.0 mm"
maximum_diameter = "1.9825 mm"
size_ratio = 3.0
solid_fraction = 0.719
[loading]
until = "12 %"
transits = 5
[measures]
plateau_start = 0.05
plateau_end = 0.1
[output]
checkpoint_interval = 0.1
)";
constexpr const char* solid = R"([cell]
width = "20 mm"
height = "20 mm"
[layout]
family = "none"
[packing]
mean_diameter = "1.0 mm"
maximum_diameter = "1.9825 mm"
solid_fraction = 0.719
[test]
size = 0.012
)";
constexpr const char* study = R"([study]
design = "design.toml"
maxeval = 5
replicates = 1
final_replicates = 1
until = 0.11
[target]
plateau_stress = "0.2 MPa"
window = [0.05, 0.1]
[variables]
"layout.diameter" = ["6 mm", "9 mm"]
[arms]
family = ["square", "staggered"]
)";
constexpr const char* stages = R"([study]
design = "design.toml"
algorithm = "model"
maxeval = 4
batch = 2
replicates = 1
final_replicates = 3
until = 0.11
[target]
plateau_stress = "0.2 MPa"
window = [0.05, 0.1]
[variables]
"layout.diameter" = ["6 mm", "9 mm"]
"material.grade" = [0.8, 1.2]
[map]
designs = 8
replicates = 1
[race]
finalists = 3
keep = 2
replicates = 1
)";
constexpr const char* sweep = R"([sweep]
design = "design.toml"
replicates = 2
base = true
until = 0.11
[each]
material.horizon = [2.5]
noise.kind = ["weibull"]
)";
constexpr const char* calibration = R"([calibrate]
design = "solid.toml"
young_modulus = "2 GPa"
tensile_strength = "0.5 MPa"
compressive_strength = "3 MPa"
replicates = 1
maxeval = 3
chart = false
)";

struct Command {
  std::string name;
  std::vector<std::string> arguments;  ///< but output, threads and workers
  std::string output;
  bool workers = false;
  std::string again = "--resume";
};

const std::vector<Command>& commands() {
  static const std::vector<Command> all{
      {"evaluate", {"evaluate", "design.toml"}, "R.h5"},
      {"replicates", {"evaluate", "design.toml", "--replicates", "2"}, "work"},
      {"optimize", {"optimize", "study.toml"}, "work", true},
      {"stages", {"optimize", "stages.toml"}, "work", true},  // map, model, race, verification
      {"map", {"map", "study.toml", "--designs", "3"}, "work", true},
      {"sweep", {"sweep", "sweep.toml"}, "work", true},
      {"tolerance",
       {"tolerance", "design.toml", "--set", "target.plateau_stress=2e5", "--set", "tolerance.replicates=2", "--set",
        "tolerance.hole_position=0"},
       "work",
       true},
      {"calibrate", {"calibrate", "calibration.toml"}, "work", true},
      {"test", {"test", "solid.toml"}, "R.h5", false, "--force"},
      {"pack", {"pack", "larger.toml"}, "R.h5", false, "--force"},
      {"elastic", {"evaluate", "larger.toml", "--elastic"}, "R.h5", false, "--force"}};
  return all;
}

/// What two runs of the same work never share: times, numbers of threads, moments, command lines.
json timeless(json record) {
  static const std::set<std::string> fleeting{"performance", "seconds", "retries"};
  if (record.is_object())
    for (const std::string& key : fleeting) record.erase(key);
  for (auto& value : record)
    if (value.is_structured()) value = timeless(value);
  return record;
}

std::string text_of(const fs::path& path) {
  std::ifstream file(path, std::ios::binary);
  std::ostringstream text;
  text << file.rdbuf();
  return text.str();
}

/// Without its column of wall times, which is counted from behind: labels may hold commas.
std::string csv_without_times(const fs::path& path) {
  std::istringstream text(text_of(path));
  std::string line, kept;
  std::size_t from_behind = 0;  // 0: there is none
  for (bool head = true; std::getline(text, line); head = false) {
    std::vector<std::string> fields;
    std::istringstream row(line);
    for (std::string field; std::getline(row, field, ',');) fields.push_back(field);
    if (line.ends_with(',')) fields.emplace_back();
    for (std::size_t k = 0; head && k < fields.size(); ++k)
      if (fields[k] == "seconds") from_behind = fields.size() - k;
    for (std::size_t k = 0; k < fields.size(); ++k)
      if (from_behind == 0 || fields.size() - k != from_behind) kept += fields[k] + ",";
    kept += "\n";
  }
  return kept;
}

void add_hdf5(const io::Hdf5Reader& file, const std::string& group, std::string& all) {
  static const std::set<std::string> fleeting{"/provenance", "/performance"};
  for (const std::string& child : file.children(group)) {
    const std::string name = (group == "/" ? "" : group) + "/" + child;
    if (fleeting.contains(name)) continue;
    std::vector<std::string> below;
    try {
      below = file.children(name);
    } catch (const std::exception&) {
    }
    if (!below.empty()) {
      add_hdf5(file, name, all);
      continue;
    }
    try {
      all += name + "\n";
      for (const double value : file.doubles(name)) all.append(reinterpret_cast<const char*>(&value), sizeof value);
    } catch (const std::exception&) {
      const std::string text = file.text(name);
      const json record = json::parse(text, nullptr, false);
      all += record.is_object() ? timeless(record).dump() : text;
    }
  }
}

/// Everything that a command left, by name, in a form that is equal when the results are.
std::map<std::string, std::string> results_in(const fs::path& folder) {
  std::map<std::string, std::string> found;
  for (const auto& entry : fs::recursive_directory_iterator(folder)) {
    const std::string name = fs::relative(entry.path(), folder).string(), kind = entry.path().extension();
    if (entry.is_directory())
      found[name] = "folder";
    else if (kind == ".json")
      found[name] = timeless(json::parse(text_of(entry.path()))).dump();
    else if (kind == ".csv")
      found[name] = csv_without_times(entry.path());
    else if (kind == ".h5")
      add_hdf5(io::Hdf5Reader(entry.path()), "/", found[name]);
    else
      // A report holds times and the command: what it draws is in the other files.
      found[name] = kind == ".jsonl" ? "journal" : kind == ".html" ? "report" : text_of(entry.path());
  }
  return found;
}

class KillMatrix : public testing::TestWithParam<Command> {
 protected:
  void SetUp() override {
    std::string name = (fs::temp_directory_path() / "perfora-matrix-XXXXXX").string();
    folder_ = ::mkdtemp(name.data());
    write("design.toml", design);
    std::string larger = design;  // a packing of some thousand discs
    for (std::size_t at; (at = larger.find("\"20 mm\"")) != std::string::npos;) larger.replace(at, 7, "\"60 mm\"");
    write("larger.toml", larger);
    write("solid.toml", solid);
    write("study.toml", study);
    write("stages.toml", stages);
    write("sweep.toml", sweep);
    write("calibration.toml", calibration);
  }
  void TearDown() override { fs::remove_all(folder_); }
  void write(const std::string& name, const std::string& text) const { std::ofstream(folder_ / name) << text; }

  /// The command with its output in `place`.
  pid_t begin(const std::string& place, int threads, int workers, const std::vector<std::string>& further = {}) const {
    const Command& command = GetParam();
    fs::create_directories(folder_ / place);
    std::vector<std::string> arguments = command.arguments;
    for (std::string& text : arguments)
      if (text.ends_with(".toml")) text = folder_ / text;
    for (const std::string& text :
         std::vector<std::string>{std::string("-o"), (folder_ / place / command.output).string(),
                                  std::string("--threads"), std::to_string(threads), std::string("--quiet")})
      arguments.push_back(text);
    if (command.workers) arguments.insert(arguments.end(), {"--workers", std::to_string(workers)});
    arguments.insert(arguments.end(), further.begin(), further.end());
    return start(arguments, folder_ / "errors");
  }

  /// While `first`, which lives, has its output in `straight`, every other process is refused at once.
  void expect_others_refused(pid_t first) const {
    const std::string lock = GetParam().output == "work" ? "work/journal.jsonl.lock" : GetParam().output + ".lock";
    for (int k = 0; k < 20000 && !fs::exists(folder_ / "straight" / lock); ++k) std::this_thread::sleep_for(500us);
    kill(first, SIGSTOP);  // It lives, however fast the others are.
    ASSERT_TRUE(fs::exists(folder_ / "straight" / lock));
    for (const std::string& flag : std::vector<std::string>{"--force", "--quiet", "--resume"}) {
      if (flag == "--resume" && GetParam().again != flag) continue;
      const auto from = std::chrono::steady_clock::now();
      EXPECT_EQ(finish(begin("straight", 1, 1, {flag})), 1);
      EXPECT_LT(std::chrono::steady_clock::now() - from, 5s) << "at once";
      EXPECT_THAT(text_of(folder_ / "errors"),
                  testing::HasSubstr("is in use by process " + std::to_string(first) + " on host "));
    }
    kill(first, SIGCONT);
  }

  /// The results of a process that is stopped for a moment, in which others try for its output, and its wall time.
  std::map<std::string, std::string> undisturbed(double& seconds) const {
    const auto from = std::chrono::steady_clock::now();
    const pid_t first = begin("straight", 1, 1);
    expect_others_refused(first);
    EXPECT_EQ(finish(first), 0) << text_of(folder_ / "errors");
    seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - from).count();
    return results_in(folder_ / "straight");
  }

  void expect_same(const std::map<std::string, std::string>& wanted, const std::string& place) const {
    const auto got = results_in(folder_ / place);
    std::vector<std::string> names, wanted_names;
    for (const auto& [name, text] : got) names.push_back(name);
    for (const auto& [name, text] : wanted) wanted_names.push_back(name);
    EXPECT_EQ(names, wanted_names) << "nothing is left behind, nothing is missing";
    for (const auto& [name, text] : wanted)
      EXPECT_TRUE(!got.contains(name) || got.at(name) == text) << name << " differs";
  }

  bool writes_now(const std::string& place) const {
    std::error_code ignored;
    for (const auto& entry : fs::recursive_directory_iterator(folder_ / place, ignored))
      if (entry.path().filename().string().find(".tmp-") != std::string::npos) return true;
    return false;
  }

  fs::path folder_;
};

/// PERFORA_KILLS: how often each command is killed.
int wanted_kills() {
  const char* text = std::getenv("PERFORA_KILLS");
  return text ? std::atoi(text) : 3;
}

TEST_P(KillMatrix, SameResultsNothingLeftBehindAndASecondProcessRefused) {
  double seconds = 0.0;
  const auto wanted = undisturbed(seconds);
  std::mt19937 random(7);  // the moments differ with the machine anyway
  const auto uniform = [&] { return static_cast<double>(random()) / 4294967296.0; };
  int killed = 0, writing = 0, ends = 0;
  for (int attempt = 0; killed < wanted_kills() || ends == 0; ++attempt) {
    std::vector<std::string> further;
    if (fs::exists(folder_ / "killed")) further.push_back(GetParam().again);
    const pid_t pid = begin("killed", 1 + attempt % 2, 1 + attempt / 2 % 2, further);
    // A third dies soon, a third anywhere, a third while a file is written.
    const int kind = attempt % 3;
    const auto end = std::chrono::steady_clock::now() +
                     std::chrono::duration<double>(kind == 0 ? 0.05 * uniform() : seconds * uniform());
    int code = running;
    bool was_writing = false;
    while (killed < wanted_kills() && (code = finished(pid)) == running) {
      if (kind == 2 && (was_writing = writes_now("killed"))) break;
      if (std::chrono::steady_clock::now() >= end) break;
      std::this_thread::sleep_for(200us);
    }
    if (code == running && killed < wanted_kills()) {
      kill(pid, SIGKILL);
      code = finish(pid);
    } else if (code == running) {
      code = finish(pid);
    }
    if (code == -SIGKILL) {
      ++killed;
      writing += was_writing ? 1 : 0;
      continue;
    }
    ASSERT_EQ(code, 0) << "attempt " << attempt << ": " << text_of(folder_ / "errors");
    ++ends;
    expect_same(wanted, "killed");
    if (HasFailure()) break;
    fs::remove_all(folder_ / "killed");
  }
  RecordProperty("killed", killed);
  std::printf("%s: %d kills, %d of them while a file was written, %d times to the end\n", GetParam().name.c_str(),
              killed, writing, ends);
}

INSTANTIATE_TEST_SUITE_P(Commands, KillMatrix, testing::ValuesIn(commands()),
                         [](const auto& info) { return info.param.name; });

}  // namespace
}  // namespace perfora
