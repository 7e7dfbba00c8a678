// What is here: journals and result files looked at from outside. What is not: writing them (optimize/campaign/).
#include "results/campaign_folder.h"

#include <fstream>
#include <map>

#include "io/files.h"

namespace perfora::results {

using nlohmann::json;
namespace fs = std::filesystem;

std::vector<json> journal_events(const fs::path& folder) {
  std::vector<json> events;
  std::ifstream journal(folder / "journal.jsonl", std::ios::binary);
  for (std::string line; std::getline(journal, line);) {
    json event = json::parse(line.substr(std::min(line.size(), line.find('{'))), nullptr, false);
    if (!event.is_object()) break;
    events.push_back(std::move(event));
  }
  return events;
}

std::string kind_in_journal(const fs::path& folder) {
  std::ifstream journal(folder / "journal.jsonl", std::ios::binary);
  std::string line;
  std::getline(journal, line);
  const json first = json::parse(line.substr(std::min(line.size(), line.find('{'))), nullptr, false);
  return first.is_object() ? first.value("event", "") : std::string();
}

std::string campaign_kind(const fs::path& folder) {
  if (std::string kind = kind_in_journal(folder); !kind.empty()) return kind;
  static const std::map<std::string, std::string> kinds = {{"perfora.optimize/1", "study"},
                                                           {"perfora.sweep/1", "sweep"},
                                                           {"perfora.ensemble/1", "ensemble"},
                                                           {"perfora.calibrate/1", "calibration"}};
  for (const char* name : {"result.json", "ensemble.json"}) {
    if (!fs::exists(folder / name)) continue;
    const json result = json::parse(io::read_file(folder / name), nullptr, false);
    const auto kind = kinds.find(result.is_object() ? result.value("schema", "") : "");
    if (kind != kinds.end()) return kind->second;
  }
  return {};
}

std::string campaign_title(const fs::path& folder) {
  std::string title;
  for (const json& event : journal_events(folder))
    if (event.contains("file")) title = fs::path(event.value("file", "")).stem().string();
  if (!title.empty()) return title;
  const fs::path whole = fs::absolute(folder).lexically_normal();
  return (whole.has_filename() ? whole : whole.parent_path()).filename().string();
}

}  // namespace perfora::results
