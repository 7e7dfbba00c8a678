// What is here: telling files apart, reading their summary, describing those without. What is not: the lines of
// summaries (summary_text.cpp).
#include "results/describe.h"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <charconv>
#include <map>

#include "io/error.h"
#include "io/files.h"
#include "io/hdf5.h"
#include "io/journal.h"
#include "io/schema.h"
#include "io/text.h"
#include "io/text_file.h"
#include "io/toml.h"

namespace perfora::results {
namespace {

constexpr const char* readable_files =
    "a run, packing or checkpoint (.h5), a journal (.jsonl), a result (.json), a design or study (.toml), or the "
    "folder "
    "of a study, sweep, ensemble or calibration";
constexpr std::size_t checksum_digits = 8;
constexpr std::size_t longest_list = 6;

std::string line(const std::string& name, const std::string& value) {
  return value.empty() ? std::string() : fmt::format("  {:<36}{}\n", name, value);
}

[[noreturn]] void refuse_file(const std::filesystem::path& path, const std::string& problem) {
  throw io::InputError({path.string(), 0, ""}, problem, readable_files);
}

std::string describe_checkpoint(const io::Hdf5Reader& file) {
  std::string text =
      fmt::format("Checkpoint {}: go on from it with `perfora evaluate ... --resume`\n", file.path().string());
  if (file.has_attribute("/", "strain"))
    text += line("strain", io::quantity(file.attribute_double("/", "strain"), io::Dimension::ratio));
  if (file.has_attribute("/", "steps")) text += line("steps", io::count(file.attribute_int("/", "steps")));
  // Up to perfora.checkpoint/4 these stood elsewhere; such files are shown, not gone on from.
  const auto length = [&](const char* name, std::initializer_list<const char*> places) {
    for (const char* place : places)
      if (file.has(place)) return line(name, io::count(file.shape(place).at(0)));
    return std::string();
  };
  text += length("discs", {"/simulation/discs/radius", "/discs/radius"});
  text += length("bonds", {"/simulation/damage", "/bonds/damage"});
  text += length("rows of history", {"/run/history/strain_yy", "/history/strain_yy"});
  return text;
}

std::string describe_hdf5(const std::filesystem::path& path) {
  const io::Hdf5Reader file(path);
  const std::string format = file.has_attribute("/", "format") ? file.attribute_text("/", "format") : "";
  if (format.starts_with("perfora.checkpoint/")) return describe_checkpoint(file);
  if (format.starts_with("perfora.xdmf/"))
    return fmt::format("Connectivity of {}, read by ParaView with it\n", path.stem().string());
  refuse_file(path, format.empty() ? "this HDF5 file was not written by Perfora (it has no attribute `format`)"
                                   : "HDF5 file of an unknown format \"" + format + "\"");
}

bool checksum_holds(std::string_view text) {
  if (text.size() < checksum_digits + 2 || text[checksum_digits] != ' ') return false;
  std::uint32_t wanted = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + checksum_digits, wanted, 16);
  return error == std::errc() && end == text.data() + checksum_digits &&
         io::crc32(text.substr(checksum_digits + 1)) == wanted;
}

struct JournalFacts {
  std::map<std::string, int> events;  ///< how many of each kind
  nlohmann::json last;
  int bad_line = 0;  ///< first one whose checksum fails and that is not the last
  bool torn = false;
};

JournalFacts read_journal(const std::filesystem::path& path) {
  JournalFacts facts;
  const std::string all = io::read_file(path);
  int number = 0;
  for (std::size_t at = 0; at < all.size();) {
    const std::size_t end = all.find('\n', at);
    const std::string_view text = std::string_view(all).substr(at, end == std::string::npos ? end : end - at);
    at = end == std::string::npos ? all.size() : end + 1;
    ++number;
    const nlohmann::json event = checksum_holds(text)
                                     ? nlohmann::json::parse(text.substr(checksum_digits + 1), nullptr, false)
                                     : nlohmann::json();
    if (!event.is_object() || end == std::string::npos) {
      if (at < all.size() && facts.bad_line == 0) facts.bad_line = number;
      if (at >= all.size()) facts.torn = true;
      continue;
    }
    const auto kind = event.find("event");
    ++facts.events[kind != event.end() && kind->is_string() ? kind->get<std::string>() : "event"];
    facts.last = event;
  }
  return facts;
}

std::string describe_journal(const std::filesystem::path& path) {
  const JournalFacts facts = read_journal(path);
  if (facts.events.empty()) refuse_file(path, "the journal holds no whole event");
  std::string text = fmt::format("Journal {}\n", path.string());
  for (const auto& [kind, number] : facts.events) text += line(kind, io::count(number));
  if (facts.bad_line > 0) text += line("damaged", fmt::format("line {} fails its checksum", facts.bad_line));
  if (facts.torn) text += line("last line", "torn; it is dropped when the work goes on");
  const auto kind = facts.last.find("event");
  if (kind != facts.last.end() && kind->is_string()) {
    const auto reason = facts.last.find("reason");
    text += line("last event",
                 kind->get<std::string>() +
                     (reason != facts.last.end() && reason->is_string() ? ": " + reason->get<std::string>() : ""));
  }
  return text;
}

std::string kind_of_entries(const std::vector<io::Entry>& entries) {
  static const std::pair<const char*, const char*> sections[] = {
      {"study.", "study"},
      {"sweep.", "sweep"},
      {"calibrate.", "calibration"},
      {"tolerance.", "tolerance"},
      // Where the first section is misspelt, what only such files have.
      {"variables.", "study"},
      {"arms.", "study"},
      {"each.", "sweep"},
      {"grid.", "sweep"}};
  for (const auto& [section, kind] : sections)
    for (const io::Entry& entry : entries)
      if (entry.key.starts_with(section)) return kind;
  return "design";
}

std::string describe_toml(const std::filesystem::path& path) {
  const std::vector<io::Entry> entries = io::read_toml(path);
  std::string kind = kind_of_entries(entries);
  kind.front() = static_cast<char>(std::toupper(kind.front()));
  std::string text =
      fmt::format("{} {}: {} keys set; `perfora check` says what it would run\n", kind, path.string(), entries.size());
  std::string section;
  for (const io::Entry& entry : entries) {
    const std::size_t dot = entry.key.find('.');
    const std::string of = dot == std::string::npos ? "" : entry.key.substr(0, dot);
    if (of != section) text += "[" + of + "]\n";
    section = of;
    text +=
        line(dot == std::string::npos ? entry.key : entry.key.substr(dot + 1), io::readable(entry.value, longest_list));
  }
  return text;
}

std::string describe_folder(const std::filesystem::path& folder) {
  std::string text;
  for (const char* name : {"journal.jsonl", "checkpoint.h5", "checkpoint-2.h5"})
    if (std::filesystem::exists(folder / name)) text += describe_file(folder / name);
  if (text.empty()) refuse_file(folder, "the folder holds no journal, checkpoint or result");
  return text;
}

nlohmann::json parse_summary(const std::string& text, const std::filesystem::path& path) {
  nlohmann::json object = nlohmann::json::parse(text, nullptr, false);
  const auto schema = object.is_object() ? object.find("schema") : object.end();
  if (!object.is_object() || schema == object.end() || !schema->is_string() ||
      !schema->get<std::string>().starts_with("perfora."))
    refuse_file(path, "holds no summary written by perfora");
  return object;
}

}  // namespace

std::optional<nlohmann::json> stored_summary(const std::filesystem::path& path) {
  if (std::filesystem::is_directory(path)) {
    for (const char* name : {"result.json", "ensemble.json", "map.json"})
      if (std::filesystem::exists(path / name)) return parse_summary(io::read_file(path / name), path / name);
    return std::nullopt;
  }
  if (path.extension() == ".json") return parse_summary(io::read_file(path), path);
  if (path.extension() != ".h5") return std::nullopt;
  const io::Hdf5Reader file(path);
  if (!file.has("/summary")) return std::nullopt;
  return parse_summary(file.text("/summary"), path);
}

std::string command_of(const std::string& kind) {
  static const std::map<std::string, std::string> commands = {{"study", "optimize"},
                                                              {"sweep", "sweep"},
                                                              {"calibration", "calibrate"},
                                                              {"tolerance", "tolerance"},
                                                              {"design", "evaluate"}};
  return "perfora " + commands.at(kind);
}

void require_kind(const std::vector<io::Entry>& entries, const std::filesystem::path& file, const std::string& kind) {
  const std::string found = kind_of_entries(entries);
  // What has no section of the others is called a design only where it has one of a design.
  const bool sure = found != "design" || std::any_of(entries.begin(), entries.end(), [](const io::Entry& entry) {
                      return entry.key.starts_with("cell.") || entry.key.starts_with("layout.");
                    });
  if (found == kind || !sure) return;
  throw io::InputError({file.string(), 0, ""}, fmt::format("this is a {}: {}", found, command_of(found)), "",
                       fmt::format("give a {} here, or run {} {}", kind, command_of(found), file.string()));
}

std::string kind_of_toml(const std::filesystem::path& path) {
  return kind_of_entries(io::read_toml(path));
}

std::string describe_file(const std::filesystem::path& path) {
  if (std::filesystem::is_directory(path)) return describe_folder(path);
  const std::string start = io::read_beginning(path, 8), extension = path.extension().string();
  if (io::is_hdf5(start)) return describe_hdf5(path);
  if (extension == ".jsonl") return describe_journal(path);
  if (extension == ".toml") return describe_toml(path);
  refuse_file(path, start.empty() ? "the file is empty" : "not a file that can be described");
}

}  // namespace perfora::results
