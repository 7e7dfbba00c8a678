// What is here: `perfora test`: tests of a design's solid material (T.h5, T.png). What is not: the tests
// (optimize/evaluate/material_tests.h), the picture (report/plot_material.cpp).
#include <fmt/format.h>

#include "app/commands.h"
#include "app/common.h"
#include "io/error.h"
#include "io/lock.h"
#include "io/text.h"
#include "optimize/evaluate/material_tests.h"
#include "optimize/evaluate/material_tests_file.h"
#include "report/plot.h"

namespace perfora::app {

namespace {

struct TestFlags {
  CommonFlags common;
  std::string material, output;
  int replicates = 1;
};

int test(const TestFlags& flags) {
  flags.common.apply();
  const optimize::DesignFile design(flags.material, flags.common.overrides());
  const auto kinds = optimize::wanted_tests(design);
  log_warnings(optimize::material_sample(design).validate());
  const solver::BoundaryOptions& boundary = design.design().solver.boundary;
  if (boundary.top_bottom != solver::TopBottom::periodic || boundary.sides != solver::Sides::periodic)
    io::log_warning("material tests are periodic, with sides that follow a stress; [boundary] is not looked at");
  const auto output = output_or_default(flags.output, default_name(flags.material, "-test.h5"));
  const auto picture = std::filesystem::path(output).replace_extension(".png");
  const io::OutputLock lock = io::claim_new_output(output, flags.common.force);
  const io::OutputLock lock_of_picture = io::claim_new_output(picture, flags.common.force);

  ProgressLine progress("material tests", flags.common.quiet);
  optimize::MaterialTestsOptions options;
  options.threads = flags.common.thread_count();
  options.replicates = flags.replicates;
  options.cancellation = stop_token();
  options.progress = progress.callback();
  const optimize::MaterialTests tests = optimize::test_material(design, kinds, options);
  progress.finish(fmt::format("{}, {}", tests.reason, io::duration(tests.performance.seconds)));
  const auto record = optimize::to_json(tests);
  const bool whole = !tests.runs.empty();
  if (whole) {
    optimize::write_material_tests(output, design, tests, command_line());
    report::plot_material_tests(output, picture);  // NOLINT(readability-suspicious-call-argument): test_file, out
  }
  print_record(record, flags.common.json);
  if (tests.status == results::RunStatus::failed) io::log_error("a test gave no strength: " + tests.reason);
  if (whole) io::log_info("written: " + output.string() + ", " + picture.string());
  return exit_code_of(tests.status);
}

}  // namespace

void add_test(CLI::App& program, int& exit_code) {
  auto flags = std::make_shared<TestFlags>();
  CLI::App* command =
      program.add_subcommand("test", "Test the solid material of a design: moduli, strengths, fracture energy");
  command->add_option("MATERIAL", flags->material, "Design file (TOML); its holes are left out")->required();
  command->add_option("-o,--output", flags->output, "File to write (default: MATERIAL's name + -test.h5)")
      ->type_name("T.h5");
  command->add_option("--replicates", flags->replicates, "Test N samples: other packings and strength fields")
      ->check(whole_number_within(1, most_replicates))
      ->type_name("N");
  add_common_flags(*command, flags->common);
  command->callback([flags, &exit_code] { exit_code = test(*flags); });
}

}  // namespace perfora::app
