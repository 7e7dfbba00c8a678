// What is here: folders of work drawn from their files: those that the pinned program left, finished and stopped, and
// those of today, whose picture is that of their command to the last byte. What is not: what a picture shows
// (tests/report).
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/pinned/pinned_support.h"

namespace perfora::test {
namespace {

namespace fs = std::filesystem;
using ::testing::HasSubstr;
using ::testing::StartsWith;

TEST(PinnedPictures, FoldersOfAnOlderProgramAreDrawnFinishedOrNot) {
  const WorkFolder work;
  for (const std::string kind : {"study", "sweep", "ensemble", "calibration"})
    for (const std::string folder : {kind, kind + "-stopped"}) {
      const Outcome drawn = work.run("plot " + folder + "/ --quiet");
      EXPECT_EQ(drawn.exit_code, 0) << folder << ": " << drawn.error;
      EXPECT_THAT(read_text(work / (folder + ".png")), StartsWith("\x89PNG")) << folder;
      EXPECT_EQ(work.run("show " + folder).exit_code, 0) << folder;
    }
  EXPECT_EQ(work.run("plot sweep-files --collapse -o now.png --quiet").exit_code, 0);
  EXPECT_THAT(work.run("plot sweep --collapse -o now2.png --quiet").error, HasSubstr("run_files"));
  EXPECT_THAT(work.run("plot designs -o now3.png --quiet").error + work.run("plot . -o now3.png --quiet").error,
              HasSubstr("holds no study, map, sweep, ensemble or calibration"));
  EXPECT_THAT(work.run("plot sweep run.h5 -o now4.png --quiet").error, HasSubstr("one folder alone"));
}

TEST(PinnedPictures, RedrawnTheyAreThoseOfTheCommand) {
  if (const std::string why = other_bits("avx2"); !why.empty()) GTEST_SKIP() << why;
  const WorkFolder work;
  struct Drawn {
    const char *command, *folder, *picture;
  };
  for (const Drawn& one : {Drawn{"optimize study.toml --workers 1 --threads 1", "study", "study.png"},
                           Drawn{"sweep sweep.toml --workers 1 --threads 1", "sweep", "sweep.png"},
                           Drawn{"calibrate calibration.toml --threads 1", "calibration", "reachable.png"}}) {
    const std::string folder = one.folder;
    ASSERT_EQ(work.run(std::string(one.command) + " -o " + folder + " --resume --quiet").exit_code, 0) << folder;
    ASSERT_EQ(work.run("plot " + folder + " -o now.png --force --quiet").exit_code, 0) << folder;
    EXPECT_EQ(read_text(work / "now.png"), read_text(work / (folder + "/" + one.picture))) << folder;
  }
}

}  // namespace
}  // namespace perfora::test
