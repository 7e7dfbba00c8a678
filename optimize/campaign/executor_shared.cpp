// What is here: evaluations left to whoever sees the folder, on any host. What is not: those (shared_work.h), the files
// between (shared_folder.h).
#include <fmt/format.h>

#include <map>
#include <thread>

#include "io/progress.h"
#include "optimize/campaign/shared_folder.h"

namespace perfora::optimize {
namespace {

using Clock = std::chrono::steady_clock;

/// How often answers are looked for: network disks tell of nothing by themselves.
constexpr auto look_for_answers = std::chrono::milliseconds(50);
constexpr auto look_for_dead = std::chrono::seconds(10);
constexpr auto look_for_progress = std::chrono::seconds(2);

class SharedExecutor final : public Executor {
 public:
  explicit SharedExecutor(const std::filesystem::path& work) : folder_(work), looked_(Clock::now()), heard_(looked_) {
    folder_.begin();
    io::log_info(fmt::format("evaluations are left to `perfora work {}`, on any host that sees this folder",
                             std::filesystem::absolute(work).lexically_normal().string()));
  }

  ~SharedExecutor() override { stop(); }

  /// Nobody knows: as many as there is to do.
  int workers() const override { return std::max<int>(1, static_cast<int>(asked_.size())); }

  void submit(const std::string& key, const Request& request) override {
    if (key == taken_) forget();  // it failed and is tried again
    // An answer that came while nobody asked.
    if (!folder_.delivered(key, request)) folder_.publish(key, request);
    asked_.insert_or_assign(key, request);
  }

  /// By key, whatever came first: what is appended together does not depend on the clocks of hosts.
  std::optional<Answer> next(std::chrono::milliseconds timeout) override {
    forget();
    const auto end = Clock::now() + timeout;
    while (!stopped_) {
      for (const std::string& key : folder_.events())
        if (std::optional<Answer> answer = taken(key)) return answer;
      if (Clock::now() - looked_ > look_for_dead) {
        folder_.free_dead_claims();
        looked_ = Clock::now();
      }
      if (Clock::now() - heard_ > look_for_progress) {
        under_way_ = folder_.under_way();
        heard_ = Clock::now();
      }
      if (Clock::now() >= end) break;
      std::this_thread::sleep_for(look_for_answers);
    }
    return std::nullopt;
  }

  std::vector<UnderWay> under_way() const override {
    std::vector<UnderWay> asked = under_way_;
    std::erase_if(asked, [this](const UnderWay& one) { return !asked_.contains(one.key); });
    return asked;
  }

  /// What is still asked stays where it is: what others have begun is not lost, and is found when the work goes on.
  void stop() override {
    forget();
    stopped_ = true;
  }

 private:
  std::optional<Answer> taken(const std::string& key) {
    const auto asked = asked_.find(key);
    if (asked == asked_.end()) return std::nullopt;  // in the journal already
    std::optional<Answer> answer = folder_.delivered(key, asked->second);
    if (!answer) return std::nullopt;
    taken_ = key;
    asked_.erase(asked);
    return answer;
  }

  /// The answer before this one is in the journal.
  void forget() {
    if (taken_.empty()) return;
    folder_.withdraw(taken_);
    folder_.remove_event(taken_);
    taken_.clear();
  }

  SharedFolder folder_;
  std::map<std::string, Request> asked_;
  std::string taken_;
  Clock::time_point looked_, heard_;
  std::vector<UnderWay> under_way_;
  bool stopped_ = false;
};

}  // namespace

std::unique_ptr<Executor> make_shared_executor(const std::filesystem::path& work) {
  return std::make_unique<SharedExecutor>(work);
}

}  // namespace perfora::optimize
