// What is here: the flags that subcommands share turned into settings of the program, answers printed as JSON, stop
// signals caught. What is not: the work of any subcommand.
#include "app/common.h"

#include <fmt/format.h>
#include <unistd.h>

#include <cerrno>
#include <cmath>
#include <csignal>
#include <cstdio>
#include <system_error>

#include "io/error.h"
#include "io/files.h"
#include "io/litter.h"
#include "io/memory.h"
#include "io/processors.h"
#include "io/units.h"
#include "optimize/evaluate/design.h"
#include "optimize/evaluate/estimate.h"
#include "results/summary_text.h"

namespace perfora::app {

namespace {

std::string command_line_text;       // NOLINT: written once by main()
io::CancellationSource stop_source;  // NOLINT: a signal handler has no argument to find it by

/// Async-signal-safe.
extern "C" void ask_to_stop(int) {
  stop_source.request();
  if (stop_source.attended()) return;
  constexpr std::string_view text = "perfora: stopped by a signal; there was nothing to keep\n";
  static_cast<void>(!::write(STDERR_FILENO, text.data(), text.size()));
  io::remove_litter();
  ::_exit(exit_stopped);
}

/// What is wrong with a flag that changes a design, beside results.
std::string of_another_command(const std::string& flag) {
  return flag + " changes a design, and results are taken as they are: give it to the command that makes them";
}
CLI::Validator no_effect_on_results(const std::string& flag) {
  return {[flag](std::string&) { return of_another_command(flag); }, ""};
}

/// Refuses what is no Number, or one that is not `good`; `wanted` ends the message: "... is no WANTED".
template <typename Number, typename Good>
CLI::Validator number_that(Good good, const std::string& wanted) {
  return CLI::Validator(
      [good, wanted](std::string& text) {
        Number number{};
        if (CLI::detail::lexical_cast(text, number) && good(number)) return std::string();
        return fmt::format("\"{}\" is no {}", text, wanted);
      },
      "");
}

}  // namespace

CLI::Validator positive_number(bool zero) {
  return number_that<double>(
      [zero](double number) { return (zero ? number >= 0.0 : number > 0.0) && std::isfinite(number); },
      zero ? "number of 0 or more" : "number above 0");
}

CLI::Validator number_within(double least, double largest) {
  return number_that<double>([=](double number) { return number >= least && number <= largest; },
                             fmt::format("number from {} to {}", least, largest));
}

CLI::Validator whole_number_within(std::int64_t least, std::int64_t largest) {
  return number_that<std::int64_t>([=](std::int64_t number) { return number >= least && number <= largest; },
                                   fmt::format("whole number from {} to {}", least, largest));
}

namespace {

/// The argument as a shell would need it.
std::string quoted(const std::string& argument) {
  if (!argument.empty() && argument.find_first_of(" \t\n\"'\\$&|;<>()*?[]{}#~`!") == std::string::npos) return argument;
  std::string result(1, '\'');
  for (const char c : argument) {
    if (c == '\'')
      result.append("'\\''");
    else
      result.push_back(c);
  }
  result.push_back('\'');
  return result;
}

void add_seed(std::vector<std::string>& overrides, const char* key, const std::vector<std::int64_t>& value) {
  if (!value.empty()) overrides.push_back(fmt::format("seeds.{}={}", key, value.back()));
}

/// NaN and infinity as null, everywhere in `object`.
nlohmann::json finite(const nlohmann::json& object) {
  nlohmann::json result = object;
  if (result.is_number_float() && !std::isfinite(result.get<double>())) return nullptr;
  if (result.is_structured())
    for (auto& value : result) value = finite(value);
  return result;
}

io::Dimension dimension_of_key(const std::string& name) {
  optimize::Design design;
  io::Schema schema;
  optimize::describe(schema, design);
  const io::Key* key = schema.find(name);
  return key ? key->dimension : io::Dimension::none;
}

}  // namespace

ExitCode exit_code_of(results::RunStatus status) {
  switch (status) {
    case results::RunStatus::completed:
      return exit_ok;
    case results::RunStatus::stopped:
      return exit_stopped;
    case results::RunStatus::failed:
      return exit_numerical;
  }
  return exit_internal;
}

std::vector<std::string> CommonFlags::overrides() const {
  std::vector<std::string> result = set;
  add_seed(result, "seed", seed);
  add_seed(result, "packing", packing_seed);
  add_seed(result, "noise", noise_seed);
  add_seed(result, "layout", layout_seed);
  add_seed(result, "search", search_seed);
  return result;
}

int CommonFlags::thread_count(int otherwise) const {
  const int wanted = threads > 0 ? threads : otherwise;
  return wanted > 0 ? wanted : io::default_threads();
}

double CommonFlags::memory_allowed() const {
  if (memory.empty()) return io::usable_memory_bytes();
  const io::Origin origin{"--memory", 0, ""};
  if (memory.find_first_not_of("0123456789.") == std::string::npos)
    throw io::InputError(origin, memory + " has no unit", "a size such as \"24 GB\"",
                         fmt::format("write \"{} GB\"", memory));
  const double bytes = io::parse_quantity(io::Value{memory}, io::Dimension::memory, origin);
  if (!(bytes > 0.0)) throw io::InputError(origin, memory + " is no memory", "a size such as \"24 GB\"");
  return bytes;
}

void CommonFlags::refuse_overrides(const std::filesystem::path& input) const {
  if (!overrides().empty())
    throw io::InputError({input.string(), 0, ""}, "is no design", "", of_another_command("--set"));
}

void CommonFlags::apply() const {
  io::set_verbosity(quiet ? io::Verbosity::quiet : io::Verbosity::normal);
}

void add_common_flags(CLI::App& command, CommonFlags& flags, Uses uses) {
  const std::string design_group = uses == Uses::files_only ? "" : "Design";  // "": accepted but not listed
  const std::string output_group = "Everywhere";
  CLI::Option* set =
      command.add_option("--set", flags.set, "Set one key of the design: section.key=value (repeatable)")
          ->group(design_group)
          ->allow_extra_args(false);
  if (uses == Uses::files_only) set->check(no_effect_on_results("--set"));
  auto add_seed_flag = [&](const std::string& name, std::vector<std::int64_t>& value, const std::string& help) {
    CLI::Option* seed = command.add_option(name, value, help)->group(design_group)->expected(1);
    seed->check(whole_number_within(0, optimize::Seeds::largest))->type_name("N");  // 0: derive it from --seed
    if (uses == Uses::files_only) seed->check(no_effect_on_results(name));
  };
  add_seed_flag("--seed", flags.seed, "The number all random streams are derived from (default 1)");
  add_seed_flag("--packing-seed", flags.packing_seed, "Seed of the disc packing alone (0: from --seed)");
  add_seed_flag("--noise-seed", flags.noise_seed, "Seed of the strength field alone (0: from --seed)");
  add_seed_flag("--layout-seed", flags.layout_seed, "Seed of random layouts and jitter alone (0: from --seed)");
  add_seed_flag("--search-seed", flags.search_seed, "Seed of the search alone (0: from --seed)");
  command.add_option("--threads", flags.threads, "Number of threads (default: the processors this process may use)")
      ->group(design_group)
      ->check(no_more_than_help())
      ->type_name("N");
  command
      .add_option("--memory", flags.memory,
                  "Memory that all of it may take, as \"24 GB\" (default: what this process may have)")
      ->group(design_group)
      ->type_name("SIZE");
  command.add_flag("--json", flags.json, "Print one JSON object on standard output, everything else on standard error")
      ->group(output_group);
  command.add_flag("--quiet", flags.quiet, "No log and no progress, only warnings, errors and the result")
      ->group(output_group);
  command.add_flag("--force", flags.force, "Replace an output that exists")->group(output_group);
}

CLI::Validator no_more_than_help() {
  return {[](std::string& text) {
            int number = 0;
            const int most = io::most_threads(), usable = io::usable_processors();
            if (CLI::detail::lexical_cast(text, number) && number >= 1 && number <= most) return std::string();
            return fmt::format("{} is outside 1 to {}: this process may use {} processor{}, and more would only wait",
                               text, most, usable, usable == 1 ? "" : "s");
          },
          ""};
}

void add_only_flag(CLI::App& command, std::vector<std::string>& only, const std::string& what) {
  command.add_option("--only", only, "Only the cases that have TEXT in their name (repeatable)" + what)
      ->check([](const std::string& text) { return text.empty() ? std::string("a text is wanted") : std::string(); })
      ->type_name("TEXT")
      ->allow_extra_args(false);
}

void print_json(const nlohmann::json& object) {
  print_text(finite(object).dump(2) + "\n");
}

void print_text(const std::string& text) {
  const bool written = std::fwrite(text.data(), 1, text.size(), stdout) == text.size();
  if (!written || std::fflush(stdout) != 0)
    throw io::SurroundingsError("standard output cannot be written: " + std::generic_category().message(errno) +
                                "; what was made is in its files, `perfora show` prints it again");
}

std::string record_text(const nlohmann::json& object, const std::string& source) {
  return results::summary_text(object, dimension_of_key, source);
}

void print_record(const nlohmann::json& object, bool as_json, const std::string& source) {
  if (as_json)
    print_json(object);
  else
    print_text(record_text(object, source));
}

const std::string& command_line() {
  return command_line_text;
}

void set_command_line(int argc, char** argv) {
  command_line_text = "perfora";
  for (int k = 1; k < argc; ++k) command_line_text += " " + quoted(argv[k]);
}

void install_stop_handlers() {
  struct sigaction action = {};
  action.sa_handler = ask_to_stop;
  sigemptyset(&action.sa_mask);
  action.sa_flags = SA_RESETHAND | SA_RESTART;  // the second signal meets the default action
  for (const int signal : {SIGINT, SIGTERM, SIGHUP, SIGQUIT, SIGUSR1, SIGUSR2, SIGXCPU})
    sigaction(signal, &action, nullptr);
}

io::Cancellation stop_token() {
  return stop_source.token();
}

ProgressLine::ProgressLine(std::string title, bool quiet) : title_(std::move(title)), quiet_(quiet) {}

void ProgressLine::update(double fraction, const std::string& detail) {
  if (quiet_) return;
  // A fraction that falls belongs to the next piece of work (packing, then compression): its time left starts anew.
  if (!progress_ || fraction < fraction_) progress_ = std::make_unique<io::Progress>(title_);
  fraction_ = fraction;
  progress_->update(fraction, detail);
}

void ProgressLine::finish(const std::string& detail) {
  if (progress_) progress_->finish(detail);
  progress_.reset();
}

results::ProgressCallback ProgressLine::callback() {
  return [this](const results::Progress& progress) { update(progress.fraction, progress.text); };
}

std::filesystem::path output_or_default(const std::filesystem::path& given, const std::string& fallback) {
  if (!given.empty()) return given;
  io::log_info(fmt::format("no -o given: the result goes to {}", fallback));
  return fallback;
}

std::string default_name(const std::filesystem::path& design, const std::string& suffix) {
  return design.stem().string() + suffix;
}

void log_warnings(const std::vector<std::string>& warnings) {
  for (const std::string& warning : warnings) io::log_warning(warning);
}

void check_cost(const optimize::DesignFile& design, const CommonFlags& flags) {
  log_warnings(optimize::check_cost(design, flags.thread_count(), flags.memory_allowed()));
}

void refuse_resume_with_force(bool resume, bool force) {
  if (resume && force)
    throw io::InputError({"--resume", 0, ""}, "--resume and --force exclude each other", "", "give only one of them");
}

}  // namespace perfora::app
