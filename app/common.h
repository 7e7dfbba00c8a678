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
#include "io/lock.h"
#include "io/progress.h"
#include "results/progress.h"
#include "results/status.h"

namespace perfora::app {

enum ExitCode : int {
  exit_ok = 0,
  exit_input = 1,      ///< usage or input
  exit_numerical = 2,  ///< packing not reached, unstable run, ...
  exit_internal = 3,
  exit_stopped = 75,  ///< by a signal or the wall-time limit, with a checkpoint written
};

/// Exit code of a run or a search that ended with `status`.
ExitCode exit_code_of(results::RunStatus status);

/// Flags that read the same in every subcommand.
struct CommonFlags {
  std::vector<std::string> set;    ///< "section.key=value", in order
  std::vector<std::int64_t> seed;  ///< empty or one entry: --seed
  std::vector<std::int64_t> packing_seed, noise_seed, layout_seed, search_seed;
  int threads = 0;  ///< 0: not given
  bool json = false, quiet = false, force = false;

  /// --set first, then the seed flags as "seeds.seed=5", ...: what DesignFile takes.
  std::vector<std::string> overrides() const;
  /// --threads, or `otherwise` when it was not given; 0 stands for all cores.
  int thread_count(int otherwise = 0) const;
  /// Quiet or normal log; call first in every subcommand.
  void apply() const;
};

/// Which of the common flags mean something for a subcommand; the others are accepted, hidden and without effect.
enum class Uses { design, files_only };
void add_common_flags(CLI::App& command, CommonFlags& flags, Uses uses = Uses::design);

/// --only: cases of a sweep by their labels; `what` follows "Only the cases that have TEXT in their name (repeatable)".
void add_only_flag(CLI::App& command, std::vector<std::string>& only, const std::string& what = "");

/// The one JSON object on standard output, two-space indent; NaN and infinity become null.
void print_json(const nlohmann::json& object);
/// Text on standard output (the readable summary when --json is not given).
void print_text(const std::string& text);

/// A result: its JSON, or its readable summary. Throws io::InputError, which names `source`, for a damaged object.
void print_record(const nlohmann::json& object, bool as_json, const std::string& source = "");

/// The command line as it was typed (for provenance); set by main().
const std::string& command_line();
void set_command_line(int argc, char** argv);

/// SIGINT and SIGTERM request the stop that stop_token() tells of; a second one ends the program at once.
void install_stop_handlers();
/// What every compression, test or search of this program is given: it writes a checkpoint or its journal and stops.
io::Cancellation stop_token();
/// They end the program at once: for subcommands without checkpoints, whose outputs appear whole at their end.
void remove_stop_handlers();

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
/// Takes an output that cannot be resumed: holds its lock, refuses one that exists unless `force`, one that another
/// process uses in any case, and a folder that is missing or not writable.
[[nodiscard]] io::OutputLock claim_new_output(const std::filesystem::path& path, bool force);
/// "stem of the design" + suffix.
std::string default_name(const std::filesystem::path& design, const std::string& suffix);
/// Logs each warning of DesignFile::validate().
void log_warnings(const std::vector<std::string>& warnings);

}  // namespace perfora::app
