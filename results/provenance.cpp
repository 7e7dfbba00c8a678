// What is here: the provenance of what this build writes. What is not: its facts (io/provenance.h).
#include "results/provenance.h"

#include "io/provenance.h"

namespace perfora::results {

Provenance provenance_of_this_program() {
  Provenance made;
  made.program_version = io::program_version();
  made.git_revision = io::git_revision();
  made.compiler = io::compiler();
  made.results_version = results_version;
  return made;
}

}  // namespace perfora::results
