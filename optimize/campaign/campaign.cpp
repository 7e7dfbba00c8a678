// What is here: the course of every campaign: folder, journal, loop, end. What is not: what the kinds of work ask.
#include "optimize/campaign/campaign.h"

#include <fmt/format.h>

#include "io/error.h"
#include "optimize/campaign/work_folder.h"

namespace perfora::optimize {

using nlohmann::json;

namespace {

/// Results of another version of the model do not mix with those of this one.
void check_results_version(const json& head, const std::filesystem::path& journal) {
  const int there = head.value("results_version", 0);
  if (there == results_version) return;
  throw io::InputError(
      {journal.string(), 0, "results_version"},
      fmt::format("this folder holds results of version {}, and this program makes those of version {} (CHANGELOG.md)",
                  there > 0 ? std::to_string(there) : "1 or 2", results_version),
      "such a folder can be shown, plotted and correlated, but not continued",
      "start another folder with -o, or begin anew with --force");
}

}  // namespace

Campaign::Campaign() = default;
Campaign::~Campaign() = default;

void Campaign::open(WorkOptions options) {
  std::vector<std::string> files = EvaluationQueue::own_files();
  const std::vector<std::string> of_kind = own_files();
  files.insert(files.end(), of_kind.begin(), of_kind.end());
  lock_ = claim_work_folder(options.folder, files, kind(), options.force, options.resume);
  json head = identity();
  head["event"] = kind();
  head["results_version"] = results_version;
  head["command_line"] = options.command_line;
  head[run_files_kept] = options.keep_run_files;
  const std::filesystem::path journal = options.folder / "journal.jsonl";
  const bool resume = options.resume;
  bool known = false;
  begun_ = std::chrono::steady_clock::now();
  queue_ = std::make_unique<EvaluationQueue>(std::move(options), [&](const json& event, Answers& answers) {
    if (event.value("event", "") != kind()) return read_event(event, answers);
    check_results_version(event, journal);
    check_same(event, journal);
    known = true;
  });
  if (!known || resume) queue_->note(head);
}

void Campaign::run() {
  begun_ = std::chrono::steady_clock::now();
  const bool done = queue_->run(*this);
  if (!troubles().empty())
    end_ = {results::RunStatus::stopped,
            fmt::format("the surroundings failed, not the work: {}{}; go on with --resume", troubles().front(),
                        troubles().size() > 1 ? fmt::format(" (and {} more)", troubles().size() - 1) : "")};
  else
    end_ = done ? finished() : stopped(queue_->interrupted() ? &*queue_->interrupted() : nullptr);
  queue_->note({{"event", end_.status == results::RunStatus::stopped ? "stop" : "finished"}, {"reason", end_.reason}});
  seconds_ = seconds();
  write_results();
}

std::vector<std::string> Campaign::troubles() const {
  std::vector<std::string> texts;
  for (const Trouble& one : queue_->skipped()) texts.push_back(trouble_text(one) + " (left out)");
  if (queue_->trouble()) texts.push_back(trouble_text(*queue_->trouble()));
  return texts;
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
  return {results::RunStatus::stopped, options().stopped_by + "; go on with --resume"};
}

}  // namespace perfora::optimize
