// What is here: what reaches standard error, in a log and on a (pseudo) terminal; standard output stays empty.
// What is not: real time: intervals are only checked to be kept.
#include "io/progress.h"

#include <fcntl.h>
#include <gmock/gmock.h>
#include <stdlib.h>
#include <unistd.h>

#include <cmath>
#include <thread>

namespace perfora::io {
namespace {

using testing::AllOf;
using testing::EndsWith;
using testing::HasSubstr;
using testing::Not;
using testing::StartsWith;

template <class Code>
std::string standard_error_of(const Code& code) {
  testing::internal::CaptureStdout();
  testing::internal::CaptureStderr();
  code();
  EXPECT_EQ(testing::internal::GetCapturedStdout(), "");
  return testing::internal::GetCapturedStderr();
}

TEST(ProgressText, PercentRateTimeLeft) {  // 20 % in 60 s: 20 %/min, the other 80 % take 240 s
  EXPECT_EQ(progress_text("compress", 0.2, 0.0, 60.0, "stress 0.21 MPa"),
            "compress 20.0 %, 20 %/min, 4 min 00 s left | stress 0.21 MPa");
  // resumed at 50 %: 10 % in 60 s, the other 40 % take 240 s
  EXPECT_EQ(progress_text("compress", 0.6, 0.5, 60.0, ""), "compress 60.0 %, 10 %/min, 4 min 00 s left");
  EXPECT_EQ(progress_text("compress", 0.6, 0.2, 2.0, ""), "compress 60.0 %, 20 %/s, 2 s left")
      << "by the second where it is fast";
  EXPECT_EQ(progress_text("compress", 0.0, 0.0, 0.0, ""), "compress 0.0 %");
}

TEST(Log, PlainLinesOnStandardError) {
  EXPECT_EQ(standard_error_of([] { log_info("a {} %v"); }), "a {} %v\n");
  EXPECT_EQ(standard_error_of([] { log_warning("a"); }), "warning: a\n");
  EXPECT_EQ(standard_error_of([] { log_error("a"); }), "error: a\n");
}

TEST(Log, QuietLeavesWarningsAndErrors) {
  set_verbosity(Verbosity::quiet);
  EXPECT_EQ(standard_error_of([] {
              log_info("a");
              Progress progress("work");
              progress.update(0.5, "b");
              progress.finish("c");
              log_warning("d");
              log_error("e");
            }),
            "warning: d\nerror: e\n");
  set_verbosity(Verbosity::normal);
}

TEST(Progress, LogGetsAtMostALineInTenSeconds) {
  const std::string said = standard_error_of([] {
    Progress progress("work");
    for (int k = 0; k <= 1000000; ++k) progress.update(1e-6 * k, "detail");
    progress.finish("42 discs");
    progress.finish("again");
  });
  EXPECT_THAT(said, AllOf(StartsWith("work done in "), EndsWith(" | 42 discs\n"), Not(HasSubstr("\r"))));
}

/// Standard error as a terminal shows it while `code` runs.
template <class Code>
std::string terminal_output_of(const Code& code) {
  const int master = ::posix_openpt(O_RDWR | O_NOCTTY);
  EXPECT_GE(master, 0);
  EXPECT_EQ(::grantpt(master), 0);
  EXPECT_EQ(::unlockpt(master), 0);
  const int terminal = ::open(::ptsname(master), O_RDWR | O_NOCTTY);
  const int kept = ::dup(STDERR_FILENO);
  ::setenv("TERM", "xterm", 1);
  ::dup2(terminal, STDERR_FILENO);
  code();
  ::dup2(kept, STDERR_FILENO);
  ::close(kept);
  ::close(terminal);
  std::string output;
  char block[4096];
  // Once the terminal is closed, what is left comes out and then an error.
  for (ssize_t got = 0; (got = ::read(master, block, sizeof block)) > 0;)
    output.append(block, static_cast<std::size_t>(got));
  ::close(master);
  return output;
}

TEST(Progress, TerminalLineRewritesItself) {
  const std::string said = terminal_output_of([] {
    Progress progress("work");
    progress.update(0.0, "");
    for (int k = 1; k <= 3; ++k) {
      std::this_thread::sleep_for(std::chrono::milliseconds(110));
      progress.update(0.25 * k, "detail " + std::string(200, 'x'));
      progress.update(0.25 * k, "too soon");
    }
    log_info("between");
    progress.finish("end");
  });
  EXPECT_THAT(said, HasSubstr("\r\x1b[Kwork 25.0 %"));
  EXPECT_THAT(said, HasSubstr("\r\x1b[Kwork 75.0 %"));
  EXPECT_THAT(said, HasSubstr("\r\x1b[Kbetween\r\n"));  // the line goes before other lines come
  EXPECT_THAT(said, EndsWith("| end\r\n"));
  EXPECT_THAT(said, Not(HasSubstr("too soon")));
  EXPECT_THAT(said, Not(HasSubstr(std::string(80, 'x'))));  // cut to the width, or it would wrap
}

TEST(Progress, SeveralThreadsMayLog) {
  const std::string said = standard_error_of([] {
    std::vector<std::thread> threads;
    for (int k = 0; k < 4; ++k)
      threads.emplace_back([] {
        for (int line = 0; line < 100; ++line) log_info("0123456789");
      });
    for (std::thread& thread : threads) thread.join();
  });
  std::string expected;
  for (int line = 0; line < 400; ++line) expected += "0123456789\n";
  EXPECT_EQ(said, expected);
}

}  // namespace
}  // namespace perfora::io
