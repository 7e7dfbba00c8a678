// What is here: how many of its threads a run uses when other programs want the same cores. What is not: the clock and
// the loop that asks (run.cpp), the number that the user gives.
#pragma once

#include <cstdint>
#include <vector>

namespace perfora::solver {

/// Threads of a step wait for each other: one that a busy neighbour keeps off its core holds up all. So a run now and
/// then times a few steps with each other number of threads, 12 ms a number (four times as long one that seems faster),
/// and keeps the fastest. That happens after 0.1 s a number, then after twice as long each time that the number in use is
/// confirmed, at most every 20 s, and soon when steps become much slower and stay so. Results do not depend on the number of threads.
class ThreadChoice {
 public:
  /// Starts with `most` threads.
  explicit ThreadChoice(int most);
  int threads() const { return rungs_[tried_]; }
  /// A step is over at `now` (s, of a clock that never goes back). Returns whether threads() is another number now.
  bool after_step(double now);

 private:
  void begin_window(double now);
  /// Goes on to the next number to try, or, after the last one, to the fastest.
  void try_next(double now);

  std::vector<int> rungs_;      ///< numbers that are tried: all, all but one, halves down to one
  std::size_t rung_ = 0;        ///< in use
  std::size_t tried_ = 0;       ///< on trial; rung_: none is
  std::size_t best_ = 0;        ///< of a round of trials so far
  double best_time_ = 0.0;      ///< s a step; a number must be clearly faster than that in use
  double hold_;                 ///< s between two rounds
  double decided_ = 0.0;        ///< when the last round ended, s
  double window_begin_ = -1.0;  ///< s; before the first step: none
  std::int64_t window_steps_ = 0;
  bool seems_faster_ = false;  ///< what is on trial, which is then timed for longer
  double fastest_ = 0.0, mean_ = 0.0;  ///< of the windows since decided_, s a step; 0: none yet
  int slow_ = 0;                       ///< windows in a row that were much slower than the fastest
};

}  // namespace perfora::solver
