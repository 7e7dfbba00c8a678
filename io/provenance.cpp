// What is here: the facts of this build, from headers that CMake generates. What is not: how they are found
// (git_revision.cmake).
#include "io/provenance.h"

#include "perfora_build_facts.h"
#include "perfora_git_revision.h"

namespace perfora::io {

std::string program_version() {
  return PERFORA_VERSION;
}
std::string git_revision() {
  return PERFORA_GIT_REVISION;
}
std::string compiler() {
  return PERFORA_COMPILER;
}

}  // namespace perfora::io
