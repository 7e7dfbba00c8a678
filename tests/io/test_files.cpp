// What is here: whole-file writes, the rule for outputs that exist, CRC-32 against its published check value.
// What is not: the journal.
#include <gmock/gmock.h>

#include <unistd.h>

#include "io/files.h"
#include "io_support.h"

namespace perfora::io {
namespace {

using testing::HasSubstr;

std::size_t entries_in(const std::filesystem::path& folder) {
  const std::filesystem::directory_iterator all(folder);
  return static_cast<std::size_t>(std::distance(begin(all), end(all)));
}

TEST(Crc32, HasTheCheckValueOfTheStandard) {  // CRC-32/ISO-HDLC, check value of "123456789"
  EXPECT_EQ(crc32("123456789"), 0xCBF43926U);
  EXPECT_EQ(crc32(""), 0U);
}

TEST(WriteFile, AppearsWholeAndLeavesNothingElse) {
  const TemporaryFolder folder;
  const std::string text("a\0b\n", 4);
  write_file(folder / "a.txt", text);
  EXPECT_EQ(read_file(folder / "a.txt"), text);
  write_file(folder / "a.txt", "");
  EXPECT_EQ(read_file(folder / "a.txt"), "");
  EXPECT_EQ(entries_in(folder.path()), 1U);
}

TEST(WriteFile, FailureLeavesTheOldFile) {
  const TemporaryFolder folder;
  EXPECT_THROW(write_file(folder / "none/a.txt", "new"), std::exception);
  std::filesystem::create_directory(folder / "taken");
  EXPECT_THROW(write_file(folder / "taken", "new"), std::exception);  // a folder cannot be renamed over
  EXPECT_EQ(entries_in(folder.path()), 1U);
}

TEST(ReadFile, RefusesWhatIsTooLarge) {
  const TemporaryFolder folder;
  const auto path = folder.file("a.txt", std::string(3000000, 'x'));
  EXPECT_EQ(read_file(path).size(), 3000000U);
  EXPECT_THAT(input_error([&] { (void)read_file(path, 1U << 20); }), HasSubstr("is larger than 1 MB"));
  EXPECT_THAT(input_error([&] { (void)read_file(path / "b"); }), HasSubstr("check the path"));
}

TEST(CheckOutput, RefusesWhatExistsUnlessToldOtherwise) {
  const TemporaryFolder folder;
  const auto path = folder.file("R.h5", "x");
  const std::string said = input_error([&] { check_output(path, false, false); });
  EXPECT_EQ(said,
            path.string() + ": already exists; choose another output, --force to replace it or --resume to go on");
  EXPECT_NO_THROW(check_output(path, true, false));
  EXPECT_NO_THROW(check_output(path, false, true));
  EXPECT_NO_THROW(check_output(folder / "new.h5", false, false));
  EXPECT_NO_THROW(check_output("new-file-that-is-not-there.h5", false, false));
}

TEST(CheckOutput, RefusesFoldersThatCannotHoldIt) {
  const TemporaryFolder folder;
  EXPECT_THAT(input_error([&] { check_output(folder / "none/R.h5", true, true); }),
              HasSubstr("does not exist; make the folder"));
  EXPECT_THAT(input_error([&] { check_output("", true, true); }), HasSubstr("give one with -o"));
  if (::geteuid() == 0) GTEST_SKIP() << "root may write everywhere";
  std::filesystem::permissions(folder.path(), std::filesystem::perms::owner_read | std::filesystem::perms::owner_exec);
  EXPECT_THAT(input_error([&] { check_output(folder / "R.h5", true, true); }), HasSubstr("is not writable"));
  std::filesystem::permissions(folder.path(), std::filesystem::perms::owner_all);
}

}  // namespace
}  // namespace perfora::io
