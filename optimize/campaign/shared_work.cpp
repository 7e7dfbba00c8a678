// What is here: the loop of a process that evaluates for others. What is not: who asks (executor_shared.cpp).
#include "optimize/campaign/shared_work.h"

#include <thread>

#include "io/error.h"
#include "optimize/campaign/shared_folder.h"

namespace perfora::optimize {
namespace {

using Clock = std::chrono::steady_clock;

/// How often a new request is looked for.
constexpr auto look_for_requests = std::chrono::milliseconds(100);

Answer answer_of(const SharedFolder& folder, const SharedRequest& shared, const EvaluateAndTell& evaluate,
                 const SharedWorkOptions& options) {
  const auto start = Clock::now();
  auto told = start;
  const auto tell = [&](const results::Progress& progress) {
    if (options.progress) options.progress(shared.key, progress);
    const auto now = Clock::now();
    if (now - told < options.between_signs) return;
    folder.tell(shared.key, std::chrono::duration<double>(now - start).count(), progress);
    told = now;
  };
  return answered(shared.key, shared.request.replicate, [&] { return evaluate(shared.request, tell); });
}

/// True: something was evaluated, or was to be.
bool one_of(const SharedFolder& folder, const EvaluateAndTell& evaluate, const SharedWorkOptions& options) {
  for (const std::string& key : folder.keys()) {
    const std::optional<io::OutputLock> claim = folder.claim(key);
    if (!claim) continue;
    const std::optional<SharedRequest> shared = folder.read(key);  // only now: it may have been answered before
    if (!shared) continue;
    const Answer answer = answer_of(folder, *shared, evaluate, options);
    // Stopped in the middle: its run file stays, and whoever takes it next goes on there.
    if (answer.trouble.empty() && answer.evaluation.status == results::RunStatus::stopped) return true;
    folder.deliver(shared->full_key, answer);
    if (options.delivered) options.delivered(key, answer);
    return true;
  }
  return false;
}

}  // namespace

SharedEnd work_for(const std::filesystem::path& work, const EvaluateAndTell& evaluate,
                   const SharedWorkOptions& options) {
  const SharedFolder folder(work);
  bool seen = false;
  auto since = Clock::now();
  while (!options.cancellation.requested()) {
    const bool open = folder.is_open();
    if (seen && !open) return SharedEnd::finished;
    seen = seen || open;
    if (open && one_of(folder, evaluate, options)) {
      since = Clock::now();
      continue;
    }
    if (Clock::now() - since > options.patience) return SharedEnd::idle;
    std::this_thread::sleep_for(look_for_requests);
  }
  return SharedEnd::cancelled;
}

}  // namespace perfora::optimize
