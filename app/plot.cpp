// What is here: `perfora plot`: R.h5, P.h5, T.h5, an elastic response or a folder of work -> picture; several R.h5 in
// one. What is not: drawing (report).
#include "report/plot.h"

#include <fmt/format.h>

#include <algorithm>

#include "app/campaign_pictures.h"
#include "app/commands.h"
#include "app/common.h"
#include "app/measured_curves.h"
#include "io/error.h"
#include "io/hdf5.h"
#include "io/lock.h"
#include "optimize/evaluate/design.h"
#include "results/describe.h"

namespace perfora::app {

namespace {

namespace fs = std::filesystem;

struct PlotFlags {
  CommonFlags common;
  std::vector<std::string> inputs;
  std::string output;
  std::string title;
  std::vector<std::string> curves;  ///< CSV files of measured curves
  bool collapse = false;
};

std::string format_of(const fs::path& file) {
  return io::Hdf5Reader(file).attribute_text("/", "format");
}

/// The keys of a design that are not at their defaults, without seeds and what is written: the same for runs that
/// differ only by chance, also where a program that knew fewer keys made one of them.
std::string design_of(const results::RunResult& run) {
  try {
    optimize::DesignFile design = optimize::DesignFile::from_toml(run.provenance.config, run.path.string());
    design.design().seeds = {};
    design.design().solver.output = {};
    return design.schema().changed_toml();
  } catch (const io::InputError&) {
    return run.provenance.config;  // of a program that knew more keys
  }
}

/// The runs under the names of their files, with their folders where two files have one name, and with their status
/// where they did not end.
std::vector<report::LabelledRun> read_runs(const PlotFlags& flags) {
  std::vector<report::LabelledRun> runs;
  for (const fs::path file : flags.inputs) {
    if (!format_of(file).starts_with("perfora.run/"))
      throw io::InputError({file.string(), 0, ""},
                           flags.collapse ? "--collapse draws the frames of runs, and this is none"
                                          : "several files are compared as runs, and this is none",
                           "", "give run files of perfora evaluate");
    const bool twice = std::count_if(flags.inputs.begin(), flags.inputs.end(),
                                     [&](const fs::path& other) { return other.stem() == file.stem(); }) > 1;
    results::RunResult run = results::read_run(file);
    std::string design = design_of(run);
    std::string label =
        twice ? (fs::absolute(file).parent_path().filename() / file.stem()).string() : file.stem().string();
    if (run.status != "completed") label += " (" + run.status + ")";
    runs.push_back({std::move(label), std::move(run), std::move(design)});
  }
  return runs;
}

/// A study, sweep, ensemble or calibration.
void draw_folder(const PlotFlags& flags, const fs::path& folder, const fs::path& output) {
  if (flags.inputs.size() > 1)
    throw io::InputError({folder.string(), 0, ""}, "several files are compared as runs, and this is a folder", "",
                         "give run files of perfora evaluate, or one folder alone");
  if (!flags.collapse) return draw_campaign(folder, output, flags.title, flags.curves);
  if (!draw_collapse(folder, output, flags.title))
    throw io::InputError({folder.string(), 0, ""}, "no run file was kept here, and --collapse draws their frames", "",
                         "run the sweep with run_files = true under [sweep]");
}

/// One run, with what its design names and --curve adds.
void draw_run(const fs::path& input, const fs::path& output, const PlotFlags& flags) {
  report::PlotOptions options;
  options.title = flags.title;
  const io::Hdf5Reader file(input);
  options.measured = measured_curves(flags.curves, {file.has("/config") ? file.text("/config") : ""});
  report::plot_run(input, output, options);
}

/// --curve with a picture that has no curves of runs.
void refuse_curves(const PlotFlags& flags, const std::string& what) {
  if (!flags.curves.empty())
    throw io::InputError({"--curve", 0, ""}, "is drawn beside curves of runs, and " + what + " has none", "",
                         "leave it out, or give runs, an ensemble, a sweep or a study");
}

/// A design that was not run: its layout.
void draw_design(const fs::path& input, const fs::path& output, const PlotFlags& flags) {
  if (const std::string kind = results::kind_of_toml(input); kind != "design")
    throw io::InputError(
        {input.string(), 0, ""}, "this is a " + kind + ", and plot draws the layout of a design", "",
        fmt::format("give the design it names, or the folder of its results after {}", results::command_of(kind)));
  const optimize::DesignFile design(input, flags.common.overrides());
  static_cast<void>(design.validate(optimize::Purpose::block));
  const optimize::Design& d = design.design();
  report::PlotOptions options;
  options.title = flags.title.empty() ? design.title() : flags.title;
  report::plot_layout(geometry::make_layout(d.layout, d.seeds.effective(0).layout, &design.schema()),
                      d.packing.mean_diameter, output, options);
}

void draw(const PlotFlags& flags, const fs::path& output) {
  const fs::path input = flags.inputs.front();
  if (flags.inputs.size() > 1 || input.extension() != ".toml") flags.common.refuse_overrides(input);
  if (flags.collapse) refuse_curves(flags, "--collapse");
  for (const fs::path one : flags.inputs)
    if (fs::is_directory(one)) return draw_folder(flags, one, output);
  report::PlotOptions options;
  options.title = flags.title;
  if (flags.inputs.size() > 1 || flags.collapse) {
    std::vector<report::LabelledRun> runs = read_runs(flags);
    if (options.title.empty())
      options.title =
          runs.size() > 1 ? fmt::format("{} runs", runs.size()) : results::title_of(runs.front().run.provenance, input);
    if (runs.size() == 1) runs.front().label.clear();  // the heading says it
    std::vector<std::string> configurations;
    for (const report::LabelledRun& run : runs) configurations.push_back(run.run.provenance.config);
    if (!flags.collapse) options.measured = measured_curves(flags.curves, configurations);
    flags.collapse ? report::plot_collapse(runs, output, options) : report::plot_comparison(runs, output, options);
    return;
  }
  if (input.extension() == ".toml") {
    refuse_curves(flags, input.string());
    return draw_design(input, output, flags);
  }
  const std::string format = format_of(input);
  const bool pack = format.starts_with("perfora.pack/"), test = format.starts_with("perfora.test/"),
             elastic = format.starts_with("perfora.elastic/");
  if (pack || test || elastic) refuse_curves(flags, input.string());
  if (pack)
    report::plot_packing(input, output, options);
  else if (test)
    report::plot_material_tests(input, output, options);
  else if (elastic)
    report::plot_elastic(input, output, options);
  else
    draw_run(input, output, flags);
}

/// "DIR" of "DIR/": its name is that of the picture.
fs::path without_slash(const fs::path& path) {
  return path.has_filename() ? path : path.parent_path();
}

int plot(const PlotFlags& flags) {
  flags.common.apply();
  const std::string name =
      flags.inputs.size() > 1 ? "comparison.png" : default_name(without_slash(flags.inputs.front()), ".png");
  const auto output = output_or_default(flags.output, name);
  const io::OutputLock lock = io::claim_new_output(output, flags.common.force);
  draw(flags, output);
  if (flags.common.json)
    print_json({{"schema", "perfora.plot/1"}, {"status", "completed"}, {"reason", ""}, {"output", output.string()}});
  io::log_info("written: " + output.string());
  return exit_ok;
}

}  // namespace

void add_plot(CLI::App& program, int& exit_code) {
  auto flags = std::make_shared<PlotFlags>();
  CLI::App* command = program.add_subcommand(
      "plot", "Draw a design, a run or several, a packing, material tests, an elastic response, or a folder of work");
  command
      ->add_option("FILE", flags->inputs,
                   "Design file (its layout, before any run), run file R.h5 or several of them, packing file P.h5, "
                   "material tests T.h5, file of evaluate "
                   "--elastic, or the "
                   "folder of a study, sweep, ensemble or calibration, finished or not")
      ->required();
  command->add_option("-o,--output", flags->output,
                      "Picture: .png, .svg or .pdf (default: FILE's name + .png, comparison.png of several)");
  command->add_option("--title", flags->title, "Heading of the picture (default: FILE's name, or how many runs)")
      ->type_name("TEXT");
  command
      ->add_option("--curve", flags->curves,
                   "Measured curve to draw beside those of runs: CSV with a first line such as \"strain [%], stress "
                   "[MPa]\" (repeatable)")
      ->type_name("CSV")
      ->allow_extra_args(false);
  command->add_flag("--collapse", flags->collapse,
                    "Of runs, and of a sweep that keeps its run files: frames side by side instead of curves");
  add_common_flags(*command, flags->common);
  command->callback([flags, &exit_code] { exit_code = plot(*flags); });
}

}  // namespace perfora::app
