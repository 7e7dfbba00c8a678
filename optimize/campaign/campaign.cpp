// What is here: the course of every campaign: folder, journal, loop, end. What is not: what the kinds of work ask.
#include "optimize/campaign/campaign.h"

#include "optimize/campaign/work_folder.h"

namespace perfora::optimize {

using nlohmann::json;

Campaign::Campaign() = default;
Campaign::~Campaign() = default;

void Campaign::open(WorkOptions options) {
  prepare_work_folder(options.folder, own_files(), kind(), options.force, options.resume);
  json head = identity();
  head["event"] = kind();
  head["results_version"] = results_version;
  head["command_line"] = options.command_line;
  const std::filesystem::path journal = options.folder / "journal.jsonl";
  const bool resume = options.resume;
  bool known = false;
  begun_ = std::chrono::steady_clock::now();
  queue_ = std::make_unique<EvaluationQueue>(std::move(options), [&](const json& event, Answers& answers) {
    if (event.value("event", "") != kind()) return read_event(event, answers);
    check_same(event, journal);
    known = true;
  });
  if (!known || resume) queue_->note(head);
}

void Campaign::run() {
  begun_ = std::chrono::steady_clock::now();
  const bool done = queue_->run(*this);
  end_ = done ? finished() : stopped(queue_->interrupted() ? &*queue_->interrupted() : nullptr);
  queue_->note({{"event", end_.status == results::RunStatus::stopped ? "stop" : "finished"}, {"reason", end_.reason}});
  seconds_ = seconds();
  write_results();
}

double Campaign::seconds() const {
  if (seconds_ >= 0.0) return seconds_;
  return std::chrono::duration<double>(std::chrono::steady_clock::now() - begun_).count();
}

void Campaign::check_same(const json&, const std::filesystem::path&) const {}

void Campaign::read_event(const json&, Answers&) const {}

json Campaign::event_of(const Asked& asked, const Answer& answer, const Answers&) const {
  return evaluation_event(asked, answer);
}

CampaignEnd Campaign::stopped(const Evaluation*) {
  return {results::RunStatus::stopped, "stopped by a signal; go on with --resume"};
}

}  // namespace perfora::optimize
