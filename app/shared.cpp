// What is here: `perfora work`, `ask` and `tell`: evaluations for a folder of work whose `--shared` command runs
// elsewhere, on this host or another that sees the disk. What is not: the files between
// (optimize/campaign/shared_folder.h), who asks (app/workers.cpp).
#include <fmt/format.h>

#include <chrono>
#include <optional>
#include <sstream>
#include <thread>

#include "app/commands.h"
#include "app/common.h"
#include "io/error.h"
#include "io/files.h"
#include "io/text.h"
#include "optimize/campaign/shared_folder.h"
#include "optimize/campaign/shared_work.h"
#include "optimize/campaign/worker_record.h"
#include "optimize/evaluate/answers.h"
#include "results/campaign_folder.h"

namespace perfora::app {

namespace {

namespace fs = std::filesystem;
using nlohmann::json;
using optimize::SharedFolder;

struct SharedFlags {
  CommonFlags common;
  std::string folder, job, answer, output;
  double wait = 600.0;  ///< s
  bool again = false;
};

/// Whether the work of a folder has ended; waiting for it makes no sense then.
bool has_finished(const fs::path& folder) {
  const std::vector<json> events = results::journal_events(folder);
  return !events.empty() && events.back().at("event") == "finished";
}

/// Whoever evaluates may be there before whoever asks; a folder that has not come in time is a mistake in the name.
void require_folder(const fs::path& folder) {
  if (!fs::is_directory(folder))
    throw io::InputError({folder.string(), 0, ""}, "there is no such folder",
                         "the folder of work that runs with --shared is wanted", "check the path");
}

int work(const SharedFlags& flags) {
  const double memory = flags.common.memory_allowed();
  const int threads = flags.common.thread_count(1);
  if (!SharedFolder(flags.folder).is_open() && has_finished(flags.folder)) {
    io::log_info(flags.folder + ": the work has finished; nothing is left to evaluate");
    return exit_ok;
  }
  int evaluated = 0;
  std::optional<ProgressLine> line;  // of the evaluation under way
  optimize::SharedWorkOptions options;
  options.patience = std::chrono::duration<double>(flags.wait);
  options.cancellation = stop_token();
  options.progress = [&](const std::string& key, const results::Progress& progress) {
    // A line of 80 characters has no room for a whole key beside strain and stress.
    if (!line) line.emplace(key.substr(0, 8), flags.common.quiet);
    line->update(progress.fraction, progress.text);
  };
  options.delivered = [&](const std::string& key, const optimize::Answer& answer) {
    ++evaluated;
    line.reset();
    io::log_info(fmt::format("{}: {}, {}", key,
                             answer.trouble.empty() ? results::status_name(answer.evaluation.status) : answer.trouble,
                             io::duration(answer.seconds)));
  };
  const optimize::SharedEnd end = optimize::work_for(
      flags.folder,
      [&](const optimize::Request& request, const results::ProgressCallback& progress) {
        return optimize::evaluate_request(request, threads, stop_token(), memory, progress);
      },
      options);
  switch (end) {
    case optimize::SharedEnd::finished:
      io::log_info(fmt::format("{}: the work has finished; {} evaluations were made here", flags.folder, evaluated));
      return exit_ok;
    case optimize::SharedEnd::idle:
      require_folder(flags.folder);
      io::log_warning(
          fmt::format("{}: nothing to evaluate for {}; `perfora optimize ... --shared --resume` asks for "
                      "more",
                      flags.folder, io::duration(flags.wait)));
      return exit_stopped;
    case optimize::SharedEnd::cancelled:
      break;
  }
  io::log_warning("stopped; what was under way is left to others");
  return exit_stopped;
}

int ask(const SharedFlags& flags) {
  using Clock = std::chrono::steady_clock;
  const SharedFolder folder(flags.folder);
  const auto end = Clock::now() + std::chrono::duration<double>(flags.wait);
  while (true) {
    for (const std::string& key : folder.keys()) {
      if (!folder.claim_for_later(key, flags.again)) continue;
      const auto shared = folder.read(key);
      if (!shared) {
        folder.release(key);
        continue;
      }
      const std::string line = optimize::to_line(*shared) + "\n";
      if (flags.output.empty())
        print_text(line);
      else
        io::write_file(flags.output, line);
      return exit_ok;
    }
    const bool waits = Clock::now() < end && !stop_token().requested();
    if (!waits) require_folder(flags.folder);
    if (!folder.is_open() && (!waits || has_finished(flags.folder))) {
      io::log_info(flags.folder + ": nobody asks for anything");
      return has_finished(flags.folder) ? exit_ok : exit_stopped;
    }
    if (!waits) return exit_stopped;
    std::this_thread::sleep_for(std::chrono::milliseconds(100));
  }
}

/// The evaluation among the lines of `perfora worker`, which also tells that it is alive.
json evaluation_in(const fs::path& path) {
  std::istringstream lines(io::read_file(path));
  json found;
  for (std::string line; std::getline(lines, line);) {
    const json record = json::parse(line, nullptr, false);
    if (record.is_object() && !optimize::is_sign_of_life(record)) found = record;
  }
  if (!found.is_object())
    throw io::InputError({path.string(), 0, ""}, "holds no evaluation",
                         "what `perfora worker` printed for the request, a line", "evaluate the request again");
  return found;
}

int tell(const SharedFlags& flags) {
  const SharedFolder folder(flags.folder);
  if (!folder.is_open())
    throw io::InputError({flags.folder, 0, ""}, "nobody asks for anything in this folder", "",
                         "start `perfora optimize STUDY -o DIR --shared`, with --resume where it was begun");
  optimize::Answer answer;
  std::optional<optimize::SharedRequest> shared;
  try {
    shared = optimize::shared_request_from_json(json::parse(io::read_file(flags.job)));
  } catch (const json::exception&) {
    throw io::InputError({flags.job, 0, ""}, "is no request", "what `perfora ask` printed", "ask again");
  }
  answer.key = shared->key;
  const json record = evaluation_in(flags.answer);
  try {
    optimize::take_record(record, answer);
  } catch (const std::exception& error) {
    throw io::InputError({flags.answer, 0, ""}, fmt::format("is no evaluation: {}", error.what()),
                         "what `perfora worker` printed for the request", "evaluate the request again");
  }
  if (answer.trouble.empty() && (answer.evaluation.status == results::RunStatus::stopped ||
                                 answer.evaluation.replicate != shared->request.replicate ||
                                 !optimize::is_answer(answer.evaluation, shared->request)))
    throw io::InputError({flags.answer, 0, ""}, "is not the evaluation of this request, or was stopped", "",
                         "give the answer to the request in " + flags.job);
  answer.seconds = answer.evaluation.performance.seconds;
  folder.deliver(shared->full_key, answer);
  folder.release(shared->key);
  return exit_ok;
}

CLI::App* add(CLI::App& program, const char* name, const char* what, SharedFlags& flags) {
  CLI::App* command = program.add_subcommand(name, what);
  command->add_option("DIR", flags.folder, "Folder of the work, whose command runs with --shared")->required();
  return command;
}

void add_wait(CLI::App& command, SharedFlags& flags) {
  command.add_option("--wait", flags.wait, "How long to wait for something to do (default: 600)")
      ->check(positive_number(true))
      ->type_name("SECONDS");
}

}  // namespace

void add_shared(CLI::App& program, int& exit_code) {
  auto of_work = std::make_shared<SharedFlags>();
  CLI::App* command = add(program, "work", "Evaluate what a folder of work asks, beside others on any host", *of_work);
  add_wait(*command, *of_work);
  add_common_flags(*command, of_work->common, Uses::files_only);
  command->callback([of_work, &exit_code] {
    of_work->common.apply();
    exit_code = work(*of_work);
  });

  auto of_ask = std::make_shared<SharedFlags>();
  of_ask->wait = 0.0;
  command = add(program, "ask", "Take one request of a folder of work, to be evaluated by other means", *of_ask);
  command->add_option("-o,--output", of_ask->output, "File for the request (default: standard output)")
      ->type_name("JOB.json");
  command->add_flag("--again", of_ask->again, "Also one that was taken before and not answered");
  command->add_option("--wait", of_ask->wait, "How long to wait for a request (default: not at all)")
      ->check(positive_number(true))
      ->type_name("SECONDS");
  add_common_flags(*command, of_ask->common, Uses::files_only);
  command->callback([of_ask, &exit_code] {
    of_ask->common.apply();
    exit_code = ask(*of_ask);
  });

  auto of_tell = std::make_shared<SharedFlags>();
  command = add(program, "tell", "Give a folder of work the evaluation of a request that `perfora ask` took", *of_tell);
  command->add_option("JOB", of_tell->job, "The request, as `perfora ask` gave it")->required();
  command->add_option("ANSWER", of_tell->answer, "What `perfora worker` printed for it")->required();
  add_common_flags(*command, of_tell->common, Uses::files_only);
  command->callback([of_tell, &exit_code] {
    of_tell->common.apply();
    exit_code = tell(*of_tell);
  });
}

}  // namespace perfora::app
