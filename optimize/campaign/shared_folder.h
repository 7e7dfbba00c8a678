// What is here: the folder in which evaluations pass between the process that asks for them and others, on any host
// that sees the disk: requests, claims, answers, a file each. What is not: who asks (executor_shared.cpp), who
// evaluates (shared_work.h).
#pragma once

#include <filesystem>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <vector>

#include "io/lock.h"
#include "optimize/campaign/executor.h"

namespace perfora::optimize {

/// One request that stands in the folder.
struct SharedRequest {
  std::string key, full_key;  ///< of the request
  Request request;            ///< with run_file below this process's path of the folder
};

/// DIR/shared of a folder of work:
///   requests/KEY.json     asked, not answered; written by the one process that holds the lock of the journal
///   claims/KEY.lock       somebody evaluates it: a lock (io/lock.h), or a file that `perfora ask` made
///   events/KEY.json       an answer, renamed into place when it is whole; the holder of the journal appends it, then
///                         removes it
///   progress/KEY.json     how far the evaluation has come; replaced every few seconds by whoever has the claim
/// Nothing is changed in place, and an answer that is read twice is the same twice.
class SharedFolder {
 public:
  static constexpr const char* folder_name = "shared";
  /// `work`: the folder with the journal.
  explicit SharedFolder(std::filesystem::path work);

  // For the process that asks.
  void begin() const;  ///< makes the folders
  void publish(const std::string& key, const Request& request) const;
  void withdraw(const std::string& key) const;
  /// The answer of a request, if it is there; one to another request of the same key goes.
  std::vector<std::string> events() const;  ///< keys of the answers that are there, sorted
  std::optional<Answer> delivered(const std::string& key, const Request& request) const;
  void remove_event(const std::string& key) const;
  /// What is evaluated at present, as far as those who evaluate tell.
  std::vector<UnderWay> under_way() const;
  /// Claims of processes of this host that have ended go, so that others can take what they had.
  void free_dead_claims() const;
  void end() const;  ///< removes all of it, once nothing is asked any more

  // For those that evaluate.
  bool is_open() const;                   ///< there is a process that asks, or there was one that was stopped
  std::vector<std::string> keys() const;  ///< of what is asked, sorted
  /// A request that has no answer yet.
  std::optional<SharedRequest> read(const std::string& key) const;
  /// Holds a request for this process; nothing where it is held already or answered.
  std::optional<io::OutputLock> claim(const std::string& key) const;
  /// Holds it beyond the end of this process, until it is answered. `again`: also what is held already.
  bool claim_for_later(const std::string& key, bool again) const;
  /// Tells how far a request that this process holds has come, `seconds` of wall time after it was taken. What cannot
  /// be written is not told.
  void tell(const std::string& key, double seconds, const results::Progress& progress) const;
  /// Writes the answer, then takes the request away. `full_key`: of the request that it answers.
  void deliver(const std::string& full_key, const Answer& answer) const;
  /// Ends what claim_for_later() began.
  void release(const std::string& key) const;

 private:
  std::filesystem::path request_file(const std::string& key) const { return shared_ / "requests" / (key + ".json"); }
  std::filesystem::path event_file(const std::string& key) const { return shared_ / "events" / (key + ".json"); }
  std::filesystem::path progress_file(const std::string& key) const { return shared_ / "progress" / (key + ".json"); }
  std::filesystem::path claimed(const std::string& key) const { return shared_ / "claims" / key; }

  std::filesystem::path work_, shared_;
};

/// One line of JSON: {"key", "full_key"} and the form of the request (request.h), which `perfora worker` takes.
std::string to_line(const SharedRequest& shared);
/// Throws nlohmann::json::exception, io::InputError.
SharedRequest shared_request_from_json(const nlohmann::json& record);

/// Publishes what it is asked for in DIR/shared and waits for the answers of others.
std::unique_ptr<Executor> make_shared_executor(const std::filesystem::path& work);

}  // namespace perfora::optimize
