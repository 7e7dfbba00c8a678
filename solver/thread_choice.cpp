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
constexpr double second_look = 4.0;                      // windows that a number which seems faster is timed for
constexpr double hopeless_time = 0.002, hopeless = 2.0;  // s, and times as slow: a trial need not go on
constexpr double memory = 0.2;  // of the mean over windows: one window in which the scheduler took the core is no rule
constexpr int slow_in_a_row = 4;  // windows, for the same reason

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
  const double elapsed = now - window_begin_, per_step = elapsed / static_cast<double>(window_steps_);
  const bool give_up = tried_ != rung_ && elapsed > hopeless_time && per_step > hopeless * best_time_;
  if (!give_up && (window_steps_ < window_steps || elapsed < (seems_faster_ ? second_look : 1.0) * window_time))
    return false;
  const int before = threads();
  if (tried_ != rung_) {
    if (per_step < best_time_ && !seems_faster_) {
      seems_faster_ = true;
      return false;
    }
    seems_faster_ = false;
    begin_window(now);
    if (per_step < best_time_) {
      best_ = tried_;
      best_time_ = per_step;
    }
    try_next(now);
    return threads() != before;
  }
  begin_window(now);
  fastest_ = fastest_ > 0.0 ? std::min(fastest_, per_step) : per_step;
  mean_ = mean_ > 0.0 ? (1.0 - memory) * mean_ + memory * per_step : per_step;
  slow_ = per_step > slowed_down * fastest_ ? slow_ + 1 : 0;
  const double held = now - decided_;
  if (held <= hold_ && (slow_ < slow_in_a_row || held < shortest_hold)) return false;
  best_ = rung_;
  best_time_ = clearly_faster * (slow_ < slow_in_a_row ? mean_ : per_step);
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
  fastest_ = mean_ = 0.0;
  slow_ = 0;
}

}  // namespace perfora::solver
