// What is here: the trials of other numbers of threads and what is concluded from them.
#include "solver/thread_choice.h"

#include <algorithm>

namespace perfora::solver {
namespace {

constexpr double window_time = 0.012;                    // s that steps are timed for: a few time slices of a scheduler
constexpr std::int64_t window_steps = 4;                 // at least
constexpr double first_hold = 0.1, longest_hold = 20.0;  // s
constexpr double shortest_hold = 0.05;                   // s, however much slower the steps become
constexpr double slowed_down = 1.4;                      // over the fastest window: somebody else may have come
constexpr double clearly_faster = 0.95;                  // of the time a step takes: less is noise

}  // namespace

ThreadChoice::ThreadChoice(int most) {
  rungs_.push_back(std::max(1, most));
  if (most > 2) rungs_.push_back(most - 1);
  for (int n = most / 2; n >= 1; n /= 2)
    if (n < rungs_.back()) rungs_.push_back(n);
  hold_ = first_hold * static_cast<double>(rungs_.size() - 1);
}

void ThreadChoice::begin_window(double now) {
  window_begin_ = now;
  window_steps_ = 0;
}

bool ThreadChoice::after_step(double now) {
  if (rungs_.size() == 1) return false;
  if (window_begin_ < 0.0) {
    decided_ = now;
    begin_window(now);
    return false;
  }
  ++window_steps_;
  if (window_steps_ < window_steps || now - window_begin_ < window_time) return false;
  const double per_step = (now - window_begin_) / static_cast<double>(window_steps_);
  begin_window(now);
  const int before = threads();
  if (tried_ != rung_) {
    if (per_step < best_time_) {
      best_ = tried_;
      best_time_ = per_step;
    }
    try_next(now);
    return threads() != before;
  }
  fastest_ = fastest_ > 0.0 ? std::min(fastest_, per_step) : per_step;
  const double held = now - decided_;
  if (held <= hold_ && (per_step <= slowed_down * fastest_ || held < shortest_hold)) return false;
  best_ = rung_;
  best_time_ = clearly_faster * per_step;
  tried_ = rungs_.size();  // the round begins before the first
  try_next(now);
  return true;
}

void ThreadChoice::try_next(double now) {
  do tried_ = tried_ < rungs_.size() ? tried_ + 1 : 0;
  while (tried_ == rung_);
  if (tried_ < rungs_.size()) return;
  const double first = first_hold * static_cast<double>(rungs_.size() - 1);
  hold_ = best_ == rung_ ? std::max(hold_, std::min(longest_hold, 2.0 * hold_)) : first;
  rung_ = tried_ = best_;
  decided_ = now;
  fastest_ = 0.0;
}

}  // namespace perfora::solver
