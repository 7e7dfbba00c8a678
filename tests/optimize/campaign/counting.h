// What is here: a campaign for tests whose evaluations are numbers. What is not: tests.
#pragma once

#include <algorithm>
#include <string>
#include <utility>
#include <vector>

#include "io/files.h"
#include "optimize/campaign/campaign.h"
#include "tests/optimize/search/study_support.h"

namespace perfora::optimize {

/// Asks for the plateaus of designs "0", "1", ... until `count` are known. With `pairs` two answers make one event.
class Counting final : public Campaign {
 public:
  Counting(std::string name, int count, WorkOptions options, bool pairs = false)
      : name_(std::move(name)), count_(count), pairs_(pairs) {
    open(std::move(options));
  }

  double sum() const {
    double found = 0.0;
    for (const auto& [key, evaluation] : answers())
      if (evaluation.status == results::RunStatus::completed) found += evaluation.summary.plateau_stress;
    return found;
  }

  std::string kind() const override { return "count"; }
  std::vector<std::string> own_files() const override { return {"journal.jsonl", "sum.txt", "part-*"}; }
  nlohmann::json identity() const override { return {{"name", name_}}; }
  void check_same(const nlohmann::json& head, const std::filesystem::path& journal) const override {
    if (head.at("name") != name_) throw io::InputError({journal.string(), 0, "name"}, "another count");
  }
  void read_event(const nlohmann::json& event, Answers& answers) const override {
    if (event.at("event") != "pair") return;
    const int first = event.at("first").get<int>();
    for (int k = first; k < first + 2; ++k) answers.add(request(k).key(), plateau(request(k)));
  }
  std::vector<Asked> pending(const Answers& answers) override {
    std::vector<Asked> asked;
    for (int k = 0; k < count_; ++k)
      if (!is_known(k, answers)) asked.push_back({request(k).key(), request(k), std::to_string(k)});
    remaining_ = static_cast<int>(asked.size());
    return asked;
  }
  nlohmann::json event_of(const Asked& asked, const Answer& answer, const Answers& answers) const override {
    if (!pairs_) return Campaign::event_of(asked, answer, answers);
    const int own = std::stoi(asked.label), other = own % 2 == 0 ? own + 1 : own - 1;
    if (!is_known(other, answers)) return nullptr;
    return {{"event", "pair"}, {"first", std::min(own, other)}};
  }
  std::string on_answer(const Asked& asked, const Evaluation&) override {
    heard.push_back(asked.label);
    return {};
  }
  std::int64_t remaining() const override { return remaining_; }
  CampaignEnd finished() override { return {results::RunStatus::completed, "counted"}; }
  void write_results() override {
    written.push_back(std::string(results::status_name(status())) + ", " + reason());
    io::write_file(options().folder / "sum.txt", std::to_string(sum()));
  }

  std::vector<std::string> heard, written;

  static Request request(int k) {
    DesignFile design;
    design.design().seeds.seed = k + 1;
    return make_request(design, 0);
  }
  static Evaluation plateau(const Request& request) {
    Evaluation evaluation = completed(request);
    evaluation.summary.plateau_stress = static_cast<double>(request.design->seeds.seed - 1);
    return evaluation;
  }

 private:
  static bool is_known(int k, const Answers& answers) {
    return answer_for(request(k), request(k).key(), answers) != nullptr;
  }

  std::string name_;
  int count_, remaining_ = 0;
  bool pairs_;
};

}  // namespace perfora::optimize
