// What is here: a study turned inside out: its run waits in a thread of its own for answers that its caller gives. What
// is not: what it asks (optimize/search/driver.cpp), its folder (optimize/campaign/campaign.cpp).
#include "perfora/study.h"

#include <condition_variable>
#include <deque>
#include <map>
#include <set>
#include <thread>

#include "optimize/evaluate/answers.h"
#include "optimize/search/study_run.h"
#include "perfora/inside.h"
#include "results/describe.h"

namespace perfora {

namespace {

namespace fs = std::filesystem;

/// What the thread of the run and the callers of ask() and tell() share.
struct Exchange {
  std::mutex mutex;
  std::condition_variable changed;
  std::map<std::string, optimize::Request> open;  ///< by key: asked, not answered
  std::vector<std::string> order;                 ///< keys as they were asked
  std::set<std::string> given;                    ///< keys that ask() gave
  std::deque<optimize::Answer> told;              ///< not yet taken by the run
  bool waits = false;                             ///< the run has taken all answers and asked all that follows
  bool ended = false;
  std::exception_ptr thrown;  ///< what ended the run, where that was an exception
};

/// Leaves the evaluations to whoever calls ask() and tell().
class ToldExecutor final : public optimize::Executor {
 public:
  explicit ToldExecutor(std::shared_ptr<Exchange> exchange) : exchange_(std::move(exchange)) {}

  int workers() const override { return 1; }

  void submit(const std::string& key, const optimize::Request& request) override {
    const std::lock_guard lock(exchange_->mutex);
    optimize::Request open = request;
    open.run_file.clear();  // of this host; whoever evaluates names one of his own
    open.frames = false;
    exchange_->open[key] = std::move(open);
    exchange_->order.push_back(key);
  }

  std::optional<optimize::Answer> next(std::chrono::milliseconds timeout) override {
    std::unique_lock lock(exchange_->mutex);
    if (exchange_->told.empty()) {
      exchange_->waits = true;
      exchange_->changed.notify_all();
      exchange_->changed.wait_for(lock, timeout, [this] { return !exchange_->told.empty(); });
    }
    if (exchange_->told.empty()) return std::nullopt;
    exchange_->waits = false;
    optimize::Answer answer = std::move(exchange_->told.front());
    exchange_->told.pop_front();
    return answer;
  }

  void stop() override {}

 private:
  std::shared_ptr<Exchange> exchange_;
};

optimize::Study read_study(const fs::path& file, const StudyOptions& options) {
  refuse_resume_with_force(options.resume, options.force);
  if (options.folder.empty())
    throw io::InputError({"folder", 0, ""}, "a study keeps its journal and results in a folder, and none was given");
  if (results::kind_of_toml(file) != "study")
    throw io::InputError({file.string(), 0, ""}, "is no study", "a file with a section [study]");
  return optimize::read_study(file, options.overrides);
}

optimize::Request request_of(const std::string& text) {
  return optimize::request_from_json(nlohmann::json::parse(text));
}

}  // namespace

Design Trial::design() const {
  return at_boundary([&] { return Inside::design(optimize::DesignFile::of(*request_of(request).design, "request")); });
}

Evaluation evaluate_trial(const std::string& request, const TrialOptions& options) {
  return at_boundary([&] {
    optimize::Request asked = request_of(request);
    asked.run_file = options.run_file;
    const io::Cancellation token = options.stop ? Inside::source(*options.stop).token() : io::Cancellation();
    const results::Evaluation found = optimize::evaluate_request(asked, thread_count(options.threads), token);
    return public_evaluation(found, results::to_json(found, false));
  });
}

struct Study::Content {
  Content(const fs::path& file, const StudyOptions& options) : folder(options.folder) {
    optimize::WorkOptions work;
    work.folder = options.folder;
    work.resume = options.resume;
    work.force = options.force;
    work.cancellation = stop.token();
    work.stopped_by = "left open by the program that asks";
    work.make_executor = [shared = exchange] { return std::make_unique<ToldExecutor>(shared); };
    run = std::make_unique<optimize::StudyRun>(read_study(file, options), std::move(work));
    thread = std::thread([this] {
      std::exception_ptr thrown;
      try {
        run->run();
      } catch (...) {
        thrown = std::current_exception();
      }
      const std::lock_guard lock(exchange->mutex);
      exchange->ended = true;
      exchange->thrown = thrown;
      exchange->changed.notify_all();
    });
  }
  ~Content() { end(); }
  Content(const Content&) = delete;
  Content& operator=(const Content&) = delete;

  void end() {
    {
      // What was told is written down, and a study in which nothing is left to ask ends by itself.
      std::unique_lock lock(exchange->mutex);
      exchange->changed.wait(lock, [this] { return (exchange->waits && exchange->told.empty()) || exchange->ended; });
    }
    stop.request();
    {
      const std::lock_guard lock(exchange->mutex);
      exchange->changed.notify_all();
    }
    if (thread.joinable()) thread.join();
    run.reset();
  }

  /// Waits until the run has asked what follows from all answers. Throws what ended the run.
  std::unique_lock<std::mutex> settled() {
    std::unique_lock lock(exchange->mutex);
    exchange->changed.wait(lock, [this] { return (exchange->waits && exchange->told.empty()) || exchange->ended; });
    if (exchange->thrown) std::rethrow_exception(exchange->thrown);
    return lock;
  }

  /// Only while the run waits: it changes its plan otherwise.
  std::string label_of(const std::string& key) const {
    for (const optimize::Wanted& one : run->plan().wanted)
      if (one.key == key) return one.candidate->label;
    return {};
  }

  fs::path folder;
  io::CancellationSource stop;
  std::shared_ptr<Exchange> exchange = std::make_shared<Exchange>();
  std::unique_ptr<optimize::StudyRun> run;  ///< holds the folder
  std::thread thread;
};

Study::Study(const fs::path& file, const StudyOptions& options)
    : content_(at_boundary([&] { return std::make_unique<Content>(file, options); })) {}
Study::~Study() = default;
Study::Study(Study&& other) noexcept = default;

std::vector<Trial> Study::ask(int most, bool again) {
  return at_boundary([&] {
    const auto lock = content_->settled();
    Exchange& exchange = *content_->exchange;
    std::vector<Trial> trials;
    if (exchange.ended) return trials;
    for (const std::string& key : exchange.order) {
      if (most > 0 && trials.size() == static_cast<std::size_t>(most)) break;
      if (exchange.given.contains(key) && !again) continue;
      const optimize::Request& request = exchange.open.at(key);
      trials.push_back({key, content_->label_of(key), request.replicate, optimize::to_json(request).dump()});
      exchange.given.insert(key);
    }
    return trials;
  });
}

void Study::tell(const Trial& trial, const Evaluation& evaluation) {
  at_boundary([&] {
    const auto lock = content_->settled();
    Exchange& exchange = *content_->exchange;
    const auto open = exchange.open.find(trial.key);
    if (open == exchange.open.end()) return;
    if (exchange.ended) throw io::InputError({"study", 0, ""}, "is closed", "", "open it again with resume");
    const results::Evaluation& all = Inside::evaluation(evaluation);
    const io::Origin origin{"trial", 0, trial.label};
    if (evaluation.status == Status::stopped)
      throw io::InputError(origin, "its evaluation was stopped", "one that is finished or failed is wanted");
    if (all.replicate != open->second.replicate || !optimize::is_answer(all, open->second))
      throw io::InputError(origin, "this is the evaluation of something else", "",
                           "tell what evaluate_trial() gave for this trial");
    optimize::Answer answer{trial.key, all};
    answer.seconds = all.performance.seconds;
    exchange.told.push_back(std::move(answer));
    std::erase(exchange.order, trial.key);
    exchange.open.erase(open);
    exchange.changed.notify_all();
  });
  // When it returns, the evaluation is in the journal.
  at_boundary([&] { static_cast<void>(content_->settled()); });
}

bool Study::finished() {
  return at_boundary([&] {
    const auto lock = content_->settled();
    return content_->exchange->ended;
  });
}

Campaign Study::close() {
  return at_boundary([&] {
    content_->end();
    return read_campaign(content_->folder);
  });
}

}  // namespace perfora
