// What is here: whole-file writes and reads, CRC-32 against its published check value.
// What is not: the rules for outputs (test_output_rules.cpp), the journal.
#include <gmock/gmock.h>
#include <sys/resource.h>
#include <sys/stat.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cerrno>
#include <csignal>
#include <functional>

#include "io/files.h"
#include "io/text_file.h"
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

std::string surroundings_error(const std::function<void()>& code) {
  try {
    code();
  } catch (const SurroundingsError& error) {
    return error.what();
  }
  return {};
}

TEST(WriteFile, FailureLeavesTheOldFile) {
  const TemporaryFolder folder;
  EXPECT_THROW(write_file(folder / "none/a.txt", "new"), SurroundingsError);
  std::filesystem::create_directory(folder / "taken");
  EXPECT_THROW(write_file(folder / "taken", "new"), SurroundingsError);  // a folder cannot be renamed over
  EXPECT_EQ(entries_in(folder.path()), 1U);
}

// A limit on the size of files makes write() fail half way, as a full disk does.
TEST(WriteFile, NoRoomIsOneSentenceAndLeavesTheOldFile) {
  const TemporaryFolder folder;
  const auto path = folder.file("a.txt", "old");
  std::signal(SIGXFSZ, SIG_IGN);
  rlimit before{};
  ::getrlimit(RLIMIT_FSIZE, &before);
  const rlimit small{10000, before.rlim_max};
  ::setrlimit(RLIMIT_FSIZE, &small);
  const std::string said = surroundings_error([&] { write_file(path, std::string(20000, 'x')); });
  ::setrlimit(RLIMIT_FSIZE, &before);
  EXPECT_EQ(said, path.string() +
                      " cannot be written: File too large (a limit on the size of files is reached, see `ulimit -f`); "
                      "raise it and run the command again (with --resume where it has that)");
  EXPECT_EQ(read_file(path), "old");
  EXPECT_EQ(entries_in(folder.path()), 1U);
  EXPECT_EQ(surroundings_error([] { fail_writing("R.h5", ENOSPC); }),
            "R.h5 cannot be written: No space left on device (the disk or a quota is full); make room and run the "
            "command again (with --resume where it has that)");
}

TEST(WriteFile, LinksAreFollowed) {
  const TemporaryFolder folder;
  std::filesystem::create_directory(folder / "scratch");
  std::filesystem::create_symlink("scratch/r.h5", folder / "r.h5");  // leads to nothing yet
  write_file(folder / "r.h5", "one");
  write_file(folder / "r.h5", "two");
  EXPECT_TRUE(std::filesystem::is_symlink(folder / "r.h5"));
  EXPECT_EQ(read_file(folder / "scratch/r.h5"), "two");
  EXPECT_EQ(entries_in(folder.path()) + entries_in(folder / "scratch"), 3U) << "r.h5, scratch, scratch/r.h5";
  remove_output(folder / "r.h5");
  EXPECT_TRUE(std::filesystem::is_symlink(folder / "r.h5"));
  EXPECT_EQ(entries_in(folder / "scratch"), 0U);
}

TEST(WriteFile, RemovesWhatAKilledProcessLeft) {
  const TemporaryFolder folder;
  const pid_t dead = ::fork();  // a process id that nobody has
  if (dead == 0) ::_exit(0);
  ::waitpid(dead, nullptr, 0);
  const std::string mine = temporary_name("a.txt").string(), end = mine.substr(mine.rfind('-'));
  const std::string left = "a.txt.tmp-" + std::to_string(dead) + end;
  folder.file(left, "half");
  folder.file("b" + left.substr(1), "of another file");
  folder.file("a.txt.tmp-1" + end, "of a process that lives");
  folder.file("a.txt.tmp-" + std::to_string(dead) + "-host", "of another host");
  folder.file("a.txt.tmp-mine", "a name of the user");
  write_file(folder / "a.txt", "whole");
  EXPECT_FALSE(std::filesystem::exists(folder / left));
  EXPECT_EQ(entries_in(folder.path()), 5U);
}

TEST(ReadFile, RefusesWhatIsNoRegularFileAndDoesNotWait) {
  const TemporaryFolder folder;
  ASSERT_EQ(::mkfifo((folder / "fifo").c_str(), 0600), 0);
  EXPECT_THAT(input_error([&] { (void)read_file(folder / "fifo"); }), HasSubstr("is a FIFO; a file is wanted"));
  EXPECT_THAT(input_error([&] { (void)read_beginning(folder / "fifo", 8); }), HasSubstr("is a FIFO"));
  EXPECT_THAT(input_error([&] { (void)read_file("/dev/null"); }), HasSubstr("is a device"));
  EXPECT_THAT(input_error([&] { (void)read_file(folder.path()); }), HasSubstr("is a folder"));
  EXPECT_EQ(read_beginning(folder.file("a", "abcdef"), 3), "abc");
  EXPECT_EQ(read_beginning(folder / "a", 30), "abcdef");
}

TEST(ReadFile, RefusesWhatIsTooLarge) {
  const TemporaryFolder folder;
  const auto path = folder.file("a.txt", std::string(3000000, 'x'));
  EXPECT_EQ(read_file(path).size(), 3000000U);
  EXPECT_THAT(input_error([&] { (void)read_file(path, 1U << 20); }), HasSubstr("is larger than 1 MB"));
  EXPECT_THAT(input_error([&] { (void)read_file(path / "b"); }), HasSubstr("check the path"));
}

TEST(ReadTextFile, TellsWhatAFileIsThatIsNoText) {
  using namespace std::string_literals;
  const TemporaryFolder folder;
  const auto said = [&](const std::string& begin) {
    const auto path = folder.file("a.toml", begin + std::string(2000, 'x'));
    return input_error([&] { (void)read_text_file(path, 1U << 20, "a design"); });
  };
  EXPECT_THAT(said("\x89HDF\r\n\x1a\n"), HasSubstr("a.toml: is an HDF5 file; a design is wanted; perfora show"));
  EXPECT_THAT(said("\x89PNG\r\n\x1a\n"), HasSubstr("is a PNG picture; a design is wanted"));
  EXPECT_THAT(said("%PDF-1.7"), HasSubstr("is a PDF file"));
  EXPECT_THAT(said("\xff\xfe"
                   "a\0b\0"s),
              HasSubstr("UTF-8"));
  EXPECT_EQ(read_text_file(folder.file("b.toml", "%PDF"), 10, "a design"), "%PDF");
  EXPECT_EQ(read_text_file(folder.file("b.toml", ""), 10, "a design"), "");
}

}  // namespace
}  // namespace perfora::io
