// What is here: how whoever started long work asks it to stop: a source, and tokens of it that travel down with the
// options. What is not: what work does then (solver/run.h), signal handlers (app/common.h).
#pragma once

#include <atomic>
#include <exception>
#include <memory>
#include <utility>

namespace perfora::io {

/// Thrown where work was told to stop and has nothing to keep.
class Cancelled : public std::exception {
 public:
  const char* what() const noexcept override { return "stopped"; }
};

/// Says whether the work it was given to shall stop. Cheap to copy, safe to read from any thread, valid beyond its
/// source; one that was made without a source never asks for a stop.
class Cancellation {
  struct State {
    std::atomic<bool> requested{false};
    std::atomic<int> attentions{0};
  };
  static_assert(std::atomic<bool>::is_always_lock_free && std::atomic<int>::is_always_lock_free,
                "a signal handler reads and sets them");

 public:
  Cancellation() = default;
  bool requested() const { return state_ && state_->requested.load(std::memory_order_relaxed); }

  /// As long as one lives, somebody looks at requested() within a second, all the time.
  class Attention {
   public:
    Attention(const Attention&) = delete;
    Attention& operator=(const Attention&) = delete;
    ~Attention() {
      if (state_) --state_->attentions;
    }

   private:
    friend class Cancellation;
    explicit Attention(std::shared_ptr<State> state) : state_(std::move(state)) {
      if (state_) ++state_->attentions;
    }
    std::shared_ptr<State> state_;
  };
  [[nodiscard]] Attention attend() const { return Attention(state_); }

 private:
  friend class CancellationSource;
  explicit Cancellation(std::shared_ptr<State> state) : state_(std::move(state)) {}

  std::shared_ptr<State> state_;
};

/// Owns the request to stop; there is no way back, work that is begun afterwards takes a new source.
class CancellationSource {
 public:
  CancellationSource() : state_(std::make_shared<Cancellation::State>()) {}
  CancellationSource(const CancellationSource&) = delete;
  CancellationSource& operator=(const CancellationSource&) = delete;

  /// Asks everything that holds a token of this source to stop. Safe in a signal handler and in any thread.
  void request() noexcept { state_->requested.store(true, std::memory_order_relaxed); }
  /// Whether somebody will notice (Cancellation::attend). Safe in a signal handler.
  bool attended() const noexcept { return state_->attentions.load(std::memory_order_relaxed) > 0; }
  Cancellation token() const { return Cancellation(state_); }

 private:
  std::shared_ptr<Cancellation::State> state_;
};

}  // namespace perfora::io
