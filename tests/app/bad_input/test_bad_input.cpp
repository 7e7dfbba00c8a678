// What is here: every case of cases.txt given to the program: exit code 1, one sentence on standard error that holds
// every fragment, nothing on standard output, less than a second of processor time, no file left. What is not: the
// cases (cases.txt and the files beside it).
#include <gtest/gtest.h>
#include <sys/resource.h>
#include <sys/wait.h>

#include <algorithm>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <map>
#include <set>
#include <sstream>

#include "tests/app/bad_input/broken_hdf5.h"

namespace perfora::test {
namespace {

namespace fs = std::filesystem;

const fs::path corpus = fs::path(PERFORA_SOURCE_DIR) / "tests/app/bad_input";

struct Case {
  int line = 0;  ///< of cases.txt
  std::string file, command;
  std::vector<std::string> fragments;
};

void PrintTo(const Case& item, std::ostream* out) {
  *out << "cases.txt:" << item.line << ": " << item.command << " " << item.file;
}

std::string trimmed(const std::string& text) {
  const auto first = text.find_first_not_of(' ');
  return first == std::string::npos ? "" : text.substr(first, text.find_last_not_of(' ') - first + 1);
}

std::vector<Case> read_cases() {
  std::vector<Case> cases;
  std::ifstream stream(corpus / "cases.txt");
  std::string line;
  for (int number = 1; std::getline(stream, line); ++number) {
    if (line.empty() || line[0] == '#') continue;
    std::vector<std::string> cells;
    std::istringstream cell_stream(line);
    for (std::string cell; std::getline(cell_stream, cell, '|');) cells.push_back(trimmed(cell));
    if (cells.size() < 3) throw std::runtime_error("cases.txt:" + std::to_string(number) + ": three cells at least");
    cases.push_back({number, cells[0], cells[1], {cells.begin() + 2, cells.end()}});
  }
  return cases;
}

std::string name_of(const ::testing::TestParamInfo<Case>& item) {
  std::string name = item.param.command.substr(0, item.param.command.find(' ')) + "_" + item.param.file;
  for (char& letter : name)
    if (!std::isalnum(static_cast<unsigned char>(letter))) letter = '_';
  return name + "_" + std::to_string(item.param.line);
}

std::string read_text(const fs::path& path) {
  std::ostringstream text;
  text << std::ifstream(path, std::ios::binary).rdbuf();
  return text.str();
}

std::string in_quotes(const std::string& text) {
  return "'" + text + "'";
}

double processor_seconds() {
  rusage usage{};
  getrusage(RUSAGE_CHILDREN, &usage);
  const auto seconds = [](const timeval& time) {
    return static_cast<double>(time.tv_sec) + 1e-6 * static_cast<double>(time.tv_usec);
  };
  return seconds(usage.ru_utime) + seconds(usage.ru_stime);
}

struct Outcome {
  int exit_code = -1;
  std::string output, error;
  double seconds = 0.0;
};

/// Runs the program in a shell in `folder`; its output goes to files beside that folder.
Outcome run_program(const std::string& arguments, const fs::path& folder) {
  const fs::path output = folder.parent_path() / "stdout", error = folder.parent_path() / "stderr";
  const std::string line = "cd " + in_quotes(folder) + " && timeout 20 " + in_quotes(PERFORA_PROGRAM) + " " +
                           arguments + " > " + in_quotes(output) + " 2> " + in_quotes(error) + " < /dev/null";
  const double before = processor_seconds();
  const int status = std::system(line.c_str());
  return {WIFEXITED(status) ? WEXITSTATUS(status) : -1, read_text(output), read_text(error),
          processor_seconds() - before};
}

class BadInput : public ::testing::TestWithParam<Case> {
 protected:
  void SetUp() override {
    std::string pattern = fs::temp_directory_path() / "perfora-bad-input.XXXXXX";
    ASSERT_NE(mkdtemp(pattern.data()), nullptr);
    folder_ = pattern;
    fs::create_directories(folder_ / "run");
    fs::create_directories(folder_ / "made");
  }
  void TearDown() override { fs::remove_all(folder_); }

  /// Where the case's file lies; one that begins with made/ is made first.
  fs::path file_of(const Case& item) {
    if (item.file.rfind("made/", 0) != 0) return corpus / item.file;
    const fs::path target = folder_ / item.file;
    const std::map<std::string, std::string> keys = {{"other_seed", "--packing-seed 77"},
                                                     {"other_cell", "--set cell.width=22mm"}};
    const auto other = keys.find(target.stem());
    const fs::path packed = other == keys.end() ? folder_ / "made/good.h5" : target;
    const std::string flags = other == keys.end() ? "" : other->second;
    const auto outcome = run_program(
        "pack " + in_quotes(corpus / "good.toml") + " --quiet " + flags + " -o " + in_quotes(packed), folder_ / "run");
    EXPECT_EQ(outcome.exit_code, 0) << outcome.error;
    if (packed != target) make_broken_hdf5(packed, target);
    return target;
  }

  std::string arguments_of(const Case& item) {
    std::string arguments;
    bool named = false;
    std::istringstream words(item.command);
    for (std::string word; words >> word;) {
      named = named || word == "{}";
      if (word == "{}")
        word = file_of(item);
      else if (fs::path(word).extension() == ".toml")
        word = corpus / word;
      arguments += in_quotes(word) + " ";
    }
    if (!named) arguments += in_quotes(file_of(item));
    const std::set<std::string> writers = {"pack", "evaluate", "optimize", "plot", "report", "test", "calibrate"};
    const std::string command = item.command.substr(0, item.command.find(' '));
    const std::string ending = command == "optimize" || command == "calibrate" ? ""
                               : command == "plot"                             ? ".png"
                               : command == "report"                           ? ".html"
                                                                               : ".h5";
    if (writers.count(command) > 0) arguments += " -o " + in_quotes(folder_ / ("run/output" + ending));
    return arguments;
  }

  fs::path folder_;
};

TEST_P(BadInput, IsToldInOneSentence) {
  constexpr double longest_seconds = 1.0;
  const std::string arguments = arguments_of(GetParam());
  const Outcome outcome = run_program(arguments, folder_ / "run");
  SCOPED_TRACE("perfora " + arguments);
  SCOPED_TRACE("standard error: " + outcome.error);

  EXPECT_EQ(outcome.exit_code, 1);
  EXPECT_EQ(std::count(outcome.error.begin(), outcome.error.end(), '\n'), 1) << "one line is wanted";
  for (const auto& fragment : GetParam().fragments)
    EXPECT_NE(outcome.error.find(fragment), std::string::npos) << "lacks: " << fragment;
  EXPECT_EQ(outcome.output, "");
  EXPECT_LT(outcome.seconds, longest_seconds);
  for (const auto& left : fs::recursive_directory_iterator(folder_ / "run"))
    ADD_FAILURE() << "left behind: " << left.path();
}

INSTANTIATE_TEST_SUITE_P(Corpus, BadInput, ::testing::ValuesIn(read_cases()), name_of);

TEST(BadInputCorpus, GoodFilesOfTheCorpusPass) {
  std::string pattern = fs::temp_directory_path() / "perfora-bad-input.XXXXXX";
  ASSERT_NE(mkdtemp(pattern.data()), nullptr);
  const fs::path folder = pattern;
  fs::create_directories(folder / "run");
  for (const std::string name : {"good.toml", "good_study.toml"}) {
    const auto outcome = run_program("check " + in_quotes(corpus / name), folder / "run");
    EXPECT_EQ(outcome.exit_code, 0) << outcome.error;
  }
  fs::remove_all(folder);
}

TEST(BadInputCorpus, EveryFileIsUsedAndThereAreEnough) {
  const auto cases = read_cases();
  EXPECT_GE(cases.size(), 40u);
  std::string text = read_text(corpus / "cases.txt");
  for (const auto& entry : fs::directory_iterator(corpus)) {
    const std::string name = entry.path().filename();
    const auto extension = entry.path().extension();
    if (extension != ".toml" && extension != ".h5") continue;
    EXPECT_NE(text.find(name), std::string::npos) << name << " is in no case";
  }
}

}  // namespace
}  // namespace perfora::test
