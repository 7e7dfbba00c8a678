// What is here: a few threads that share out numbered pieces of work again and again, asleep in between.
// What is not: any order between the pieces; results must not depend on it.
#pragma once

#include <algorithm>
#include <barrier>
#include <cstddef>
#include <functional>
#include <thread>
#include <vector>

namespace perfora::geometry {

/// Used instead of OpenMP because a minimiser meets ten thousand barriers a minute: the threads of libgomp spin there,
/// which on a machine with other work took seven times longer than one thread alone; these go to sleep.
class ThreadTeam {
 public:
  explicit ThreadTeam(int threads) : threads_(std::max(1, threads)), start_(threads_), done_(threads_) {
    for (int part = 1; part < threads_; ++part)
      workers_.emplace_back([this, part] {
        for (;;) {
          start_.arrive_and_wait();
          if (task_ == nullptr) return;
          (*task_)(part);
          done_.arrive_and_wait();
        }
      });
  }
  ~ThreadTeam() {
    task_ = nullptr;
    if (!workers_.empty()) start_.arrive_and_wait();
  }
  ThreadTeam(const ThreadTeam&) = delete;
  ThreadTeam& operator=(const ThreadTeam&) = delete;

  /// Calls piece(k) once for every k < count, each thread a contiguous range; returns when all are done. `piece` must
  /// not throw.
  template <class Piece>
  void for_each(std::size_t count, Piece piece) {
    const std::size_t threads = static_cast<std::size_t>(threads_);
    const std::function<void(int)> task = [&](int part) {
      const std::size_t p = static_cast<std::size_t>(part);
      for (std::size_t k = p * count / threads; k < (p + 1) * count / threads; ++k) piece(k);
    };
    if (workers_.empty()) {
      task(0);
      return;
    }
    task_ = &task;
    start_.arrive_and_wait();
    task(0);
    done_.arrive_and_wait();
  }

 private:
  int threads_;
  std::barrier<> start_, done_;
  const std::function<void(int)>* task_ = nullptr;
  std::vector<std::jthread> workers_;
};

}  // namespace perfora::geometry
