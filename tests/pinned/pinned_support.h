// What is here: a copy of the pinned fixtures to work in, the program run in it, and comparisons that name what
// differs. What is not: the tests, and how the fixtures were made (make_fixtures).
#pragma once

#include <gtest/gtest.h>

#include <filesystem>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

namespace perfora::test {

std::string read_text(const std::filesystem::path& path);
/// The text with every number as %.17g prints it: texts are equal where all numbers have the same bits, however many digits
/// they are written with.
std::string same_digits(const std::string& text);
/// Where the committed fixtures stand.
std::filesystem::path pinned(const std::string& name);
/// A pinned text in the names of keys and the words of today.
std::string reworded(std::string text);
nlohmann::json pinned_json(const std::string& name);

struct Outcome {
  int exit_code = -1;
  std::string output, error;
};

/// Designs and fixtures in a temporary folder, removed at the end.
class WorkFolder {
 public:
  explicit WorkFolder(const std::string& data = "data");
  ~WorkFolder();
  WorkFolder(const WorkFolder&) = delete;
  WorkFolder& operator=(const WorkFolder&) = delete;

  /// Runs `perfora ARGUMENTS` in the folder, on one thread.
  Outcome run(const std::string& arguments) const;
  std::filesystem::path operator/(const std::string& name) const { return folder_ / name; }

 private:
  std::filesystem::path folder_;
};

/// One line of commands.txt or golden.txt: NAME | KIND | ARGUMENTS.
struct PinnedCommand {
  std::string name, kind, arguments;
};
std::vector<PinnedCommand> pinned_commands(const std::string& file);
void PrintTo(const PinnedCommand& command, std::ostream* out);
/// The name of its test.
std::string name_of(const ::testing::TestParamInfo<PinnedCommand>& command);

/// Why the program cannot run on this machine with this instruction set ("" if it can): "avx512", "avx2", "portable".
std::string not_here(const std::string& instruction_set);
/// Why a simulation may give other bits here than where the fixtures were made ("" if it must not).
std::string other_bits(const std::string& instruction_set);

/// Where two results differ, a line each: keys too many or missing, values that are not the same to the last bit.
/// What depends on the clock, on memory and on the number of threads is left out, and measures that the program has
/// learned since.
std::string differences(const nlohmann::json& expected, const nlohmann::json& actual, const std::string& place = "");

/// A table without the column of seconds and without those of measures that the table `pinned` has not got.
std::string comparable_table(const std::string& csv, const std::string& pinned);
/// A summary as printed, without what depends on the clock and without measures that the summary `pinned` has not got.
std::string comparable_text(const std::string& text, const std::string& pinned);

/// Lines of a journal; the program keeps finished work in those with the event `evaluation`, `replicate` or `point`.
std::vector<std::string> journal_lines(const std::filesystem::path& folder);
/// Names of what is finished in a journal, in its order: designs with their replicates, keys of points, or numbers of
/// replicates.
std::vector<std::string> finished_in(const std::filesystem::path& folder);

}  // namespace perfora::test
