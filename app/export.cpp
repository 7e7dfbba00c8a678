// What is here: `perfora export`: R.h5 or P.h5 -> files of other programs. What is not: the formats (report/export/).
#include "app/commands.h"
#include "app/common.h"
#include "io/error.h"
#include "io/lock.h"
#include "io/units.h"
#include "report/export/registry.h"

namespace perfora::app {

namespace {

namespace fs = std::filesystem;

struct ExportFlags {
  CommonFlags common;
  std::string input, output, axis = "time", at;
  std::vector<char> wanted;  ///< by place in the list of exports; char, as CLI11 keeps references to them
};

report::ExportOptions options_of(const ExportFlags& flags) {
  report::ExportOptions options;
  options.axis = flags.axis == "strain" ? report::TimeAxis::strain : report::TimeAxis::time;
  if (!flags.at.empty()) options.at = io::parse_quantity(io::Value{flags.at}, io::Dimension::ratio, {"--at", 0, ""});
  return options;
}

std::vector<const report::Export*> chosen(const ExportFlags& flags) {
  std::vector<const report::Export*> list;
  std::string names;
  for (std::size_t k = 0; k < flags.wanted.size(); ++k) {
    if (flags.wanted[k] != 0) list.push_back(&report::exports()[k]);
    names += std::string(k == 0 ? "--" : ", --") + report::exports()[k].name;
  }
  if (list.empty())
    throw io::InputError({"export", 0, ""}, "no format is given", "one or several of " + names,
                         "say which files you want");
  return list;
}

/// "R" of "runs/R.h5" in the current folder, or what -o says without the extension of the one format.
fs::path base_of(const ExportFlags& flags, const std::vector<const report::Export*>& list) {
  if (flags.output.empty()) return fs::path(flags.input).filename().stem();
  const std::string extension = list.front()->extension;
  if (flags.output.size() > extension.size() && flags.output.ends_with(extension))
    return flags.output.substr(0, flags.output.size() - extension.size());
  return flags.output;
}

int run_export(const ExportFlags& flags) {
  flags.common.apply();
  const std::vector<const report::Export*> list = chosen(flags);
  const report::Scene scene(flags.input, options_of(flags));
  const fs::path base = base_of(flags, list);
  std::vector<io::OutputLock> locks;
  std::vector<std::string> outputs;
  for (const report::Export* one : list) {
    outputs.push_back(report::with_extension(base, one->extension).string());
    locks.push_back(io::claim_new_output(outputs.back(), flags.common.force));
    for (const std::string& other : one->others) {
      const std::string name = report::with_extension(base, other).string();
      if (other.back() == '/') {
        if (fs::exists(name) && !flags.common.force)
          throw io::InputError({name, 0, ""}, "the folder exists", "", "give another name by -o, or --force");
        continue;
      }
      outputs.push_back(name);
      locks.push_back(io::claim_new_output(name, flags.common.force));
    }
  }
  for (const report::Export* one : list) one->write(scene, base);
  if (flags.common.json)
    print_json({{"schema", "perfora.export/1"}, {"status", "completed"}, {"reason", ""}, {"outputs", outputs}});
  for (const std::string& output : outputs) io::log_info("written: " + output);
  return exit_ok;
}

}  // namespace

void add_export(CLI::App& program, int& exit_code) {
  auto flags = std::make_shared<ExportFlags>();
  CLI::App* command =
      program.add_subcommand("export", "Write a run or a packing for LAMMPS, OVITO, ParaView, ase, pandas");
  command->add_option("FILE", flags->input, "Run file R.h5 or packing file P.h5")->required();
  flags->wanted.assign(report::exports().size(), 0);
  for (std::size_t k = 0; k < flags->wanted.size(); ++k)
    command
        ->add_flag_callback(
            std::string("--") + report::exports()[k].name, [flags, k] { flags->wanted[k] = 1; },
            report::exports()[k].help)
        ->group("Formats");
  command->add_option("-o,--output", flags->output, "Name of the files without extension (default: FILE's)")
      ->type_name("BASE");
  command->add_option("--axis", flags->axis, "What stands on the time axis of the frames: time [s] or strain")
      ->check(CLI::IsMember({"time", "strain"}))
      ->capture_default_str();
  command->add_option("--at", flags->at, "Only the frame nearest to this strain, as 0.1 or \"10 %\"")
      ->type_name("STRAIN");
  add_common_flags(*command, flags->common, Uses::files_only);
  command->callback([flags, &exit_code] { exit_code = run_export(*flags); });
}

}  // namespace perfora::app
