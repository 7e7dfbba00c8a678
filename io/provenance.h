// What is here: what this build is: version, git revision, compiler. What is not: the machine (nothing here names it).
#pragma once

#include <string>

namespace perfora::io {

/// Version of the project, such as "0.1.0".
std::string program_version();
/// Git revision this was built from, 12 hex digits, with "-dirty" when tracked files had changed; "unknown" outside a
/// git checkout.
std::string git_revision();
/// Compiler, its version and the build type, such as "GNU 12.2.0, Release".
std::string compiler();

}  // namespace perfora::io
