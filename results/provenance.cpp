// What is here: the provenance of what this build writes. What is not: its facts (io/provenance.h).
#include "results/provenance.h"

#include "io/provenance.h"

namespace perfora::results {

std::string title_of(const Provenance& provenance, const std::filesystem::path& file) {
  return provenance.title.empty() ? file.stem().string() : provenance.title;
}

Provenance provenance_of_this_program() {
  Provenance made;
  made.program_version = io::program_version();
  made.git_revision = io::git_revision();
  made.compiler = io::compiler();
  made.results_version = results_version;
  return made;
}

}  // namespace perfora::results
