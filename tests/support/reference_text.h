// What is here: the printed reference of design and study files as docs/design-files.md holds it below its line.
// What is not: the table of keys it is printed from (io/schema.h).
#pragma once

#include <string>

#include "optimize/design.h"
#include "optimize/study.h"

namespace perfora::test {

inline std::string reference_text() {
  return "# Keys of a design file\n\n" + optimize::DesignFile().schema().reference() + "\n# Keys of a study file\n\n" +
         optimize::study_reference();
}

}  // namespace perfora::test
