// What is here: evaluations in this process: on threads, or on the caller's. What is not: protection from crashes
// (executor_children.cpp).
#include <condition_variable>
#include <deque>
#include <mutex>
#include <new>
#include <thread>

#include "io/cancellation.h"
#include "io/error.h"
#include "optimize/campaign/executor.h"

namespace perfora::optimize {
namespace {

double seconds_since(std::chrono::steady_clock::time_point start) {
  return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
}

class InProcessExecutor final : public Executor {
 public:
  InProcessExecutor(Evaluate evaluate, int workers) : evaluate_(std::move(evaluate)) {
    for (int k = 0; k < workers; ++k) threads_.emplace_back([this] { work(); });
  }

  ~InProcessExecutor() override { stop(); }

  int workers() const override { return static_cast<int>(threads_.size()); }

  void submit(const std::string& key, const Request& request) override {
    const std::lock_guard lock(mutex_);
    queue_.push_back({key, request});
    changed_.notify_all();
  }

  std::optional<Answer> next(std::chrono::milliseconds timeout) override {
    std::unique_lock lock(mutex_);
    changed_.wait_for(lock, timeout, [this] { return !answers_.empty() || stopping_; });
    if (answers_.empty() || stopping_) return std::nullopt;
    Answer answer = std::move(answers_.front());
    answers_.pop_front();
    return answer;
  }

  void stop() override {
    {
      const std::lock_guard lock(mutex_);
      stopping_ = true;
      queue_.clear();
      changed_.notify_all();
    }
    for (auto& thread : threads_)
      if (thread.joinable()) thread.join();
  }

 private:
  struct Job {
    std::string key;
    Request request;
  };

  void work() {
    std::unique_lock lock(mutex_);
    while (true) {
      changed_.wait(lock, [this] { return !queue_.empty() || stopping_; });
      if (stopping_) return;
      Job job = std::move(queue_.front());
      queue_.pop_front();
      lock.unlock();
      Answer answer = answered(job.key, job.request.replicate, [&] { return evaluate_(job.request); });
      lock.lock();
      answers_.push_back(std::move(answer));
      changed_.notify_all();
    }
  }

  Evaluate evaluate_;
  std::mutex mutex_;
  std::condition_variable changed_;
  std::deque<Job> queue_;
  std::deque<Answer> answers_;
  bool stopping_ = false;
  std::vector<std::thread> threads_;
};

class CallingExecutor final : public Executor {
 public:
  explicit CallingExecutor(Evaluate evaluate) : evaluate_(std::move(evaluate)) {}
  int workers() const override { return 1; }
  void submit(const std::string& key, const Request& request) override { queue_.emplace_back(key, request); }
  std::optional<Answer> next(std::chrono::milliseconds) override {
    if (queue_.empty()) return std::nullopt;
    const auto [key, request] = std::move(queue_.front());
    queue_.pop_front();
    const auto start = std::chrono::steady_clock::now();
    Answer answer{key, evaluate_(request)};
    answer.seconds = seconds_since(start);
    return answer;
  }
  void stop() override { queue_.clear(); }

 private:
  Evaluate evaluate_;
  std::deque<std::pair<std::string, Request>> queue_;
};

}  // namespace

Answer answered(const std::string& key, int replicate, const std::function<Evaluation()>& evaluate) {
  Answer answer;
  answer.key = key;
  const auto start = std::chrono::steady_clock::now();
  try {
    answer.evaluation = evaluate();
  } catch (const io::InputError& error) {
    answer.evaluation = failed_evaluation(error.what(), replicate);
  } catch (const io::Cancelled&) {
    answer.evaluation.status = results::RunStatus::stopped;
  } catch (const std::bad_alloc&) {
    answer.trouble = "out of memory";
  } catch (const std::exception& error) {
    answer.trouble = error.what();
  }
  answer.seconds = seconds_since(start);
  return answer;
}

std::unique_ptr<Executor> make_calling_executor(Evaluate evaluate) {
  return std::make_unique<CallingExecutor>(std::move(evaluate));
}

std::unique_ptr<Executor> make_in_process_executor(Evaluate evaluate, int workers) {
  return std::make_unique<InProcessExecutor>(std::move(evaluate), workers);
}

}  // namespace perfora::optimize
