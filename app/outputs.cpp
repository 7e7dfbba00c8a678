// What is here: the check that an output may be written, and the CSV and XDMF written beside a run file. What is not:
// the run file itself (results/run_file.h).
#include "app/outputs.h"

#include <array>

#include "io/error.h"
#include "io/files.h"
#include "report/xdmf.h"
#include "results/run_file.h"

namespace perfora::app {

namespace fs = std::filesystem;

fs::path part_folder(const fs::path& run_file) {
  return fs::path(run_file).replace_extension(".part");
}

void check_run_output(const fs::path& run_file, bool force, bool resume) {
  if (run_file.extension() != ".h5")
    throw io::InputError({"-o", 0, run_file.string()}, "the run file does not end in .h5", "a name such as result.h5");
  io::check_output(run_file, force, resume);
  const std::array<fs::path, 3> beside = {fs::path(run_file).replace_extension(".csv"),
                                          fs::path(run_file).replace_extension(".xdmf"),
                                          fs::path(run_file).replace_extension(".xdmf.h5")};
  if (!resume)
    for (const fs::path& path : beside) io::check_output(path, force, false);
  const fs::path part = part_folder(run_file);
  if (resume) return;
  if (fs::exists(part) && !force)
    throw io::InputError({part.string(), 0, ""}, "holds a run that did not end", "",
                         "--resume continues it, --force throws it away, or name another output with -o");
  // Both go, or --resume would find the old run's end beside the new one's beginning.
  fs::remove_all(part);
  fs::remove(run_file);
  for (const fs::path& path : beside) fs::remove(path);
}

void write_beside(const fs::path& run_file) {
  const results::RunResult run = results::read_run(run_file);
  io::write_file(fs::path(run_file).replace_extension(".csv"), results::history_csv(run.history));
  report::write_xdmf(run_file, fs::path(run_file).replace_extension(".xdmf"));
}

}  // namespace perfora::app
