// What is here: journals and result files looked at from outside. What is not: writing them (optimize/campaign/).
#include "results/campaign_folder.h"
#include "results/summary_parts.h"

#include <map>
#include <sstream>

#include "io/error.h"
#include "io/files.h"
#include "io/journal.h"
#include "results/formats.h"

namespace perfora::results {

using nlohmann::json;
namespace fs = std::filesystem;

std::vector<json> journal_events(const fs::path& folder) {
  std::vector<json> events;
  const fs::path file = folder / "journal.jsonl";
  if (!fs::exists(file)) return events;
  for (const std::string& text : io::read_journal(file)) {
    events.push_back(json::parse(text, nullptr, false));
    const json& event = events.back();
    if (!event.is_object() || !event.contains("event") || !event.at("event").is_string())
      throw io::InputError({file.string(), static_cast<int>(events.size()), ""},
                           "this line of the journal is no event of perfora", "",
                           "delete this line and all after it to go on from there");
  }
  return events;
}

std::string kind_in_journal(const fs::path& folder) {
  std::error_code none;
  if (!fs::exists(folder / "journal.jsonl", none)) return {};
  constexpr std::size_t most = std::size_t{1} << 20;  // bytes; the first line names the work
  std::istringstream journal(io::read_beginning(folder / "journal.jsonl", most));
  std::string line;
  std::getline(journal, line);
  const json first = json::parse(line.substr(std::min(line.size(), line.find('{'))), nullptr, false);
  return text_in(first, "event");
}

std::string campaign_kind(const fs::path& folder) {
  if (std::string kind = kind_in_journal(folder); !kind.empty()) return kind;
  static const std::map<std::string, std::string> kinds = {{study_schema, "study"},
                                                           {sweep_schema, "sweep"},
                                                           {ensemble_schema, "ensemble"},
                                                           {calibration_schema, "calibration"}};
  for (const char* name : {"result.json", "ensemble.json"}) {
    if (!fs::exists(folder / name)) continue;
    const json result = json::parse(io::read_file(folder / name), nullptr, false);
    const auto kind = kinds.find(text_in(result, "schema"));
    if (kind != kinds.end()) return kind->second;
  }
  return {};
}

std::string campaign_title(const fs::path& folder) {
  std::string title;
  for (const json& event : journal_events(folder))
    if (const std::string file = text_in(event, "file"); !file.empty()) title = fs::path(file).stem().string();
  if (!title.empty()) return title;
  const fs::path whole = fs::absolute(folder).lexically_normal();
  return (whole.has_filename() ? whole : whole.parent_path()).filename().string();
}

}  // namespace perfora::results
