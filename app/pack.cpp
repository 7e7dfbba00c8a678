// What is here: `perfora pack`: design -> P.h5. What is not: how packings are made (geometry).
#include <fmt/format.h>

#include "app/commands.h"
#include "app/common.h"
#include "io/text.h"
#include "optimize/evaluate/pack_file.h"
#include "optimize/evaluate/run_output.h"

namespace perfora::app {

namespace {

struct PackFlags {
  CommonFlags common;
  std::string design;
  std::string output;
};

int pack(const PackFlags& flags) {
  flags.common.apply();
  const optimize::DesignFile design(flags.design, flags.common.overrides());
  const std::vector<std::string> warnings = design.validate(optimize::Purpose::block);
  check_cost(design, flags.common);
  const auto output = output_or_default(flags.output, default_name(flags.design, "-packing.h5"));
  const io::OutputLock lock = optimize::claim_pack_output(output, flags.common.force);
  log_warnings(warnings);

  ProgressLine progress("packing", flags.common.quiet);
  optimize::EvaluateOptions options;
  options.threads = flags.common.thread_count();
  options.command_line = command_line();
  options.progress = progress.callback();
  const auto [packed, performance, record] = optimize::pack_with_record(design, options, 0);
  progress.finish(fmt::format("{} discs in {}", io::count(packed.summary.discs), io::duration(performance.seconds)));

  const bool reached = packed.periodic.quality.reached;
  if (reached) optimize::write_pack_file(output, design, packed, record, command_line());
  print_record(record, flags.common.json);
  if (!reached) {
    io::log_error("the packing was not reached, nothing was written: " + packed.periodic.quality.reason);
    return exit_numerical;
  }
  io::log_info("written: " + output.string());
  return exit_ok;
}

}  // namespace

void add_pack(CLI::App& program, int& exit_code) {
  auto flags = std::make_shared<PackFlags>();
  CLI::App* command = program.add_subcommand("pack", "Make the disc packing of a design and clip it by the holes");
  command->add_option("DESIGN", flags->design, "Design file (TOML)")->required();
  command->add_option("-o,--output", flags->output, "Packing file to write (default: DESIGN's name + -packing.h5)")
      ->type_name("P.h5");
  add_common_flags(*command, flags->common);
  command->callback([flags, &exit_code] { exit_code = pack(*flags); });
}

}  // namespace perfora::app
