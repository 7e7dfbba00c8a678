// What is here: which outputs are refused before any work. What is not: the writing (test_files.cpp).
#include <gmock/gmock.h>
#include <sys/stat.h>
#include <unistd.h>

#include <fstream>

#include "io/files.h"
#include "io/lock.h"
#include "io_support.h"

namespace perfora::io {
namespace {

using testing::HasSubstr;

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
  std::ofstream(folder / "file") << "x";
  EXPECT_THAT(input_error([&] { check_output(folder / "file/R.h5", true, true); }), HasSubstr("cannot be made: "));
  EXPECT_NO_THROW(check_output(folder / "new/and/newer/R.h5", false, false));
  EXPECT_FALSE(std::filesystem::exists(folder / "new"));
  { const OutputLock lock(folder / "new/and/newer/R.h5"); }
  EXPECT_FALSE(std::filesystem::exists(folder / "new")) << "nothing was put there";
  {
    const OutputLock lock(folder / "new/and/newer/R.h5");
    std::ofstream(folder / "new/and/R.h5") << "x";
  }
  EXPECT_FALSE(std::filesystem::exists(folder / "new/and/newer"));
  EXPECT_TRUE(std::filesystem::exists(folder / "new/and/R.h5"));
  EXPECT_THAT(input_error([&] { check_output("", true, true); }), HasSubstr("give one with -o"));
  if (::geteuid() == 0) GTEST_SKIP() << "root may write everywhere";
  std::filesystem::permissions(folder.path(), std::filesystem::perms::owner_read | std::filesystem::perms::owner_exec);
  EXPECT_THAT(input_error([&] { check_output(folder / "R.h5", true, true); }), HasSubstr("is not writable"));
  std::filesystem::permissions(folder.path(), std::filesystem::perms::owner_all);
}

TEST(CheckOutput, ReplacesRegularFilesOnly) {
  const TemporaryFolder folder;
  ASSERT_EQ(::mkfifo((folder / "fifo").c_str(), 0600), 0);
  std::filesystem::create_directory(folder / "sub");
  std::filesystem::create_symlink("fifo", folder / "link");
  for (const bool force : {false, true})
    for (const bool resume : {false, true}) {
      const auto said = [&](const std::filesystem::path& path) {
        return input_error([&] { check_output(path, force, resume); });
      };
      EXPECT_THAT(said(folder / "fifo"), HasSubstr("is a FIFO; only regular files are replaced; choose another"));
      EXPECT_THAT(said(folder / "link"), HasSubstr("is a FIFO"));
      EXPECT_THAT(said(folder / "sub"), HasSubstr("is a folder"));
      EXPECT_THAT(said("/dev/null"), HasSubstr("is a device"));
    }
}

TEST(CheckOutput, FollowsLinks) {
  const TemporaryFolder folder;
  std::filesystem::create_symlink("nothing.h5", folder / "new.h5");
  EXPECT_NO_THROW(check_output(folder / "new.h5", false, false));
  EXPECT_EQ(output_target(folder / "new.h5"), folder / "nothing.h5");
  folder.file("there.h5", "x");
  std::filesystem::create_symlink(folder / "there.h5", folder / "old.h5");
  EXPECT_THAT(input_error([&] { check_output(folder / "old.h5", false, false); }), HasSubstr("already exists"));
  std::filesystem::create_symlink("none/R.h5", folder / "astray.h5");
  EXPECT_NO_THROW(check_output(folder / "astray.h5", false, false)) << "the folder can be made";
  std::filesystem::create_symlink("b", folder / "a");
  std::filesystem::create_symlink("a", folder / "b");
  EXPECT_THAT(input_error([&] { check_output(folder / "a", true, true); }), HasSubstr("leads in a circle"));
}

// The longest name beside R.h5 is R.xdmf.h5.tmp-4194304-ffff: 25 bytes for ".h5"; file names have at most 255 bytes.
TEST(CheckOutput, LeavesRoomForTheNamesBesideIt) {
  const TemporaryFolder folder;
  EXPECT_NO_THROW(check_output(folder / (std::string(230, 'b') + ".h5"), false, false));
  for (const std::size_t size : {231U, 240U, 252U, 300U})
    EXPECT_THAT(input_error([&] { check_output(folder / (std::string(size, 'b') + ".h5"), true, true); }),
                HasSubstr("the name is too long"));
  std::string deep;
  for (int k = 0; k < 50; ++k) deep += std::string(99, 'd') + "/";
  EXPECT_THAT(input_error([&] { check_output(folder / (deep + "R.h5"), true, true); }),
              HasSubstr("the path is too long"));
}

}  // namespace
}  // namespace perfora::io
