// What is here: what the sources of this room share. What is not: the public functions.
#include "perfora/inside.h"

#include <algorithm>
#include <limits>
#include <string_view>
#include <utility>

#include "io/units.h"
#include "results/measure_table.h"

namespace perfora {

namespace {

Measure public_measure(const results::Measure& measure, const results::PackSummary& pack,
                       const results::Summary& summary) {
  return {measure.key,
          measure.label,
          std::string(io::dimension_name(measure.dimension)),
          std::string(io::si_unit(measure.dimension)),
          measure.help,
          results::value_of(measure, pack, summary)};
}

double seconds_between(std::chrono::steady_clock::time_point from, std::chrono::steady_clock::time_point to) {
  return std::chrono::duration<double>(to - from).count();
}

}  // namespace

Design Inside::design(optimize::DesignFile file) {
  Design made;
  made.content_->file = std::move(file);
  return made;
}

io::CancellationSource& Inside::source(Stop& stop) {
  return stop.content_->source;
}

const results::Evaluation& Inside::evaluation(const Evaluation& evaluation) {
  if (!evaluation.content_)
    throw io::InputError({"evaluation", 0, ""}, "was not made by the library", "",
                         "take one that evaluate(), read_run() or Evaluation::from_json() gave");
  return evaluation.content_->all;
}

Evaluation Inside::with_content(Evaluation evaluation, const results::Evaluation& all) {
  evaluation.content_ = std::make_shared<const Evaluation::Content>(Evaluation::Content{all});
  return evaluation;
}

Stop::Stop() : content_(std::make_unique<Content>()) {}
Stop::~Stop() = default;

void Stop::request() noexcept {
  content_->source.request();
}

bool Stop::requested() const noexcept {
  return content_->source.token().requested();
}

ProgressRelay::ProgressRelay(ProgressCallback callback, std::shared_ptr<Stop> stop)
    : callback_(std::move(callback)),
      stop_(stop ? std::move(stop) : std::make_shared<Stop>()),
      begun_(Clock::now()),
      part_begun_(begun_) {}

results::ProgressCallback ProgressRelay::callback() {
  if (!callback_) return {};
  return [this](const results::Progress& progress) {
    Progress told;
    told.fraction = progress.fraction;
    told.text = progress.text;
    told.strain = progress.strain;
    told.stress = progress.stress;
    tell(std::move(told));
  };
}

std::function<void(const optimize::WorkProgress&)> ProgressRelay::work_callback(const std::string& kind) {
  if (!callback_) return {};
  return [this, kind](const optimize::WorkProgress& work) {
    Progress told;
    told.finished = work.known;
    told.remaining = work.remaining;
    told.fraction = work.fraction();
    told.text = work.simulation.empty() ? kind : kind + ": " + work.simulation;
    tell(std::move(told));
  };
}

void ProgressRelay::tell(Progress progress) {
  const std::lock_guard lock(mutex_);
  if (token().requested()) return;
  const Clock::time_point now = Clock::now();
  if (last_ < 0.0 || progress.fraction < last_) {
    part_begun_ = now;
    first_ = progress.fraction;
  }
  last_ = progress.fraction;
  progress.seconds = seconds_between(begun_, now);
  if (last_ > first_) progress.seconds_left = seconds_between(part_begun_, now) * (1.0 - last_) / (last_ - first_);
  try {
    if (!callback_(progress)) stop_->request();
  } catch (...) {
    thrown_ = std::current_exception();
    stop_->request();
  }
}

void ProgressRelay::rethrow() const {
  if (thrown_) std::rethrow_exception(thrown_);
}

void refuse_negative(int replicate) {
  if (replicate < 0)
    throw io::InputError({"replicate", 0, ""}, std::to_string(replicate) + " is no replicate", "0, 1, 2, ...",
                         "they are counted from 0");
}

void refuse_resume_with_force(bool resume, bool force) {
  if (resume && force)
    throw io::InputError({"resume", 0, ""}, "resume and force exclude each other", "", "give only one of them");
}

int thread_count(int threads) {
  return optimize::workers_for(threads, 0, std::numeric_limits<int>::max());
}

Status status_of(results::RunStatus status) {
  switch (status) {
    case results::RunStatus::completed:
      return Status::completed;
    case results::RunStatus::stopped:
      return Status::stopped;
    case results::RunStatus::failed:
      return Status::failed;
  }
  return Status::failed;
}

std::vector<Measure> measures_of(const results::PackSummary& pack) {
  std::vector<Measure> found;
  for (const results::Measure& measure : results::measures())
    if (measure.of_packing()) found.push_back(public_measure(measure, pack, {}));
  return found;
}

Table table_of(const results::History& history) {
  Table table;
  for (const results::History::Column& column : results::History::columns()) {
    const std::vector<double>& values = history.*column.values;
    if (!column.internal && values.size() == history.rows())
      table.columns.push_back({column.name, column.units, values, {}});
  }
  return table;
}

Verdict verdict_in(const nlohmann::json& record) {
  const auto found = record.find("verdict");
  if (found == record.end()) return {};
  return {found->value("outcome", ""), found->value("text", ""), found->value("note", "")};
}

Evaluation public_evaluation(const results::Evaluation& evaluation, const nlohmann::json& record) {
  Evaluation made;
  made.status = status_of(evaluation.status);
  made.reason = evaluation.reason;
  made.replicate = evaluation.replicate;
  for (const results::Measure& measure : results::measures())
    made.measures.push_back(public_measure(measure, evaluation.pack, evaluation.summary));
  made.curve = table_of(evaluation.curve);
  made.seconds = evaluation.performance.seconds;
  made.verdict = verdict_in(record);
  made.record = record.dump(2);
  return Inside::with_content(std::move(made), evaluation);
}

std::string in_words_of_the_library(std::string message) {
  constexpr std::pair<std::string_view, std::string_view> words[] = {
      {" with -o", ""}, {"--resume", "`resume`"}, {"--force", "`force`"}};
  for (const auto& [flag, option] : words)
    for (std::size_t at = message.find(flag); at != std::string::npos; at = message.find(flag, at + 1)) {
      const bool of_command =
          std::count(message.begin(), message.begin() + static_cast<std::ptrdiff_t>(at), '`') % 2 == 1;
      if (!of_command) message.replace(at, flag.size(), option);
    }
  return message;
}

}  // namespace perfora
