// What is here: `perfora show`: the summary that a file or folder written by perfora holds. What is not: how summaries
// read (summary_text.h).
#include "app/commands.h"
#include "app/common.h"
#include "app/summary_text.h"
#include "io/error.h"
#include "io/hdf5.h"
#include "io/journal.h"

namespace perfora::app {

namespace {

namespace fs = std::filesystem;
using nlohmann::json;

struct ShowFlags {
  CommonFlags common;
  std::string file;
};

const char* what_show_reads =
    "a run R.h5, a packing P.h5, a study.h5, the folder of a study or an ensemble, or one of perfora's JSON files";

json parse_summary(const std::string& text, const fs::path& path) {
  json object = json::parse(text, nullptr, false);
  if (object.is_discarded() || !object.is_object() || !object.value("schema", "").starts_with("perfora."))
    throw io::InputError({path.string(), 0, ""}, "holds no summary written by perfora", what_show_reads);
  return object;
}

json summary_of_hdf5(const fs::path& path) {
  const io::Hdf5Reader file(path);
  if (!file.has_attribute("/", "format") || !file.has("/summary"))
    throw io::InputError({path.string(), 0, "format"}, "perfora did not write this file, or not its summary",
                         what_show_reads);
  return parse_summary(file.text("/summary"), path);
}

json summary_of_folder(const fs::path& folder) {
  for (const char* name : {"study.h5", "ensemble.json"}) {
    const fs::path path = folder / name;
    if (fs::exists(path))
      return path.extension() == ".h5" ? summary_of_hdf5(path) : parse_summary(io::read_file(path), path);
  }
  throw io::InputError({folder.string(), 0, ""}, "the folder holds neither study.h5 nor ensemble.json",
                       what_show_reads);
}

json summary_of(const fs::path& path) {
  if (fs::is_directory(path)) return summary_of_folder(path);
  if (path.extension() == ".json") return parse_summary(io::read_file(path), path);
  if (path.extension() == ".toml")
    throw io::InputError({path.string(), 0, ""}, "is a design or study, not a result", what_show_reads,
                         "use `perfora check` for it");
  return summary_of_hdf5(path);
}

}  // namespace

void add_show(CLI::App& program, int& exit_code) {
  auto flags = std::make_shared<ShowFlags>();
  CLI::App* command = program.add_subcommand("show", "Print the summary of a file that perfora wrote");
  command->add_option("FILE", flags->file, "R.h5, P.h5, study.h5, or the folder of a study or ensemble")->required();
  add_common_flags(*command, flags->common, Uses::files_only);
  command->callback([flags, &exit_code] {
    flags->common.apply();
    const json object = summary_of(flags->file);
    if (flags->common.json)
      print_json(object);
    else
      print_text(summary_text(object));
    exit_code = exit_ok;
  });
}

}  // namespace perfora::app
