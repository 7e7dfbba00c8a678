// What is here: files of requests, claims and answers. What is not: their use.
#include "optimize/campaign/shared_folder.h"

#include <algorithm>
#include <cerrno>
#include <system_error>

#include "io/error.h"
#include "io/files.h"
#include "io/litter.h"
#include "optimize/campaign/worker_record.h"

namespace perfora::optimize {
namespace {

namespace fs = std::filesystem;
using nlohmann::json;

/// Names of the whole files of a folder, without their ending, sorted.
std::vector<std::string> names_in(const fs::path& folder) {
  std::vector<std::string> found;
  std::error_code ignored;
  for (const fs::directory_entry& entry : fs::directory_iterator(folder, ignored))
    if (entry.path().extension() == ".json") found.push_back(entry.path().stem().string());
  std::sort(found.begin(), found.end());
  return found;
}

/// Nothing where it went in between, or where a network disk fails: whoever looks next tries again.
std::optional<std::string> read_if_there(const fs::path& path) {
  try {
    return io::read_file(path);
  } catch (const io::InputError&) {
    return std::nullopt;
  }
}

/// Discarded, too, where it is no JSON.
json read_json(const fs::path& path) {
  const std::optional<std::string> text = read_if_there(path);
  return text ? json::parse(*text, nullptr, false) : json(json::value_t::discarded);
}

/// A file that appears whole. False: there is one.
bool made_exclusively(const fs::path& path, const std::string& text) {
  const fs::path temporary = io::temporary_name(path);
  const io::Litter litter(temporary);
  io::write_file(temporary, text);
  const int error = io::name_exclusively(temporary, path);
  std::error_code ignored;
  fs::remove(temporary, ignored);
  if (error != 0 && error != EEXIST) io::fail_writing(path, error);
  return error == 0;
}

}  // namespace

std::string to_line(const SharedRequest& shared) {
  json record = to_json(shared.request);
  record["key"] = shared.key;
  record["full_key"] = shared.full_key;
  return record.dump();
}

SharedRequest shared_request_from_json(const json& record) {
  return {record.at("key").get<std::string>(), record.at("full_key").get<std::string>(), request_from_json(record)};
}

SharedFolder::SharedFolder(fs::path work) : work_(std::move(work)), shared_(work_ / folder_name) {}

void SharedFolder::begin() const {
  for (const char* name : {"requests", "claims", "events", "progress"}) io::make_folders(shared_ / name);
}

void SharedFolder::publish(const std::string& key, const Request& request) const {
  SharedRequest shared{key, request.full_key(), request};
  // Each host may see the disk at another place.
  if (!request.run_file.empty()) shared.request.run_file = fs::relative(request.run_file, work_);
  io::write_file(request_file(key), to_line(shared) + "\n");
}

void SharedFolder::withdraw(const std::string& key) const {
  std::error_code ignored;
  fs::remove(request_file(key), ignored);
}

std::optional<Answer> SharedFolder::delivered(const std::string& key, const Request& request) const {
  const fs::path path = event_file(key);
  std::error_code ignored;
  if (!fs::exists(path, ignored)) return std::nullopt;
  const std::optional<std::string> text = read_if_there(path);
  if (!text) return std::nullopt;
  try {
    const json event = json::parse(*text);
    if (event.at("full_key") != request.full_key()) {
      remove_event(key);
      return std::nullopt;
    }
    Answer answer{key, {}, event.at("seconds").get<double>()};
    answer.trouble = event.value("trouble", "");
    if (answer.trouble.empty()) answer.evaluation = results::evaluation_from_json(event.at("evaluation"));
    return answer;
  } catch (const std::exception& error) {
    return Answer{key, {}, 0.0, std::string("its answer cannot be read: ") + error.what()};
  }
}

void SharedFolder::remove_event(const std::string& key) const {
  std::error_code ignored;
  fs::remove(event_file(key), ignored);
}

std::vector<UnderWay> SharedFolder::under_way() const {
  std::vector<UnderWay> found;
  std::error_code ignored;
  for (const std::string& key : names_in(shared_ / "progress")) {
    if (!fs::exists(io::lock_file(claimed(key)), ignored)) continue;  // whoever told it has ended
    const json sign = read_json(progress_file(key));
    if (is_sign_of_life(sign)) found.push_back({key, sign.value("seconds", 0.0), told_by(sign)});
  }
  return found;
}

void SharedFolder::tell(const std::string& key, double seconds, const results::Progress& progress) const {
  json sign = sign_of_life(progress);
  sign["seconds"] = seconds;
  try {
    io::write_file(progress_file(key), sign.dump(-1, ' ', false, json::error_handler_t::replace) + "\n");
  } catch (const std::exception&) {  // The work goes on; its answer is what has to arrive.
  }
}

void SharedFolder::free_dead_claims() const {
  std::error_code ignored;
  for (const fs::directory_entry& entry : fs::directory_iterator(shared_ / "claims", ignored)) {
    if (entry.path().extension() != ".lock") continue;
    try {
      const io::OutputLock taken(fs::path(entry.path()).replace_extension());  // goes at once
    } catch (const io::InputError&) {  // held, by a process that lives or may live
    }
  }
}

void SharedFolder::end() const {
  std::error_code ignored;
  fs::remove_all(shared_, ignored);
}

std::vector<std::string> SharedFolder::events() const {
  return names_in(shared_ / "events");
}

bool SharedFolder::is_open() const {
  std::error_code ignored;
  return fs::is_directory(shared_, ignored);
}

std::vector<std::string> SharedFolder::keys() const {
  return names_in(shared_ / "requests");
}

std::optional<SharedRequest> SharedFolder::read(const std::string& key) const {
  std::error_code ignored;
  if (fs::exists(event_file(key), ignored)) {
    withdraw(key);  // whoever answered was ended before it did
    return std::nullopt;
  }
  const json record = read_json(request_file(key));
  if (!record.is_object()) return std::nullopt;
  SharedRequest shared = shared_request_from_json(record);
  if (!shared.request.run_file.empty()) shared.request.run_file = fs::absolute(work_ / shared.request.run_file);
  return shared;
}

std::optional<io::OutputLock> SharedFolder::claim(const std::string& key) const {
  try {
    return io::OutputLock(claimed(key));
  } catch (const io::InputError&) {  // somebody else has it, or all is over
    return std::nullopt;
  }
}

bool SharedFolder::claim_for_later(const std::string& key, bool again) const {
  const fs::path lock = io::lock_file(claimed(key));
  std::error_code ignored;
  if (again) fs::remove(lock, ignored);
  // No process: only an answer, or the word of the user, takes it away.
  return made_exclusively(lock, json{{"host", "a later answer"}, {"process", 0}}.dump() + "\n");
}

void SharedFolder::deliver(const std::string& full_key, const Answer& answer) const {
  json event = {{"key", answer.key}, {"full_key", full_key}, {"seconds", answer.seconds}};
  if (answer.trouble.empty())
    event["evaluation"] = results::to_json(answer.evaluation, true);
  else
    event["trouble"] = answer.trouble;
  io::write_file(event_file(answer.key), event.dump(-1, ' ', false, json::error_handler_t::replace) + "\n");
  std::error_code ignored;
  fs::remove(progress_file(answer.key), ignored);
  withdraw(answer.key);
}

void SharedFolder::release(const std::string& key) const {
  std::error_code ignored;
  fs::remove(io::lock_file(claimed(key)), ignored);
}

}  // namespace perfora::optimize
