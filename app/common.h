// What is here: flags every subcommand takes or several share, exit codes, the JSON on standard output, stop signals.
// What is not: the work of any subcommand.
#pragma once

#include <CLI/CLI.hpp>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <memory>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "io/cancellation.h"
#include "io/progress.h"
#include "results/progress.h"
#include "results/status.h"

namespace perfora::optimize {
class DesignFile;
}

namespace perfora::app {

enum ExitCode : int {
  exit_ok = 0,
  exit_input = 1,      ///< usage or input
  exit_numerical = 2,  ///< packing not reached, unstable run, ...
  exit_internal = 3,
  exit_stopped = 75,  ///< by a signal or the wall-time limit, with a checkpoint written
};

constexpr int most_replicates = 1000;  ///< of one design or one material test (--replicates)

/// Exit code of a run or a search that ended with `status`.
ExitCode exit_code_of(results::RunStatus status);

/// Flags that read the same in every subcommand.
struct CommonFlags {
  std::vector<std::string> set;    ///< "section.key=value", in order
  std::vector<std::int64_t> seed;  ///< empty or one entry: --seed
  std::vector<std::int64_t> packing_seed, noise_seed, layout_seed, search_seed;
  int threads = 0;     ///< 0: not given
  std::string memory;  ///< --memory, empty: not given
  bool json = false, quiet = false, force = false;

  /// --set first, then the seed flags as "seeds.seed=5", ...: what DesignFile takes.
  std::vector<std::string> overrides() const;
  /// --threads, or `otherwise` when it was not given; 0 stands for io::default_threads().
  int thread_count(int otherwise = 0) const;
  /// --memory in bytes, or what the machine and the limits of this process allow. Throws io::InputError.
  double memory_allowed() const;
  /// Throws io::InputError where a key or a seed is given beside `input`, which is no design.
  void refuse_overrides(const std::filesystem::path& input) const;
  /// Quiet or normal log; call first in every subcommand.
  void apply() const;
};

/// Which of the common flags mean something for a subcommand. The others are hidden: threads and memory are accepted
/// without effect, keys and seeds of a design are refused.
enum class Uses { design, files_only };
void add_common_flags(CLI::App& command, CommonFlags& flags, Uses uses = Uses::design);

/// Refuses a number of threads or worker processes beyond io::most_threads().
CLI::Validator no_more_than_help();

/// Refuses what is no number above zero (or zero, where `zero`).
CLI::Validator positive_number(bool zero = false);

/// Refuses what is no number, or no whole number, within these bounds, which belong to it.
CLI::Validator number_within(double least, double largest);
CLI::Validator whole_number_within(std::int64_t least, std::int64_t largest);

/// --only: cases of a sweep by their labels; `what` follows "Only the cases that have TEXT in their name (repeatable)".
void add_only_flag(CLI::App& command, std::vector<std::string>& only, const std::string& what = "");

/// The one JSON object on standard output, two-space indent; NaN and infinity become null.
void print_json(const nlohmann::json& object);
/// Text on standard output (the readable summary when --json is not given).
void print_text(const std::string& text);

/// The readable summary of a result. Throws as print_record does.
std::string record_text(const nlohmann::json& object, const std::string& source = "");
/// A result: its JSON, or its readable summary. Throws io::InputError, which names `source`, for a damaged object.
void print_record(const nlohmann::json& object, bool as_json, const std::string& source = "");

/// The command line as it was typed (for provenance); set by main().
const std::string& command_line();
void set_command_line(int argc, char** argv);

/// INT, TERM, HUP (a lost terminal), QUIT, USR1, USR2 (batch systems before their limit) and XCPU request the stop that
/// stop_token() tells of. Where nobody looks at the token (packing, drawing, reading: nothing to keep yet), or at a
/// second signal of the kind, the program ends at once; the former with exit code 75 and nothing left behind.
void install_stop_handlers();
/// What every compression, test or search of this program is given: it writes a checkpoint or its journal and stops.
io::Cancellation stop_token();

/// Draws io::Progress lines for EvaluateOptions::progress; silent when quiet. It must outlive the callbacks it gives.
class ProgressLine {
 public:
  ProgressLine(std::string title, bool quiet);
  void update(double fraction, const std::string& detail);
  void finish(const std::string& detail);
  results::ProgressCallback callback();

 private:
  std::string title_;
  bool quiet_;
  double fraction_ = 0.0;
  std::unique_ptr<io::Progress> progress_;
};

/// Throws io::InputError when both are given.
void refuse_resume_with_force(bool resume, bool force);

/// The output path: `given`, or `fallback` in the current folder, announced on standard error.
std::filesystem::path output_or_default(const std::filesystem::path& given, const std::string& fallback);
/// "stem of the design" + suffix.
std::string default_name(const std::filesystem::path& design, const std::string& suffix);
/// Logs each warning of DesignFile::validate().
void log_warnings(const std::vector<std::string>& warnings);

/// What an evaluation of `design` costs: logs what a user should know beforehand, and throws io::InputError for one
/// that takes more memory than the flags and the machine allow.
void check_cost(const optimize::DesignFile& design, const CommonFlags& flags);

}  // namespace perfora::app
