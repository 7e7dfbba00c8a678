// What is here: `perfora reference` (hidden): every key of design, study, sweep and calibration files as Markdown, from
// the table of keys that reads them. What is not: the text around it (docs/user/design-files.md).
#include "app/commands.h"
#include "app/common.h"
#include "optimize/campaign/sweep.h"
#include "optimize/campaign/tolerance.h"
#include "optimize/evaluate/design.h"
#include "optimize/search/calibration.h"
#include "optimize/search/study.h"

namespace perfora::app {

void add_reference(CLI::App& program, int& exit_code) {
  CLI::App* command =
      program.add_subcommand("reference", "Print every key of design, study, sweep and calibration files")->group("");
  command->callback([&exit_code] {
    print_text("# Keys of a design file\n\n" + optimize::DesignFile().schema().reference() +
               "\n# Keys of a study file\n\n" + optimize::study_reference() + "\n# Keys of a sweep file\n\n" +
               optimize::sweep_reference() + "\n# Keys of a tolerance analysis\n\n" + optimize::tolerance_reference() +
               "\n# Keys of a calibration file\n\n" + optimize::calibration_reference());
    exit_code = exit_ok;
  });
}

}  // namespace perfora::app
