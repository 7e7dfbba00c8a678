// What is here: the wording of InputError and the nearest name. Expected texts follow the rule in io/error.h.
// What is not: the errors of particular files.
#include <gmock/gmock.h>

#include "io/error.h"

namespace perfora::io {
namespace {

TEST(InputError, NamesFileLineKeyProblemAllowedRemedy) {
  const InputError error({"a.toml", 7, "layout.diameter"}, "is wrong", "allowed: right", "correct it");
  EXPECT_STREQ(error.what(), "a.toml:7: layout.diameter: is wrong; allowed: right; correct it");
  EXPECT_EQ(error.problem(), "is wrong");
  EXPECT_EQ(error.origin().line, 7);
}

TEST(InputError, LeavesEmptyPartsOut) {
  EXPECT_STREQ(InputError({"", 0, ""}, "is wrong").what(), "is wrong");
  EXPECT_STREQ(InputError({"a.h5", 0, ""}, "is wrong", "", "write it again").what(), "a.h5: is wrong; write it again");
  EXPECT_STREQ(InputError({"", 3, "k"}, "is wrong").what(), "k: is wrong");
}

TEST(InputError, IsOneLineWhateverTheUserWrote) {
  EXPECT_THAT(InputError({"a\nb", 1, "k\x1b"}, "c\r\nd").what(), testing::Not(testing::ContainsRegex("[\n\r\x1b]")));
}

TEST(NearestName, FindsTypingMistakes) {
  const std::vector<std::string> names = {"rows", "columns", "diameter", "stagger", "rate"};
  EXPECT_EQ(nearest_name("diametr", names), "diameter");   // one letter missing
  EXPECT_EQ(nearest_name("daimeter", names), "diameter");  // two letters swapped
  EXPECT_EQ(nearest_name("Columns", names), "columns");    // case counts nothing
  EXPECT_EQ(nearest_name("row", names), "rows");
  EXPECT_EQ(nearest_name("rwos", names), "rows");
}

TEST(NearestName, SaysNothingBeyondAThird) {
  const std::vector<std::string> names = {"rows", "columns"};
  EXPECT_EQ(nearest_name("friction", names), "");
  EXPECT_EQ(nearest_name("", names), "");
  EXPECT_EQ(nearest_name("rows", {}), "");
  EXPECT_EQ(nearest_name(std::string(100000, 'x'), names), "");
}

}  // namespace
}  // namespace perfora::io
