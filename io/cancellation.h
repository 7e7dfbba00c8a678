// What is here: how whoever started long work asks it to stop: a source, and tokens of it that travel down with the
// options. What is not: what work does then (solver/run.h), signal handlers (app/common.h).
#pragma once

#include <atomic>
#include <memory>
#include <utility>

namespace perfora::io {

/// Says whether the work it was given to shall stop. Cheap to copy, safe to read from any thread, valid beyond its
/// source; one that was made without a source never asks for a stop.
class Cancellation {
 public:
  Cancellation() = default;
  bool requested() const { return flag_ && flag_->load(std::memory_order_relaxed); }

 private:
  friend class CancellationSource;
  using Flag = std::atomic<bool>;
  static_assert(Flag::is_always_lock_free, "a signal handler sets the flag");
  explicit Cancellation(std::shared_ptr<const Flag> flag) : flag_(std::move(flag)) {}

  std::shared_ptr<const Flag> flag_;
};

/// Owns the request to stop; there is no way back, work that is begun afterwards takes a new source.
class CancellationSource {
 public:
  CancellationSource() : flag_(std::make_shared<Cancellation::Flag>(false)) {}
  CancellationSource(const CancellationSource&) = delete;
  CancellationSource& operator=(const CancellationSource&) = delete;

  /// Asks everything that holds a token of this source to stop. Safe in a signal handler and in any thread.
  void request() noexcept { flag_->store(true, std::memory_order_relaxed); }
  Cancellation token() const { return Cancellation(flag_); }

 private:
  std::shared_ptr<Cancellation::Flag> flag_;
};

}  // namespace perfora::io
