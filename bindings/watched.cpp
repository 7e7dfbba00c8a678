// What is here: the two threads of long work and what passes between them. What is not: the work.
#include "bindings/watched.h"

#include <chrono>

namespace perfora::python {

namespace {

/// How often Ctrl-C is looked for.
constexpr auto look_interval = std::chrono::milliseconds(50);

}  // namespace

ProgressCallback Watch::callback() {
  if (progress_.is_none()) return {};
  return [this](const Progress& progress) { return tell(progress); };
}

/// In the thread of the work.
bool Watch::tell(const Progress& progress) {
  std::unique_lock lock(mutex_);
  asked_ = progress;
  changed_.notify_all();
  changed_.wait(lock, [this] { return !asked_; });
  return goes_on_;
}

/// In the calling thread.
void Watch::answer(const Progress& progress) {
  if (of_python_) return;
  const py::gil_scoped_acquire locked;
  try {
    const py::object said = progress_(progress);
    // False of NumPy, too; a function that returns nothing goes on.
    if (!said.is_none() && PyObject_IsTrue(said.ptr()) == 0) goes_on_ = false;
  } catch (py::error_already_set& error) {
    of_python_.emplace(error);
    goes_on_ = false;
  }
}

void Watch::look_for_signals() {
  if (of_python_) return;
  const py::gil_scoped_acquire locked;
  if (PyErr_CheckSignals() == 0) return;
  of_python_.emplace();
  goes_on_ = false;
  stop_->request();
}

void Watch::run(const std::function<void()>& work) {
  {
    const py::gil_scoped_release released;
    std::thread thread([&] {
      std::exception_ptr thrown;
      try {
        work();
      } catch (...) {
        thrown = std::current_exception();
      }
      const std::lock_guard lock(mutex_);
      of_work_ = thrown;
      done_ = true;
      changed_.notify_all();
    });
    std::unique_lock lock(mutex_);
    while (!done_) {
      changed_.wait_for(lock, look_interval, [this] { return asked_ || done_; });
      if (done_) break;
      const std::optional<Progress> progress = asked_;
      lock.unlock();  // The Python function may take its time, and signals may run one, too.
      if (progress) answer(*progress);
      look_for_signals();
      lock.lock();
      if (!progress) continue;
      asked_.reset();
      changed_.notify_all();
    }
    lock.unlock();
    thread.join();
  }
  if (of_python_) throw py::error_already_set(std::move(*of_python_));
  if (of_work_) std::rethrow_exception(of_work_);
}

}  // namespace perfora::python
