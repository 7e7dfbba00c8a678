// What is here: `perfora show`: the summary that a file or folder written by perfora holds. What is not: how summaries
// read (summary_text.h).
#include <optional>

#include "app/commands.h"
#include "app/common.h"
#include "app/summary_text.h"
#include "io/error.h"
#include "io/hdf5.h"
#include "io/journal.h"
#include "report/text.h"

namespace perfora::app {

namespace {

namespace fs = std::filesystem;
using nlohmann::json;

struct ShowFlags {
  CommonFlags common;
  std::string file;
};

const char* what_show_reads =
    "a run, packing or checkpoint (.h5), a journal, a design or study, the folder of a study, a sweep or an ensemble, "
    "or one of "
    "perfora's JSON files";

json parse_summary(const std::string& text, const fs::path& path) {
  json object = json::parse(text, nullptr, false);
  if (object.is_discarded() || !object.is_object() || !object.value("schema", "").starts_with("perfora."))
    throw io::InputError({path.string(), 0, ""}, "holds no summary written by perfora", what_show_reads);
  return object;
}

/// The record of a result; nothing for files that have none (checkpoints, journals, designs, folders of unfinished
/// work).
std::optional<json> summary_of(const fs::path& path) {
  if (fs::is_directory(path)) {
    for (const char* name : {"result.json", "ensemble.json"})
      if (fs::exists(path / name)) return parse_summary(io::read_file(path / name), path / name);
    return std::nullopt;
  }
  if (path.extension() == ".json") return parse_summary(io::read_file(path), path);
  if (path.extension() != ".h5") return std::nullopt;
  const io::Hdf5Reader file(path);
  if (!file.has("/summary")) return std::nullopt;
  return parse_summary(file.text("/summary"), path);
}

}  // namespace

void add_show(CLI::App& program, int& exit_code) {
  auto flags = std::make_shared<ShowFlags>();
  CLI::App* command = program.add_subcommand("show", "Print the summary of a file that perfora wrote");
  command
      ->add_option("FILE", flags->file,
                   "A file that perfora wrote (.h5, .json, .jsonl, .toml), or the folder of a study, sweep or ensemble")
      ->required();
  add_common_flags(*command, flags->common, Uses::files_only);
  command->callback([flags, &exit_code] {
    flags->common.apply();
    const std::optional<json> object = summary_of(flags->file);
    if (flags->common.json && !object)
      throw io::InputError({flags->file, 0, ""}, "holds no result, so there is no JSON of it", "", "leave out --json");
    if (flags->common.json)
      print_json(*object);
    else
      print_text(object ? summary_text(*object) : report::describe_file(flags->file));
    exit_code = exit_ok;
  });
}

}  // namespace perfora::app
