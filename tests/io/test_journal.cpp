// What is here: the promises of the journal: torn lines dropped, damage named, nothing lost by a kill.
// What is not: who may write it (test_lock.cpp), what events mean.
#include "io/files.h"
#include "io/journal.h"

#include <gmock/gmock.h>
#include <signal.h>
#include <sys/wait.h>
#include <unistd.h>

#include <chrono>
#include <thread>

#include "io_support.h"

namespace perfora::io {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;
using testing::StartsWith;

class JournalFile : public testing::Test {
 protected:
  void write(int events) const {
    Journal journal(path);
    for (int k = 0; k < events; ++k) journal.append(event(k));
  }
  std::vector<std::string> read() const { return Journal(path).events(); }
  static std::string event(int k) { return "{\"event\":" + std::to_string(k) + "}"; }

  const TemporaryFolder folder;
  const std::filesystem::path path = folder / "journal.jsonl";
};

TEST_F(JournalFile, KeepsEventsInOrder) {
  EXPECT_THAT(read(), IsEmpty());
  write(2);
  EXPECT_THAT(read(), ElementsAre(event(0), event(1)));
  Journal journal(path);
  journal.append(event(2));
  EXPECT_THAT(journal.events(), ElementsAre(event(0), event(1), event(2)));
}

TEST_F(JournalFile, LineIsChecksumBlankText) {
  Journal(path).append("123456789");
  EXPECT_EQ(read_file(path), "cbf43926 123456789\n");  // check value of CRC-32
}

TEST_F(JournalFile, TornLastLineIsDroppedAtEveryLength) {
  write(3);
  const std::string whole = read_file(path);
  const std::size_t two = whole.size() / 3 * 2;  // equal lines
  for (std::size_t size = two; size < whole.size(); ++size) {
    folder.file("journal.jsonl", whole.substr(0, size));
    EXPECT_THAT(read(), ElementsAre(event(0), event(1)));
    EXPECT_EQ(std::filesystem::file_size(path), two);
    Journal(path).append(event(7));
    EXPECT_THAT(read(), ElementsAre(event(0), event(1), event(7)));
  }
}

TEST_F(JournalFile, LastLineOfZerosIsDropped) {  // what some file systems leave after a power failure
  write(1);
  folder.file("journal.jsonl", read_file(path) + std::string(100, '\0'));
  EXPECT_THAT(read(), ElementsAre(event(0)));
}

TEST_F(JournalFile, FlippedBitInTheMiddleNamesTheLine) {
  write(3);
  const std::string whole = read_file(path);
  const std::size_t line = whole.size() / 3;
  for (std::size_t at = line; at + 1 < 2 * line; ++at) {  // every byte of line 2 but its line break
    std::string damaged = whole;
    damaged[at] = static_cast<char>(damaged[at] ^ 1);
    folder.file("journal.jsonl", damaged);
    EXPECT_THAT(input_error([&] { (void)read(); }),
                StartsWith(path.string() + ":2: this line of the journal is damaged"));
    EXPECT_EQ(read_file(path), damaged);  // refused, not repaired
  }
}

TEST_F(JournalFile, FolderThatIsMissing) {
  EXPECT_THAT(input_error([&] { Journal journal(folder / "none/journal.jsonl"); }),
              HasSubstr("check that its folder exists"));
}

TEST_F(JournalFile, LineBreakInAnEventIsABug) {
  Journal journal(path);
  EXPECT_THROW(journal.append("a\nb"), std::logic_error);
}

/// A child that appends until it is killed, and tells through a pipe how many appends have returned.
pid_t start_writer(const std::filesystem::path& path, int tell) {
  const pid_t child = ::fork();
  if (child != 0) return child;
  try {
    Journal journal(path);
    for (int k = static_cast<int>(journal.events().size());; ++k) {
      journal.append("{\"event\":" + std::to_string(k) + ",\"padding\":\"" + std::string(5000, 'x') + "\"}");
      if (::write(tell, &k, sizeof k) != sizeof k) break;
    }
  } catch (...) {
  }
  ::_exit(1);
}

TEST_F(JournalFile, KilledWriterLosesNothingItHadWritten) {
  for (int round = 0; round < 8; ++round) {
    int ends[2];
    ASSERT_EQ(::pipe(ends), 0);
    const pid_t child = start_writer(path, ends[1]);
    ASSERT_GT(child, 0);
    ::close(ends[1]);
    int last = -1, told = 0;
    ASSERT_EQ(::read(ends[0], &last, sizeof last), static_cast<ssize_t>(sizeof last));
    std::this_thread::sleep_for(std::chrono::microseconds(1000 * round + 137 * round * round));
    ::kill(child, SIGKILL);
    ::waitpid(child, nullptr, 0);
    while (::read(ends[0], &told, sizeof told) == static_cast<ssize_t>(sizeof told)) last = told;
    ::close(ends[0]);
    const std::vector<std::string> events = read();
    ASSERT_GT(events.size(), static_cast<std::size_t>(last));
    for (std::size_t k = 0; k < events.size(); ++k)
      EXPECT_THAT(events[k], StartsWith("{\"event\":" + std::to_string(k) + ","));
  }
}

}  // namespace
}  // namespace perfora::io
