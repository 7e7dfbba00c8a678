// What is here: the examples below the --help of every command, one table; a test runs through it. What is not: the
// commands.
#include <utility>

#include "app/completion.h"

namespace perfora::app {

namespace {

constexpr std::pair<const char*, const char*> examples[] = {
    {"pack", "perfora pack designs/table1.toml -o out/table1-packing.h5"},
    {"evaluate",
     "perfora evaluate designs/quick.toml -o out/quick.h5\n"
     "  perfora evaluate designs/quick.toml --until 0.1 --replicates 5 -o out/quick-ensemble\n"
     "  perfora evaluate designs/table1.toml --elastic -o out/table1-elastic.h5"},
    {"test", "perfora test designs/solid.toml -o out/solid-test.h5"},
    {"calibrate", "perfora calibrate designs/calibrate-concrete.toml -o out/concrete"},
    {"map", "perfora map designs/study-quick.toml --designs 24 -o out/study-quick-map"},
    {"optimize",
     "perfora optimize designs/study-quick.toml -o out/study-quick\n"
     "  perfora optimize designs/study-quick.toml -o out/study-quick --resume\n"
     "  perfora optimize designs/study-quick.toml --map out/study-quick-map -o out/study-mapped"},
    {"work", "perfora work out/study-shared"},
    {"ask", "perfora ask out/study-shared -o job.json"},
    {"tell", "perfora tell out/study-shared job.json answer.jsonl"},
    {"sweep", "perfora sweep designs/sweep-quick.toml -o out/sweep-quick"},
    {"tolerance",
     "perfora tolerance designs/tolerance-quick.toml -o out/tolerance-quick\n"
     "  perfora tolerance out/study-quick --set tolerance.hole_size=\"0.3 mm\" -o out/study-tolerance"},
    {"correlate", "perfora correlate out/fine out/coarse -o out/ranks.png"},
    {"check", "perfora check designs/study.toml"},
    {"show", "perfora show out/quick.h5"},
    {"plot",
     "perfora plot designs/quick.toml -o layout.png\n"
     "  perfora plot out/quick.h5 -o quick.pdf\n"
     "  perfora plot out/study-quick -o study.svg"},
    {"report",
     "perfora report out/quick.h5 -o quick.html\n"
     "  perfora report out/study-quick -o study.html"},
    {"export",
     "perfora export out/quick.h5 --lammps-dump --vtk -o out/quick\n"
     "  perfora export out/quick.h5 --vtk --axis strain --force\n"
     "  perfora export out/quick.h5 --csv --at \"10 %\" -o out/at-ten-percent"},
    {"draw",
     "perfora draw designs/table1.toml -o block.svg\n"
     "  perfora draw out/study-quick/best.h5 -o block.dxf"},
    {"movie",
     "perfora evaluate designs/quick.toml --set output.frames=all -o out/quick.h5\n"
     "  perfora movie out/quick.h5 -o out/quick-movie"},
    {"completion",
     "source <(perfora completion bash)\n"
     "  perfora completion man > perfora.1"},
};

}  // namespace

void add_examples(CLI::App& program) {
  for (CLI::App* command : program.get_subcommands([](const CLI::App*) { return true; }))
    for (const auto& [name, text] : examples)
      if (command->get_name() == name) command->footer(std::string("Examples:\n  ") + text);
}

}  // namespace perfora::app
