// What is here: long work for Python callers: done in a thread of its own without the interpreter's lock, while the
// calling thread hands progress to a Python function and looks for Ctrl-C. What is not: the work.
#pragma once

#include <condition_variable>
#include <exception>
#include <functional>
#include <memory>
#include <mutex>
#include <optional>
#include <thread>
#include <utility>

#include "bindings/bind.h"
#include "perfora/evaluate.h"

namespace perfora::python {

/// What is between the thread of the work and the calling one. The Python function is called by the calling thread, as
/// everything else of a Python program; the work waits for its answer, so that it stops where the function says.
class Watch {
 public:
  /// `progress`: a function of a Progress, which says False to stop; or None.
  explicit Watch(py::object progress) : progress_(std::move(progress)) {}

  /// For the options of the work; empty without a function.
  ProgressCallback callback();
  std::shared_ptr<Stop> stop() const { return stop_; }

  /// In the calling thread, with the interpreter's lock: does `work` to its end. An exception of the Python function
  /// and KeyboardInterrupt stop the work, which keeps what it has, and come out then.
  void run(const std::function<void()>& work);

 private:
  bool tell(const Progress& progress);
  void answer(const Progress& progress);
  void look_for_signals();

  py::object progress_;
  std::shared_ptr<Stop> stop_ = std::make_shared<Stop>();
  std::mutex mutex_;
  std::condition_variable changed_;
  std::optional<Progress> asked_;  ///< waits for the Python function
  bool goes_on_ = true;            ///< its answer
  bool done_ = false;
  std::exception_ptr of_work_;
  std::optional<py::error_already_set> of_python_;
};

/// `work` takes the callback and the stop for its options.
template <class Work>
auto watched(py::object progress, Work&& work) {
  Watch watch(std::move(progress));
  std::optional<decltype(work(watch.callback(), watch.stop()))> result;
  watch.run([&] { result.emplace(work(watch.callback(), watch.stop())); });
  return std::move(*result);
}

}  // namespace perfora::python
