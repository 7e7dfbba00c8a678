// What is here: the facts of this build have their form. What is not: their values, which change with every build.
#include "io/provenance.h"

#include <gmock/gmock.h>

namespace perfora::io {
namespace {

TEST(Provenance, HasItsForm) {
  EXPECT_THAT(program_version(), testing::MatchesRegex("[0-9]+\\.[0-9]+\\.[0-9]+"));
  EXPECT_THAT(git_revision(), testing::MatchesRegex("unknown|[0-9a-f]+(-dirty)?"));
  EXPECT_THAT(compiler(), testing::MatchesRegex("[A-Za-z]+ [0-9.]+, .*"));
}

}  // namespace
}  // namespace perfora::io
