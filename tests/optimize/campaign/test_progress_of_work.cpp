// What is here: what people see of evaluations that take long, in a log and on a terminal. What is not: how a worker
// tells it (test_executor.cpp).
#include <gmock/gmock.h>

#include <deque>

#include "io/progress.h"
#include "tests/optimize/campaign/counting.h"
#include "tests/optimize/search/study_support.h"

namespace perfora::optimize {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;

/// Answers one request after another, each at the third look; a fourth of it is done at the first, half at the second.
class Telling final : public Executor {
 public:
  int workers() const override { return 1; }
  void submit(const std::string& key, const Request& request) override { queue_.push_back({key, request}); }
  std::optional<Answer> next(std::chrono::milliseconds) override {
    if (queue_.empty() || ++looks_ < 3) return std::nullopt;
    looks_ = 0;
    Answer answer{queue_.front().first, Counting::plateau(queue_.front().second)};
    queue_.pop_front();
    return answer;
  }
  void stop() override { queue_.clear(); }
  std::vector<UnderWay> under_way() const override {
    if (queue_.empty() || looks_ == 0) return {};
    const double done = looks_ == 1 ? 0.25 : 0.5;
    return {{queue_.front().first, 60.0 * looks_, {done, looks_ == 1 ? "strain 1 %" : "strain 2 %"}}};
  }

 private:
  std::deque<std::pair<std::string, Request>> queue_;
  int looks_ = 0;
};

TEST(ProgressOfWork, SaysHowFarTheEvaluationsUnderWayAre) {
  const StudyFolder folder;
  WorkOptions telling;
  telling.folder = folder / "work";
  telling.command_line = "count";
  telling.make_executor = [] { return std::make_unique<Telling>(); };
  telling.log_interval = std::chrono::milliseconds(0);
  std::vector<double> done;
  std::vector<std::string> told;
  telling.progress = [&](const WorkProgress& progress) {
    done.push_back(static_cast<double>(progress.known) + progress.under_way);
    told.push_back(progress.simulation);
  };
  Counting campaign("a", 2, telling);
  testing::internal::CaptureStderr();
  campaign.run();
  const std::string log = testing::internal::GetCapturedStderr();
  EXPECT_THAT(done, ElementsAre(0.0, 0.25, 0.5, 1.0, 1.0, 1.25, 1.5, 2.0));
  EXPECT_THAT(told, ElementsAre("", "strain 1 %", "strain 2 %", "", "", "strain 1 %", "strain 2 %", ""));
  EXPECT_THAT(log, HasSubstr("under way since 2 min 00 s: 0: strain 2 %\n"));
}

}  // namespace
}  // namespace perfora::optimize
