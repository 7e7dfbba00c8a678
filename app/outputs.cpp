// What is here: the CSV and XDMF written beside a run file. What is not: the run file itself (results/run_file.h).
#include "app/outputs.h"

#include "io/files.h"
#include "report/export/xdmf.h"
#include "results/run_file.h"

namespace perfora::app {

namespace fs = std::filesystem;

bool all_beside(const fs::path& run_file) {
  for (const char* extension : {".csv", ".xdmf", ".xdmf.h5"})
    if (!fs::exists(fs::path(run_file).replace_extension(extension))) return false;
  return true;
}

void write_beside(const fs::path& run_file) {
  const results::RunResult run = results::read_run(run_file);
  io::write_file(fs::path(run_file).replace_extension(".csv"), results::history_csv(run.history));
  report::write_xdmf(run_file, fs::path(run_file).replace_extension(".xdmf"));
}

}  // namespace perfora::app
