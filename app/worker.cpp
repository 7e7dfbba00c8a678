// What is here: the hidden subcommand `worker`: one Request (JSON) a line on standard input, one Evaluation (JSON, with
// its curve) a line on standard output, until standard input ends. What is not: who starts workers
// (optimize/campaign/executor.h).
#include <iostream>
#include <string>

#include "app/commands.h"
#include "app/common.h"
#include "optimize/evaluate/request.h"

namespace perfora::app {

namespace {

/// A design that this program cannot read is a failed evaluation like one that cannot be evaluated.
optimize::Evaluation answer(const nlohmann::json& record, int threads) {
  try {
    return optimize::evaluate_request(optimize::request_from_json(record), threads, stop_token());
  } catch (const io::InputError& error) {
    return optimize::failed_evaluation(error.what(), record.at("replicate").get<int>());
  }
}

int work(int threads) {
  std::string line;
  while (std::getline(std::cin, line)) {
    if (line.empty()) continue;
    const optimize::Evaluation evaluation = answer(nlohmann::json::parse(line), threads);
    print_text(results::to_json(evaluation, true).dump() + "\n");
    // Stopped in the middle: that evaluation stands for nothing, whoever started the worker sees its status and the
    // exit code.
    if (evaluation.status == results::RunStatus::stopped) return exit_stopped;
  }
  return exit_ok;
}

}  // namespace

void add_worker(CLI::App& program, int& exit_code) {
  auto flags = std::make_shared<CommonFlags>();
  CLI::App* command = program.add_subcommand("worker", "Evaluate requests from standard input")->group("");
  add_common_flags(*command, *flags, Uses::files_only);
  command->callback([flags, &exit_code] {
    flags->apply();
    exit_code = work(flags->thread_count(1));
  });
}

}  // namespace perfora::app
