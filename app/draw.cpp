// What is here: `perfora draw`: a design or a result file -> workshop drawing as SVG or DXF. What is not: what is drawn
// (report/export/block_drawing.h), pictures of results (plot.cpp).
#include <fmt/format.h>

#include <algorithm>
#include <optional>

#include "app/commands.h"
#include "app/common.h"
#include "geometry/packing_file.h"
#include "io/error.h"
#include "io/files.h"
#include "io/hdf5.h"
#include "io/letters.h"
#include "io/lock.h"
#include "io/provenance.h"
#include "io/text.h"
#include "optimize/evaluate/design.h"
#include "report/export/block_drawing.h"

namespace perfora::app {

namespace {

namespace fs = std::filesystem;

struct DrawFlags {
  CommonFlags common;
  std::string input, output, title;
  std::vector<std::string> notes;
};

/// What a workshop must know of the material, as far as the model says it.
void add_notes(report::BlockSheet& sheet, const optimize::Design& design) {
  const solver::MaterialOptions& material = design.solver.material;
  const auto text = [](double value, io::Dimension dimension) { return io::quantity(value, dimension); };
  sheet.notes.emplace_back("material", "mortar or concrete of " + text(material.density, io::Dimension::density));
  sheet.notes.emplace_back("discs", text(design.packing.mean_diameter, io::Dimension::length) + " on average");
  sheet.notes.emplace_back(
      "bonds", fmt::format("k_n {}, k_t {}", text(material.grade * material.normal_stiffness, io::Dimension::stiffness),
                           text(material.grade * material.tangential_stiffness, io::Dimension::stiffness)));
  sheet.notes.emplace_back("loading", "vertical, to " + text(design.solver.loading.until, io::Dimension::ratio));
  sheet.notes.emplace_back("model", "plane: the depth is free");
}

/// The design that a result file holds; nothing where a program that knew other keys wrote it.
std::optional<optimize::DesignFile> design_in(const io::Hdf5Reader& file) {
  if (!file.has("/config")) return std::nullopt;
  try {
    return optimize::DesignFile::from_toml(file.text("/config"), file.path().string());
  } catch (const io::InputError&) {
    return std::nullopt;
  }
}

report::BlockSheet sheet_of_result(const fs::path& path) {
  if (fs::is_directory(path))
    throw io::InputError({path.string(), 0, ""}, "is a folder, and one block is drawn", "a design or a result file",
                         fs::exists(path / "best.toml") ? "give " + (path / "best.toml").string() : "");
  const io::Hdf5Reader file(path);
  if (!file.has("/layout"))
    throw io::InputError({path.string(), 0, "/layout"}, "the file holds no layout of holes",
                         "a run, packing or elastic response", "give such a file, or the design");
  report::BlockSheet sheet;
  sheet.layout = geometry::read_layout(file, "/layout");
  sheet.title = file.has_attribute("/", "title") ? file.attribute_text("/", "title") : path.stem().string();
  if (const auto design = design_in(file)) add_notes(sheet, design->design());
  return sheet;
}

/// "mortar=C25/30" as a row of the title block, "C25/30" as one that is called a note.
std::pair<std::string, std::string> note_of(const std::string& text) {
  const std::size_t equals = text.find('=');
  if (equals == std::string::npos) return {"note", text};
  return {text.substr(0, equals), text.substr(equals + 1)};
}

report::BlockSheet sheet_of_design(const DrawFlags& flags) {
  const optimize::DesignFile design(flags.input, flags.common.overrides());
  report::BlockSheet sheet;
  sheet.title = design.title();
  sheet.layout =
      geometry::make_layout(design.design().layout, design.design().seeds.effective(0).layout, &design.schema());
  add_notes(sheet, design.design());
  return sheet;
}

int draw(const DrawFlags& flags) {
  flags.common.apply();
  const fs::path input = flags.input;
  const auto output = output_or_default(flags.output, default_name(input, ".svg"));
  const std::string extension = io::lower(output.extension().string());
  if (extension != ".svg" && extension != ".dxf")
    throw io::InputError({"--output", 0, ""}, "a drawing cannot be written as \"" + output.extension().string() + "\"",
                         ".svg or .dxf", "choose one of these extensions");
  const bool design = io::lower(input.extension().string()) == ".toml";
  if (!design) flags.common.refuse_overrides(input);
  report::BlockSheet sheet = design ? sheet_of_design(flags) : sheet_of_result(input);
  if (!flags.title.empty()) sheet.title = flags.title;
  for (const std::string& note : flags.notes) sheet.notes.push_back(note_of(note));
  sheet.source = input.filename().string() + ", perfora " + io::program_version();
  const io::OutputLock lock = io::claim_new_output(output, flags.common.force);
  const report::Drawing drawing = report::draw_block_sheet(sheet);
  io::write_file(output, extension == ".svg" ? report::as_svg(drawing) : report::as_dxf(drawing));
  if (flags.common.json)
    print_json({{"schema", "perfora.draw/1"}, {"status", "completed"}, {"reason", ""}, {"output", output.string()}});
  io::log_info("written: " + output.string());
  return exit_ok;
}

}  // namespace

void add_draw(CLI::App& program, int& exit_code) {
  auto flags = std::make_shared<DrawFlags>();
  CLI::App* command = program.add_subcommand("draw", "Draw a block for the workshop, as SVG or DXF in mm, scale 1:1");
  command->add_option("FILE", flags->input, "Design file (.toml), or a run or packing file (.h5)")->required();
  command->add_option("-o,--output", flags->output, "Drawing: .svg or .dxf (default: FILE's name + .svg)");
  command->add_option("--title", flags->title, "Title of the sheet (default: that of the design, or FILE's name)")
      ->type_name("TEXT");
  command
      ->add_option(
          "--note", flags->notes,
          "A row of the title block, such as \"mortar=C25/30, E 8 GPa\"; without NAME= it is called note (repeatable)")
      ->allow_extra_args(false)
      ->type_name("NAME=TEXT");
  add_common_flags(*command, flags->common);
  command->callback([flags, &exit_code] { exit_code = draw(*flags); });
}

}  // namespace perfora::app
