// What is here: telling files apart and describing them. What is not: the lines of JSON objects (summary_lines.cpp).
#include "report/text.h"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <fstream>
#include <map>

#include "io/error.h"
#include "io/hdf5.h"
#include "io/journal.h"
#include "io/schema.h"
#include "report/canvas.h"
#include "results/pack_file.h"
#include "results/run_file.h"

namespace perfora::report {
namespace {

constexpr const char* readable_files =
    "a run (R.h5), a packing (P.h5), a checkpoint (checkpoint.h5), a journal (journal.jsonl), a result (.json), a "
    "design or study (.toml), or the "
    "folder of a study";
constexpr const char* hdf5_signature = "\x89HDF\r\n\x1a\n";
constexpr std::size_t checksum_digits = 8;

std::string line(const std::string& name, const std::string& value) {
  return value.empty() ? std::string() : fmt::format("  {:<36}{}\n", name, value);
}

std::string millimetres(double metres) {
  return short_number(metres * 1e3, 4) + " mm";
}
std::string percent(double share) {
  return short_number(share * 100.0, 4) + " %";
}
std::string count(std::size_t number) {
  return with_thousands(static_cast<std::int64_t>(number));
}
std::string size_text(double width, double height) {
  return short_number(width * 1e3, 4) + " x " + short_number(height * 1e3, 4) + " mm";
}

[[noreturn]] void refuse(const std::filesystem::path& path, const std::string& problem) {
  throw io::InputError({path.string(), 0, ""}, problem, readable_files);
}

std::string made_by(const results::Provenance& made) {
  std::string text =
      line("program", made.program_version + (made.git_revision.empty() ? "" : " (" + made.git_revision + ")"));
  text += line("command", made.command_line);
  if (made.threads > 0)
    text += line("ran on", fmt::format("{} thread{} for {} s", made.threads, made.threads == 1 ? "" : "s",
                                       short_number(made.seconds)));
  return text;
}

std::string describe_run(const std::filesystem::path& path) {
  const results::RunResult run = results::read_run(path);
  std::string text =
      fmt::format("Run {}: {}{}\n", path.string(), run.status, run.reason.empty() ? "" : ", " + run.reason);
  text += line("block", size_text(run.width, run.height));
  text += line("perforations", count(run.layout.perforations.size()));
  text += line("discs", count(run.clipped.x.size()) + ", mean diameter " + millimetres(run.mean_diameter));
  text += line("bonds", count(run.bonds.size()) + ", broken " + count(run.events.size()));
  if (run.history.rows() > 0) {
    const std::vector<double>& strain = run.history.strain_yy;
    text += line("history", count(run.history.rows()) + " rows of " + count(run.history.filled_columns()) +
                                " columns, strain " + percent(strain.front()) + " to " + percent(strain.back()));
  }
  std::string frames = count(run.frames.size());
  if (!run.frames.empty())
    frames += ", strain " + percent(run.frames.front().strain) + " to " + percent(run.frames.back().strain);
  text += line("frames", frames);
  text += made_by(run.provenance);
  return run.summary.empty() ? text : text + "Summary\n" + summary_lines(run.summary);
}

std::string describe_pack(const std::filesystem::path& path) {
  const results::PackResult pack = results::read_pack(path);
  const geometry::PackingQuality& quality = pack.periodic.quality;
  std::string text = fmt::format("Packing {}\n", path.string());
  text += line("block", size_text(pack.periodic.width, pack.periodic.height));
  text += line("perforations", count(pack.layout.perforations.size()));
  text += line("discs", count(pack.periodic.x.size()) + " packed, " + count(pack.clipped.x.size()) +
                            " left by the perforations");
  text += line("solid fraction of the packing", percent(quality.solid_fraction));
  text += line("largest overlap / smaller diameter", short_number(quality.max_overlap_ratio, 3));
  text += line("made by", pack.periodic.key.protocol + fmt::format(", seed {}", pack.periodic.key.seed));
  text += made_by(pack.provenance);
  return pack.summary.empty() ? text : text + "Summary\n" + summary_lines(pack.summary);
}

std::string describe_checkpoint(const io::Hdf5Reader& file) {
  std::string text =
      fmt::format("Checkpoint {}: go on from it with `perfora evaluate ... --resume`\n", file.path().string());
  if (file.has_attribute("/", "strain")) text += line("strain", percent(file.attribute_double("/", "strain")));
  if (file.has_attribute("/", "steps")) text += line("steps", with_thousands(file.attribute_int("/", "steps")));
  if (file.has("/discs/radius")) text += line("discs", with_thousands(file.shape("/discs/radius").at(0)));
  if (file.has("/bonds/damage")) text += line("bonds", with_thousands(file.shape("/bonds/damage").at(0)));
  if (file.has("/history/strain_yy"))
    text += line("rows of history", with_thousands(file.shape("/history/strain_yy").at(0)));
  return text;
}

std::string describe_hdf5(const std::filesystem::path& path) {
  const io::Hdf5Reader file(path);
  const std::string format = file.has_attribute("/", "format") ? file.attribute_text("/", "format") : "";
  if (format.starts_with("perfora.run/")) return describe_run(path);
  if (format.starts_with("perfora.pack/")) return describe_pack(path);
  if (format.starts_with("perfora.checkpoint/")) return describe_checkpoint(file);
  if (format.starts_with("perfora.xdmf/"))
    return fmt::format("Connectivity of {}, read by ParaView with it\n", path.stem().string());
  refuse(path, format.empty() ? "this HDF5 file was not written by Perfora (it has no attribute `format`)"
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
  if (facts.events.empty()) refuse(path, "the journal holds no whole event");
  std::string text = fmt::format("Journal {}\n", path.string());
  for (const auto& [kind, number] : facts.events) text += line(kind, count(static_cast<std::size_t>(number)));
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

std::string describe_json(const std::filesystem::path& path) {
  const nlohmann::json object = nlohmann::json::parse(io::read_file(path), nullptr, false);
  if (!object.is_object()) refuse(path, "this JSON file is broken or holds no object");
  const auto schema = object.find("schema");
  if (schema == object.end() || !schema->is_string() || !schema->get<std::string>().starts_with("perfora."))
    refuse(path, "this JSON file was not written by Perfora (it has no key `schema` that begins with \"perfora.\")");
  return fmt::format("Result {}\n", path.string()) + summary_lines(object);
}

std::string value_text(const io::Value& value) {
  if (const bool* flag = std::get_if<bool>(&value.data)) return *flag ? "true" : "false";
  if (const std::int64_t* whole = std::get_if<std::int64_t>(&value.data)) return std::to_string(*whole);
  if (const double* real = std::get_if<double>(&value.data)) return fmt::format("{:.9g}", *real);
  if (const std::string* text = std::get_if<std::string>(&value.data)) return "\"" + *text + "\"";
  const io::ValueList& list = std::get<io::ValueList>(value.data);
  constexpr std::size_t longest_list = 6;
  if (list.size() > longest_list) return fmt::format("[{} entries]", list.size());
  std::string out;
  for (const io::Value& item : list) out += (out.empty() ? "" : ", ") + value_text(item);
  return "[" + out + "]";
}

std::string describe_toml(const std::filesystem::path& path) {
  const std::vector<io::Entry> entries = io::read_toml(path);
  const bool study = std::any_of(entries.begin(), entries.end(),
                                 [](const io::Entry& entry) { return entry.key.starts_with("study."); });
  std::string text = fmt::format("{} {}: {} keys set; `perfora check` says what it would run\n",
                                 study ? "Study" : "Design", path.string(), entries.size());
  std::string section;
  for (const io::Entry& entry : entries) {
    const std::size_t dot = entry.key.find('.');
    const std::string of = dot == std::string::npos ? "" : entry.key.substr(0, dot);
    if (of != section) text += "[" + of + "]\n";
    section = of;
    text += line(dot == std::string::npos ? entry.key : entry.key.substr(dot + 1), value_text(entry.value));
  }
  return text;
}

std::string describe_folder(const std::filesystem::path& folder) {
  std::string text;
  for (const char* name : {"result.json", "ensemble.json"})
    if (std::filesystem::exists(folder / name)) text += describe_json(folder / name);
  for (const char* name : {"journal.jsonl", "checkpoint.h5"})
    if (std::filesystem::exists(folder / name)) text += describe_file(folder / name);
  if (text.empty()) refuse(folder, "the folder holds no journal, checkpoint or result");
  return text;
}

std::string beginning_of(const std::filesystem::path& path) {
  std::ifstream file(path, std::ios::binary);
  if (!file) throw io::InputError({path.string(), 0, ""}, "the file cannot be opened", "", "check the name");
  std::string start(64, '\0');
  file.read(start.data(), static_cast<std::streamsize>(start.size()));
  start.resize(static_cast<std::size_t>(file.gcount()));
  return start;
}

}  // namespace

std::string describe_file(const std::filesystem::path& path) {
  if (std::filesystem::is_directory(path)) return describe_folder(path);
  const std::string start = beginning_of(path);
  const std::string extension = path.extension().string();
  if (start.starts_with(hdf5_signature)) return describe_hdf5(path);
  if (extension == ".jsonl") return describe_journal(path);
  if (extension == ".toml") return describe_toml(path);
  const std::size_t first = start.find_first_not_of(" \t\r\n");
  if (first != std::string::npos && start[first] == '{') return describe_json(path);
  refuse(path, start.empty() ? "the file is empty" : "not a file that can be described");
}

}  // namespace perfora::report
