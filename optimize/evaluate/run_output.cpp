// What is here: the rules for existing outputs of a run. What is not: what stands beside a run file (report/).
#include "optimize/evaluate/run_output.h"

#include <array>
#include <utility>

#include "io/error.h"
#include "io/files.h"
#include "optimize/evaluate/estimate.h"
#include "solver/run_folder.h"

namespace perfora::optimize {

namespace fs = std::filesystem;

namespace {

void require_h5(const fs::path& file, const char* what) {
  if (file.extension() != ".h5")
    throw io::InputError({"-o", 0, file.string()}, std::string(what) + " does not end in .h5",
                         "a name such as result.h5");
}

}  // namespace

io::OutputLock claim_pack_output(const fs::path& file, bool force) {
  require_h5(file, "the packing file");
  return io::claim_new_output(file, force);
}

io::OutputLock claim_run_output(const fs::path& run_file, bool force, bool resume) {
  require_h5(run_file, "the run file");
  io::check_output(run_file, true, false);  // that there is a folder for the lock
  io::OutputLock lock(run_file);
  io::check_output(run_file, force, resume);
  const std::array<fs::path, 4> beside = {
      fs::path(run_file).replace_extension(".csv"), fs::path(run_file).replace_extension(".xdmf"),
      fs::path(run_file).replace_extension(".xdmf.h5"), fs::path(run_file).replace_extension(".html")};
  if (!resume)
    for (const fs::path& path : beside) io::check_output(path, force, false);
  const fs::path part = solver::RunFolder(run_file).path();
  if (resume) return lock;
  if (fs::exists(part) && !force)
    throw io::InputError({part.string(), 0, ""}, "holds a run that did not end", "",
                         "--resume continues it, --force throws it away, or name another output with -o");
  // Both go, or --resume would find the old run's end beside the new one's beginning.
  fs::remove_all(part);
  io::remove_output(run_file);
  for (const fs::path& path : beside) io::remove_output(path);
  return lock;
}

PreparedEvaluation prepare_evaluation(const DesignFile& design, const EvaluateOptions& options, int replicate,
                                      bool force, double memory) {
  PreparedEvaluation prepared{design.validate(), {}};
  for (std::string& warning : check_cost(design, options.threads, memory))
    prepared.warnings.push_back(std::move(warning));
  if (!options.packing_file.empty()) require_packing_file(design, options.packing_file, replicate);
  if (options.run_file.empty()) return prepared;
  prepared.lock = claim_run_output(options.run_file, force, options.resume);
  if (!options.resume) return prepared;
  static_cast<void>(finished_evaluation(design, options.run_file, replicate));
  if (!fs::exists(options.run_file) && !solver::RunFolder(options.run_file).holds_checkpoint())
    prepared.warnings.push_back("--resume: there is no run to continue in " + options.run_file.string() +
                                "; this is a new one");
  return prepared;
}

}  // namespace perfora::optimize
