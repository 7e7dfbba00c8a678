// What is here: requests and records as messages of MPI, a line of JSON each, as child processes have them. What is
// not: what a record says (worker_record.h), whether a request is asked again (evaluation_queue.cpp).
#include "optimize/campaign/executor_mpi.h"

#include <fmt/format.h>
#include <mpi.h>

#include <algorithm>
#include <condition_variable>
#include <deque>
#include <mutex>
#include <set>
#include <thread>

#include "io/error.h"
#include "io/progress.h"
#include "optimize/campaign/time_limit.h"
#include "optimize/campaign/worker_record.h"

namespace perfora::optimize {
namespace {

using Clock = std::chrono::steady_clock;
using nlohmann::json;

/// What a message is.
enum Tag : int {
  ask_tag = 1,     ///< to a worker: {"request", "threads", "memory"}
  cancel_tag = 2,  ///< to a worker: what it evaluates is not wanted any more. Empty
  end_tag = 3,     ///< to a worker: nothing more will come. Empty
  answer_tag = 4,  ///< from a worker: a record; with "leaving": true where a signal told it to stop
  alive_tag = 5,   ///< from a worker, before its answer: a sign of life with how far it has come
};

/// Time a rank has to end an evaluation that is not wanted any more; it takes a second at most.
constexpr auto time_to_cancel = std::chrono::seconds(10);
/// MPI waits by asking again and again, and would take a whole processor for it: both sides look this often instead.
/// Evaluations take a second to hours.
constexpr auto between_looks = std::chrono::milliseconds(2);
/// How often a worker tells how far it has come.
constexpr auto between_signs = std::chrono::seconds(1);

void send_text(const std::string& text, int rank, Tag tag) {
  MPI_Send(text.data(), static_cast<int>(text.size()), MPI_CHAR, rank, tag, MPI_COMM_WORLD);
}

struct Message {
  int rank = 0, tag = 0;
  std::string text;
};

/// A message that has come, of this rank and tag, or any (MPI_ANY_SOURCE, MPI_ANY_TAG).
std::optional<Message> receive_message(int rank, int tag) {
  int there = 0;
  MPI_Status status;
  MPI_Iprobe(rank, tag, MPI_COMM_WORLD, &there, &status);
  if (!there) return std::nullopt;
  int size = 0;
  MPI_Get_count(&status, MPI_CHAR, &size);
  Message message{status.MPI_SOURCE, status.MPI_TAG, std::string(static_cast<std::size_t>(size), ' ')};
  MPI_Recv(message.text.data(), size, MPI_CHAR, message.rank, message.tag, MPI_COMM_WORLD, MPI_STATUS_IGNORE);
  return message;
}

std::string to_text(const json& record) {
  return record.dump(-1, ' ', false, json::error_handler_t::replace);
}

/// Evaluates in a thread of its own, so that this one hears when the evaluation is not wanted any more, and tells how
/// far it has come.
WorkerRecord evaluate_and_listen(const json& asked, const io::Cancellation& stop) {
  io::CancellationSource source;
  std::mutex mutex;
  std::condition_variable changed;
  bool done = false;
  results::Progress progress;
  WorkerRecord said;
  const auto note = [&](const results::Progress& now) {
    const std::lock_guard guard(mutex);
    progress = now;
  };
  std::thread thread([&] {
    WorkerRecord made = evaluate_record(asked.at("request"), asked.at("threads").get<int>(), source.token(),
                                        asked.at("memory").get<double>(), note);
    const std::lock_guard guard(mutex);
    said = std::move(made);
    done = true;
    changed.notify_all();
  });
  {
    auto told = Clock::now();
    std::unique_lock guard(mutex);
    while (!changed.wait_for(guard, between_looks, [&] { return done; })) {
      const bool tells = Clock::now() - told >= between_signs;
      const std::string sign = tells ? to_text(sign_of_life(progress)) : "";
      guard.unlock();
      if (stop.requested() || receive_message(0, cancel_tag)) source.request();
      if (tells) {
        send_text(sign, 0, alive_tag);
        told = Clock::now();
      }
      guard.lock();
    }
  }
  thread.join();
  return said;
}

class MpiExecutor final : public Executor {
 public:
  MpiExecutor(MpiJob& job, const MpiWorkers& wanted) : job_(job), wanted_(wanted) {
    const int others = job.ranks() - 1;
    if (others < 1)
      throw io::InputError({}, "perfora-mpi has one rank, which asks, and none that evaluates", "2 ranks and more",
                           "start it as `mpirun -n 4 perfora-mpi ...`, or use `perfora`");
    workers_ = wanted.workers > 0 ? std::min(wanted.workers, others) : others;
    threads_ = std::max(1, wanted.threads / workers_);
    limits_ = std::make_unique<TimeLimits>(threads_);
    jobs_.resize(static_cast<std::size_t>(workers_) + 1);
    io::log_info(fmt::format("{} rank{} to evaluate, of {} thread{} each", workers_, workers_ == 1 ? "" : "s", threads_,
                             threads_ == 1 ? "" : "s"));
  }

  ~MpiExecutor() override { stop(); }

  int workers() const override { return workers_; }

  void submit(const std::string& key, const Request& request) override { queue_.push_back({key, request}); }

  std::optional<Answer> next(std::chrono::milliseconds timeout) override {
    const auto end = Clock::now() + timeout;
    while (!stopped_) {
      hand_out();
      take_signs();
      while (const auto message = receive_message(MPI_ANY_SOURCE, answer_tag)) accept(*message);
      look_at_limits();
      if (!answers_.empty()) {
        Answer answer = std::move(answers_.front());
        answers_.pop_front();
        return answer;
      }
      if (Clock::now() >= end) return std::nullopt;
      std::this_thread::sleep_for(between_looks);
    }
    return std::nullopt;
  }

  std::vector<UnderWay> under_way() const override {
    std::vector<UnderWay> all;
    for (int rank = 1; rank <= workers_; ++rank)
      if (busy(rank)) all.push_back({at(rank).key, seconds_of(at(rank)), at(rank).progress});
    return all;
  }

  void stop() override {
    if (stopped_) return;
    stopped_ = true;
    queue_.clear();
    for (int rank = 1; rank <= workers_; ++rank)
      if (busy(rank) && !at(rank).cancelled) send_text("", rank, cancel_tag);
    const auto end = Clock::now() + time_to_cancel;
    const auto any_busy = [this] {
      for (int rank = 1; rank <= workers_; ++rank)
        if (busy(rank)) return true;
      return false;
    };
    while (any_busy() && Clock::now() < end) {
      take_signs();
      while (const auto message = receive_message(MPI_ANY_SOURCE, answer_tag)) set_state_after(*message);
      std::this_thread::sleep_for(between_looks);
    }
    for (int rank = 1; rank <= workers_; ++rank)
      if (busy(rank)) state(rank) = MpiJob::RankState::hung;
  }

 private:
  struct Job {
    std::string key;
    Request request;
    Clock::time_point since = {};
    double time_limit = 0.0;  ///< s; 0: none
    bool cancelled = false;   ///< its time limit has passed
    results::Progress progress = {};
    std::set<int> replicates = {};
  };

  MpiJob::RankState& state(int rank) { return job_.states()[static_cast<std::size_t>(rank)]; }
  bool busy(int rank) const { return job_.states()[static_cast<std::size_t>(rank)] == MpiJob::RankState::busy; }
  Job& at(int rank) { return jobs_[static_cast<std::size_t>(rank)]; }
  const Job& at(int rank) const { return jobs_[static_cast<std::size_t>(rank)]; }

  /// An idle rank: one that remembers the packing of this replicate where there is one; 0: none is idle.
  int idle_for(int replicate) {
    int found = 0;
    for (int rank = 1; rank <= workers_; ++rank) {
      if (state(rank) != MpiJob::RankState::idle) continue;
      if (at(rank).replicates.contains(replicate)) return rank;
      if (found == 0) found = rank;
    }
    return found;
  }

  void hand_out() {
    while (!queue_.empty()) {
      if (std::none_of(job_.states().begin() + 1, job_.states().begin() + 1 + workers_, [](MpiJob::RankState state) {
            return state == MpiJob::RankState::idle || state == MpiJob::RankState::busy;
          }))
        throw io::SurroundingsError("no rank of the MPI job is left to evaluate; --resume goes on");
      const int rank = idle_for(queue_.front().request.replicate);
      if (rank == 0) return;
      Job& mine = at(rank);
      auto replicates = std::move(mine.replicates);
      mine = std::move(queue_.front());
      queue_.pop_front();
      mine.replicates = std::move(replicates);
      mine.replicates.insert(mine.request.replicate);
      mine.since = Clock::now();
      mine.time_limit = wanted_.time_limit > 0.0 ? wanted_.time_limit : limits_->of(mine.request);
      state(rank) = MpiJob::RankState::busy;
      send_text(to_text({{"request", to_json(mine.request)},
                         {"threads", threads_},
                         {"memory", wanted_.memory / job_.workers_a_host()}}),
                rank, ask_tag);
    }
  }

  /// Messages of one rank come in their order, its signs before its answer: what comes while it is busy belongs to what
  /// it is at, but for one that is late by a moment.
  void take_signs() {
    while (const auto message = receive_message(MPI_ANY_SOURCE, alive_tag)) {
      // One that was under way when the work before this ended says nothing of this.
      if (message->rank > workers_ || !busy(message->rank)) continue;
      const json sign = json::parse(message->text, nullptr, false);
      if (is_sign_of_life(sign)) at(message->rank).progress = told_by(sign);
    }
  }

  /// A rank that took too long is told to end its evaluation; one that does not end it is not asked again.
  void look_at_limits() {
    for (int rank = 1; rank <= workers_; ++rank) {
      Job& mine = at(rank);
      if (!busy(rank) || mine.time_limit <= 0.0) continue;
      const double taken = seconds_of(mine);
      if (taken <= mine.time_limit) continue;
      if (!mine.cancelled) {
        mine.cancelled = true;
        send_text("", rank, cancel_tag);
      } else if (taken > mine.time_limit + std::chrono::duration<double>(time_to_cancel).count()) {
        state(rank) = MpiJob::RankState::hung;
        answers_.push_back({mine.key, {}, taken, limit_text(mine)});
      }
    }
  }

  static double seconds_of(const Job& job) { return std::chrono::duration<double>(Clock::now() - job.since).count(); }
  static std::string limit_text(const Job& job) {
    return fmt::format("the worker took more than {:.3g} s (time_limit)", job.time_limit);
  }

  /// What the rank says of itself; its record.
  json set_state_after(const Message& message) {
    json record = json::parse(message.text, nullptr, false);
    const bool leaving = record.is_object() && record.value("leaving", false);
    state(message.rank) = leaving ? MpiJob::RankState::leaving : MpiJob::RankState::idle;
    return record;
  }

  void accept(const Message& message) {
    const bool was_given_up = state(message.rank) == MpiJob::RankState::hung;
    const json record = set_state_after(message);
    if (was_given_up) return;
    const Job& mine = at(message.rank);
    Answer answer{mine.key, {}, seconds_of(mine)};
    if (state(message.rank) == MpiJob::RankState::leaving)
      answer.trouble = "the worker was told to stop";
    else if (mine.cancelled)
      answer.trouble = limit_text(mine);
    else
      try {
        take_record(record, answer);
      } catch (const std::exception& error) {
        answer.trouble = fmt::format("the worker's answer cannot be read ({})", error.what());
      }
    if (answer.trouble.empty()) limits_->learn(mine.request, answer.seconds);
    answers_.push_back(std::move(answer));
  }

  MpiJob& job_;
  MpiWorkers wanted_;
  int workers_ = 0, threads_ = 1;
  std::unique_ptr<TimeLimits> limits_;
  std::vector<Job> jobs_;  ///< by rank; that of rank 0 is not used
  std::deque<Job> queue_;
  std::deque<Answer> answers_;
  bool stopped_ = false;
};

}  // namespace

MpiJob::MpiJob() {
  int given = 0, size = 1;
  MPI_Init_thread(nullptr, nullptr, MPI_THREAD_FUNNELED, &given);
  MPI_Comm_rank(MPI_COMM_WORLD, &rank_);
  MPI_Comm_size(MPI_COMM_WORLD, &size);
  states_.resize(static_cast<std::size_t>(size), RankState::idle);
  MPI_Comm host;
  MPI_Comm_split_type(MPI_COMM_WORLD, MPI_COMM_TYPE_SHARED, rank_, MPI_INFO_NULL, &host);
  int here = rank_ == 0 ? 0 : 1;
  MPI_Allreduce(MPI_IN_PLACE, &here, 1, MPI_INT, MPI_SUM, host);
  MPI_Allreduce(&here, &workers_a_host_, 1, MPI_INT, MPI_MAX, MPI_COMM_WORLD);
  workers_a_host_ = std::max(1, workers_a_host_);
  MPI_Comm_free(&host);
}

MpiJob::~MpiJob() {
  if (rank_ == 0) {
    const auto hangs = [](RankState state) { return state == RankState::hung; };
    if (std::any_of(states_.begin(), states_.end(), hangs)) MPI_Abort(MPI_COMM_WORLD, exit_code_);
    for (int rank = 1; rank < ranks(); ++rank) send_text("", rank, end_tag);
  }
  MPI_Finalize();
}

void MpiJob::serve(const io::Cancellation& stop) {
  const auto attention = stop.attend();
  while (true) {
    const auto message = receive_message(0, MPI_ANY_TAG);
    if (!message) {
      std::this_thread::sleep_for(between_looks);
      continue;
    }
    if (message->tag == end_tag) return;
    if (message->tag != ask_tag) continue;  // It came too late: what was not wanted any more had ended.
    json record = evaluate_and_listen(json::parse(message->text), stop).record;
    if (stop.requested()) record["leaving"] = true;
    send_text(to_text(record), 0, answer_tag);
  }
}

std::unique_ptr<Executor> make_mpi_executor(MpiJob& job, const MpiWorkers& workers) {
  return std::make_unique<MpiExecutor>(job, workers);
}

}  // namespace perfora::optimize
