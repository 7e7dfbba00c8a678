// What is here: log lines and progress on standard error, through spdlog.
// What is not: any decision about the work.
#include "io/progress.h"

#include <fmt/format.h>
#include <spdlog/pattern_formatter.h>
#include <spdlog/sinks/stdout_sinks.h>
#include <spdlog/spdlog.h>
#include <sys/ioctl.h>
#include <unistd.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <memory>
#include <mutex>
#include <string_view>

#include "io/text.h"

namespace perfora::io {
namespace {

constexpr std::chrono::milliseconds terminal_interval{100};
constexpr std::chrono::seconds log_interval{10};
constexpr const char* clear_line = "\r\x1b[K";

bool on_terminal() {
  const char* kind = std::getenv("TERM");
  return ::isatty(STDERR_FILENO) == 1 && !(kind != nullptr && std::string_view(kind) == "dumb");
}

std::size_t terminal_width() {
  winsize size{};
  if (::ioctl(STDERR_FILENO, TIOCGWINSZ, &size) != 0 || size.ws_col == 0) return 80;
  return size.ws_col;
}

/// Standard error, shared by log lines and the progress line, which must not run into each other.
class Output {
 public:
  static Output& get() {
    static Output output;
    return output;
  }

  void set_verbosity(Verbosity verbosity) {
    const std::lock_guard lock(mutex_);
    verbosity_ = verbosity;
  }

  bool quiet() {
    const std::lock_guard lock(mutex_);
    return verbosity_ == Verbosity::quiet;
  }

  void line(spdlog::level::level_enum level, const std::string& text) {
    const std::lock_guard lock(mutex_);
    if (verbosity_ == Verbosity::quiet && level < spdlog::level::warn) return;
    end_rewriting();
    lines_.log(level, "{}", text);
  }

  void rewrite(const std::string& text) {
    const std::lock_guard lock(mutex_);
    if (verbosity_ == Verbosity::quiet) return;
    raw_.info("{}{}", clear_line, text.substr(0, terminal_width() - 1));
    rewriting_ = true;
  }

  /// Removes the rewriting line, if there is one.
  void clear() {
    const std::lock_guard lock(mutex_);
    end_rewriting();
  }

 private:
  Output()
      : sink_(std::make_shared<spdlog::sinks::stderr_sink_mt>()),
        lines_("perfora", sink_),
        raw_("progress", raw_sink()) {
    lines_.set_pattern("%v");
    lines_.flush_on(spdlog::level::trace);
    raw_.flush_on(spdlog::level::trace);
  }

  /// spdlog ends every message with a line break unless its formatter is told otherwise.
  static spdlog::sink_ptr raw_sink() {
    auto sink = std::make_shared<spdlog::sinks::stderr_sink_mt>();
    sink->set_formatter(std::make_unique<spdlog::pattern_formatter>("%v", spdlog::pattern_time_type::local, ""));
    return sink;
  }

  void end_rewriting() {
    if (!rewriting_) return;
    raw_.info("{}", clear_line);
    rewriting_ = false;
  }

  std::mutex mutex_;
  Verbosity verbosity_ = Verbosity::normal;
  bool rewriting_ = false;
  spdlog::sink_ptr sink_;
  spdlog::logger lines_;
  spdlog::logger raw_;
};

double seconds_since(std::chrono::steady_clock::time_point start) {
  return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
}

}  // namespace

void set_verbosity(Verbosity verbosity) {
  Output::get().set_verbosity(verbosity);
}
void log_info(const std::string& text) {
  Output::get().line(spdlog::level::info, text);
}
void log_warning(const std::string& text) {
  Output::get().line(spdlog::level::warn, "warning: " + text);
}
void log_error(const std::string& text) {
  Output::get().line(spdlog::level::err, "error: " + text);
}

bool rewrites_progress() {
  return on_terminal();
}

std::string progress_text(const std::string& title, double fraction, double first_fraction, double seconds,
                          const std::string& detail) {
  std::string text = fmt::format("{} {:.1f} %", title, 100.0 * fraction);
  const double rate = seconds > 0.0 ? (fraction - first_fraction) / seconds : 0.0;
  if (rate > 0.0) {
    const double a_minute = 6000.0 * rate;
    const std::string speed =
        a_minute < 100.0 ? fmt::format("{:.3g} %/min", a_minute) : fmt::format("{:.3g} %/s", a_minute / 60.0);
    text += fmt::format(", {}, {} left", speed, duration((1.0 - fraction) / rate));
  }
  return detail.empty() ? text : text + " | " + detail;
}

Progress::Progress(std::string title)
    : title_(std::move(title)), start_(std::chrono::steady_clock::now()), last_(start_), terminal_(on_terminal()) {}

Progress::~Progress() {
  if (!finished_ && terminal_) Output::get().clear();
}

void Progress::update(double fraction, const std::string& detail) {
  fraction = std::isnan(fraction) ? 0.0 : std::clamp(fraction, 0.0, 1.0);
  if (first_fraction_ < 0.0) first_fraction_ = fraction;
  const auto now = std::chrono::steady_clock::now();
  if (finished_ || now - last_ < (terminal_ ? std::chrono::milliseconds(terminal_interval) : log_interval)) return;
  last_ = now;
  const std::string text = progress_text(title_, fraction, first_fraction_, seconds_since(start_), detail);
  if (terminal_)
    Output::get().rewrite(text);
  else
    log_info(text);
}

void Progress::finish(const std::string& detail) {
  if (finished_) return;
  finished_ = true;
  const std::string text = fmt::format("{} done in {}", title_, duration(seconds_since(start_)));
  log_info(detail.empty() ? text : text + " | " + detail);
}

}  // namespace perfora::io
