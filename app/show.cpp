// What is here: `perfora show`: the summary that a file or folder written by perfora holds. What is not: finding it
// (results/describe.h), how it reads (results/summary_text.h).
#include <optional>

#include "app/commands.h"
#include "app/common.h"
#include "io/error.h"
#include "results/describe.h"

namespace perfora::app {

namespace {

using nlohmann::json;

struct ShowFlags {
  CommonFlags common;
  std::string file;
};

}  // namespace

void add_show(CLI::App& program, int& exit_code) {
  auto flags = std::make_shared<ShowFlags>();
  CLI::App* command = program.add_subcommand("show", "Print the summary of a file that perfora wrote");
  command
      ->add_option(
          "FILE", flags->file,
          "A file that perfora wrote (.h5, .json, .jsonl, .toml), or the folder of a study, sweep, ensemble or "
          "calibration")
      ->required();
  add_common_flags(*command, flags->common, Uses::files_only);
  command->callback([flags, &exit_code] {
    flags->common.apply();
    const std::optional<json> object = results::stored_summary(flags->file);
    if (flags->common.json && !object)
      throw io::InputError({flags->file, 0, ""}, "holds no result, so there is no JSON of it", "", "leave out --json");
    if (object) {
      print_record(*object, flags->common.json, flags->file);
      if (const auto told = object->find("warnings"); told != object->end() && told->is_array() && !flags->common.json)
        for (const json& one : *told)
          if (one.is_string()) io::log_warning(one.get<std::string>());
    } else
      print_text(results::describe_file(flags->file));
    exit_code = exit_ok;
  });
}

}  // namespace perfora::app
