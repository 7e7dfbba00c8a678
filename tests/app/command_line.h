// What is here: the program run by a shell in a folder of its own, with a small design beside it. What is not: tests,
// processes that are watched (processes.h).
#pragma once

#include <gtest/gtest.h>
#include <stdlib.h>
#include <sys/wait.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>
#include <sstream>
#include <string>
#include <vector>

namespace perfora::test {

namespace fs = std::filesystem;
using nlohmann::json;

struct Outcome {
  int exit_code = -1;
  std::string output, error;
};

inline std::string read_text(const fs::path& path) {
  std::ostringstream text;
  text << std::ifstream(path, std::ios::binary).rdbuf();
  return text.str();
}

class CommandLine : public ::testing::Test {
 protected:
  void SetUp() override {
    std::string pattern = fs::temp_directory_path() / "perfora-command.XXXXXX";
    ASSERT_NE(::mkdtemp(pattern.data()), nullptr);
    folder_ = pattern;
    // One hole of 6 mm in 12 x 12 mm, some 380 discs, pressed fast and not far.
    std::ofstream(folder_ / "d.toml") << "title = \"small\"\n[cell]\nwidth = \"12 mm\"\nheight = \"12 mm\"\n"
                                         "[layout]\nfamily = \"square\"\nrows = 1\ncolumns = 1\ndiameter = \"6 mm\"\n"
                                         "[packing]\nsolid_fraction = 0.719\n[loading]\nuntil = 0.01\nrate = 40\n"
                                         "[measures]\nplateau_start = 0.002\nplateau_end = 0.008\n";
  }
  void TearDown() override { fs::remove_all(folder_); }

  Outcome run(const std::string& arguments) const {
    const std::string line =
        "cd '" + folder_.string() + "' && '" PERFORA_PROGRAM "' " + arguments + " > out.txt 2> err.txt";
    const int status = std::system(line.c_str());
    return {WIFEXITED(status) ? WEXITSTATUS(status) : -1, read_text(folder_ / "out.txt"),
            read_text(folder_ / "err.txt")};
  }
  /// Without what depends on the clock.
  static json comparable(const std::string& text) {
    json record = json::parse(text);
    record.erase("performance");
    for (auto& one : record["runs"]) one.erase("performance");
    return record;
  }
  std::vector<std::string> files() const {
    std::vector<std::string> names;
    for (const auto& entry : fs::directory_iterator(folder_)) names.push_back(entry.path().filename());
    std::sort(names.begin(), names.end());
    return names;
  }

  fs::path folder_;
};

/// The same with a small study "s.toml" of that design, scripts that start several processes, and what a study found.
class StudyCommands : public CommandLine {
 protected:
  void SetUp() override {
    CommandLine::SetUp();
    std::ofstream(folder_ / "s.toml") << "[study]\ndesign = \"d.toml\"\nmaxeval = 4\nreplicates = 2\n"
                                         "final_replicates = 3\n[target]\nplateau_stress = \"0.4 MPa\"\n"
                                         "[variables]\n\"layout.diameter\" = [\"4 mm\", \"7 mm\"]\n"
                                         "[arms]\nfamily = [\"square\", \"staggered\"]\nrows = [2]\n";
  }
  /// Runs a script of sh in the folder, in which $PERFORA is the program; its exit code.
  int shell(const std::string& script) const {
    std::ofstream(folder_ / "script.sh") << "cd '" << folder_.string() << "'\nexport PERFORA='" PERFORA_PROGRAM "'\n"
                                         << script << "\n";
    const int status = std::system(("sh '" + (folder_ / "script.sh").string() + "'").c_str());
    return WIFEXITED(status) ? WEXITSTATUS(status) : -1;
  }
  /// result.json of a study's folder, without times.
  json result(const std::string& folder) const {
    json record = json::parse(read_text(folder_ / folder / "result.json"));
    record.erase("performance");
    return record;
  }
};

}  // namespace perfora::test
