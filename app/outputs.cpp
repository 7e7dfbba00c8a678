// What is here: see outputs.h.
#include "app/outputs.h"

#include "io/error.h"
#include "io/journal.h"

#ifdef PERFORA_HAS_REPORT
#include "report/run_result.h"
#endif
#ifdef PERFORA_HAS_XDMF
#include "report/xdmf.h"
#endif

namespace perfora::app {

namespace fs = std::filesystem;

fs::path part_folder(const fs::path& run_file) {
  return fs::path(run_file).replace_extension(".part");
}

void check_run_output(const fs::path& run_file, bool force, bool resume) {
  if (run_file.extension() != ".h5")
    throw io::InputError({"-o", 0, run_file.string()}, "the run file does not end in .h5", "a name such as result.h5");
  io::check_output(run_file, force, resume);
  const fs::path part = part_folder(run_file);
  if (!fs::exists(part) || resume) return;
  if (!force)
    throw io::InputError({part.string(), 0, ""}, "holds a run that did not end", "",
                         "--resume goes on with it, --force throws it away, or name another output with -o");
  fs::remove_all(part);
}

void write_beside([[maybe_unused]] const fs::path& run_file) {
#ifdef PERFORA_HAS_REPORT
  const report::RunResult run = report::read_run(run_file);
  io::write_file(fs::path(run_file).replace_extension(".csv"), report::history_csv(run));
#endif
#ifdef PERFORA_HAS_XDMF
  report::write_xdmf(run_file, fs::path(run_file).replace_extension(".xdmf"));
#endif
}

}  // namespace perfora::app
