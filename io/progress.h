// What is here: log lines and progress (percent, rate, time left, current stress): a line that rewrites itself on a
// terminal, plain lines in a log. What is not: any decision about the work.
#pragma once

#include <chrono>
#include <string>

namespace perfora::io {

enum class Verbosity { quiet, normal };

/// Everything goes to standard error; standard output is left for results.
void set_verbosity(Verbosity verbosity);
void log_info(const std::string& text);
void log_warning(const std::string& text);  ///< shown even when quiet
void log_error(const std::string& text);

/// Whether Progress rewrites one line; otherwise it adds plain lines to a log.
bool rewrites_progress();

/// One long piece of work. Updates are cheap to call; at most ten a second reach a terminal, one every ten seconds a
/// log.
class Progress {
 public:
  explicit Progress(std::string title);
  ~Progress();
  Progress(const Progress&) = delete;
  Progress& operator=(const Progress&) = delete;
  /// `fraction` in [0, 1]; `detail` such as "strain 0.123, stress 0.21 MPa, 1,234 steps/s".
  void update(double fraction, const std::string& detail);
  void finish(const std::string& detail);

 private:
  std::string title_;
  std::chrono::steady_clock::time_point start_;
  std::chrono::steady_clock::time_point last_;
  double first_fraction_ = -1.0;  ///< of the first update: a resumed run does not start at 0
  bool terminal_ = false;
  bool finished_ = false;
};

/// "title 42.3 %, 12 %/min, 4 min 48 s left | detail": what Progress prints after `seconds` of work since
/// `first_fraction`.
std::string progress_text(const std::string& title, double fraction, double first_fraction, double seconds,
                          const std::string& detail);

}  // namespace perfora::io
