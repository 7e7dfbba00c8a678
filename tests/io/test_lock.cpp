// What is here: one owner of an output at a time, whoever he is: refused with his name, taken over when he is dead,
// never when he may live; no file stays. What is not: which commands lock what (tests/app).
#include "io/lock.h"

#include <fcntl.h>
#include <gmock/gmock.h>
#include <signal.h>
#include <sys/stat.h>
#include <sys/wait.h>
#include <unistd.h>

#include <chrono>
#include <fstream>
#include <nlohmann/json.hpp>
#include <thread>

#include "io/files.h"
#include "io/litter.h"
#include "io_support.h"

namespace perfora::io {
namespace {

using nlohmann::json;
using testing::HasSubstr;
namespace fs = std::filesystem;

class Lock : public testing::Test {
 protected:
  /// A child that takes the lock, tells so and waits to be killed.
  pid_t start_holder() const {
    int ends[2];
    EXPECT_EQ(::pipe(ends), 0);
    const pid_t child = ::fork();
    if (child == 0) {
      try {
        const OutputLock lock(output);
        if (::write(ends[1], "x", 1) == 1) ::pause();
      } catch (...) {
      }
      ::_exit(1);
    }
    ::close(ends[1]);
    char told = 0;
    EXPECT_EQ(::read(ends[0], &told, 1), 1);
    ::close(ends[0]);
    return child;
  }
  static void end(pid_t child) {
    ::kill(child, SIGKILL);
    ::waitpid(child, nullptr, 0);
  }
  json record() const { return json::parse(read_file(lock)); }
  void write(const json& record) const { std::ofstream(lock) << record.dump(); }
  void renewed_before(int seconds) const {
    const timespec times[2] = {{std::time(nullptr) - seconds, 0}, {std::time(nullptr) - seconds, 0}};
    ASSERT_EQ(::utimensat(AT_FDCWD, lock.c_str(), times, 0), 0);
  }
  std::string refusal() const {
    return input_error([&] { OutputLock second(output); });
  }
  std::size_t files() const { return static_cast<std::size_t>(std::distance(fs::directory_iterator(folder / ""), {})); }

  const TemporaryFolder folder;
  const fs::path output = folder / "R.h5", lock = folder / "R.h5.lock";
};

TEST_F(Lock, SaysWhoHoldsTheOutputAndGoesWithTheObject) {
  {
    const OutputLock held(output);
    const json says = record();
    EXPECT_EQ(says.at("process"), ::getpid());
    char host[256] = "";
    ::gethostname(host, sizeof host - 1);
    EXPECT_EQ(says.at("host"), host);
    EXPECT_THAT(says.at("command").get<std::string>(), HasSubstr("test_io"));
    EXPECT_EQ(files(), 1U) << "no temporary stays";
    EXPECT_THAT(refusal(), testing::AllOf(HasSubstr("R.h5: is in use by process " + std::to_string(::getpid())),
                                          HasSubstr(std::string(" on host ") + host), HasSubstr("test_io"),
                                          HasSubstr("last sign of life"), HasSubstr("name another output with -o")));
    EXPECT_EQ(record(), says) << "the refused one leaves it alone";
    EXPECT_EQ(files(), 1U);
  }
  EXPECT_EQ(files(), 0U);
  OutputLock first(output), second;
  second = std::move(first);
  EXPECT_THAT(refusal(), HasSubstr("is in use"));
  second = OutputLock();
  EXPECT_EQ(files(), 0U);
}

TEST_F(Lock, OfALivingOrStoppedProcessIsRespected) {
  const pid_t child = start_holder();
  EXPECT_THAT(refusal(), HasSubstr("is in use by process " + std::to_string(child)));
  ::kill(child, SIGSTOP);
  renewed_before(100000);
  EXPECT_THAT(refusal(), HasSubstr("is in use by process " + std::to_string(child)));
  end(child);
  { const OutputLock held(output); }
  EXPECT_EQ(files(), 0U);
}

TEST_F(Lock, OfADeadProcessIsTakenOverEvenBeforeItIsCollected) {
  const pid_t child = start_holder();
  ::kill(child, SIGKILL);
  for (int k = 0; k < 1000; ++k) {  // It is a zombie until waitpid().
    try {
      OutputLock held(output);
      EXPECT_EQ(record().at("process"), ::getpid());
      break;
    } catch (const InputError&) {
      ASSERT_LT(k, 999);
      std::this_thread::sleep_for(std::chrono::milliseconds(5));
    }
  }
  ::waitpid(child, nullptr, 0);
  EXPECT_EQ(files(), 0U);
}

TEST_F(Lock, NumbersOfProcessesComeAgain) {
  json says;
  {
    const OutputLock held(output);
    says = record();
  }
  says["start"] = "1";  // Another process had this number.
  write(says);
  { const OutputLock held(output); }
  EXPECT_EQ(files(), 0U);
}

TEST_F(Lock, OfAnotherHostIsOnlyTheUsersToRemove) {
  json says;
  {
    const OutputLock held(output);
    says = record();
  }
  says["host"] = "elsewhere";
  says["process"] = 4711;
  write(says);
  renewed_before(1000);
  EXPECT_THAT(refusal(), testing::AllOf(HasSubstr("by process 4711 on host elsewhere"),
                                        HasSubstr("last sign of life 100"), HasSubstr("or remove " + lock.string())));
  fs::remove(lock);
  EXPECT_NO_THROW(OutputLock second(output));
}

TEST_F(Lock, FromBeforeTheLastStartOfThisHostIsTakenOverAfterAMinuteOfSilence) {
  json says;
  {
    const OutputLock held(output);
    says = record();
  }
  says["boot"] = "another";
  write(says);
  EXPECT_THAT(refusal(), HasSubstr("is in use"));  // Two hosts may have one name, and this one was renewed just now.
  renewed_before(100);
  EXPECT_NO_THROW(OutputLock second(output));
  says["space"] = "another container";
  says["boot"] = "another";
  says.erase("boot");
  write(says);
  EXPECT_THAT(refusal(), HasSubstr("is in use"));
}

TEST_F(Lock, ThatCannotBeReadIsRespected) {
  for (const char* text : {"", "{", "[]", "{\"host\": 3}", "{\"process\": \"x\"}"}) {
    folder.file("R.h5.lock", text);
    EXPECT_THAT(refusal(), HasSubstr("is in use")) << text;
  }
  fs::remove(lock);
  fs::create_directory(lock);
  EXPECT_THAT(refusal(), HasSubstr("is in use"));
}

// Many take over a dead one's lock at once: never are there two owners.
TEST_F(Lock, OneTakesOver) {
  const pid_t dead = start_holder();
  end(dead);
  constexpr int contenders = 12, rounds = 30;
  std::vector<pid_t> children;
  for (int k = 0; k < contenders; ++k) {
    children.push_back(::fork());
    if (children.back() != 0) continue;
    for (int round = 0; round < rounds; ++round) {
      try {
        const OutputLock held(output);
        const int mark = ::open((folder / "owner").c_str(), O_CREAT | O_EXCL | O_WRONLY, 0600);
        if (mark < 0) ::_exit(1);  // There is another owner.
        ::close(mark);
        ::usleep(300);
        ::unlink((folder / "owner").c_str());
        if (k % 3 == 0 && round == rounds / 2) ::kill(::getpid(), SIGKILL);  // Leaves a lock of the dead.
      } catch (const InputError&) {
      }
    }
    ::_exit(0);
  }
  for (const pid_t child : children) {
    int status = 0;
    ::waitpid(child, &status, 0);
    EXPECT_TRUE((WIFEXITED(status) && WEXITSTATUS(status) == 0) || WIFSIGNALED(status)) << status;
  }
  { const OutputLock last(output); }
  EXPECT_EQ(files(), 0U);
}

TEST_F(Lock, RemovesWhatKilledWritersOfItsOutputLeft) {
  const pid_t dead = start_holder();
  end(dead);
  const std::string own = temporary_name("").string(), host = own.substr(own.rfind('-'));
  const std::string mark = ".tmp-" + std::to_string(dead) + host;
  for (const std::string& name :
       std::vector<std::string>{"R.h5" + mark, "R.csv" + mark, "R.csv" + own, "S.csv" + mark, std::string("R.tmp-x")})
    folder.file(name, "half");
  const OutputLock held(output);
  EXPECT_FALSE(fs::exists(folder / ("R.h5" + mark)));
  EXPECT_FALSE(fs::exists(folder / ("R.csv" + mark)));
  EXPECT_TRUE(fs::exists(folder / ("R.csv" + own))) << "of a living process";
  EXPECT_TRUE(fs::exists(folder / ("S.csv" + mark))) << "of another output";
  EXPECT_TRUE(fs::exists(folder / "R.tmp-x")) << "no temporary";
}

TEST_F(Lock, FolderThatIsMissingIsMadeAndGoesAgainWhenEmpty) {
  {
    const OutputLock made(folder / "none/R.h5");
    EXPECT_TRUE(std::filesystem::exists(folder / "none/R.h5.lock"));
  }
  EXPECT_FALSE(std::filesystem::exists(folder / "none"));
}

TEST(Litter, GoesWhenASignalEndsTheProcess) {
  const TemporaryFolder folder;
  folder.file("gone", "x");
  folder.file("kept", "x");
  {
    const Litter gone(folder / "gone");
    Litter forgotten(folder / "kept");
    forgotten = Litter();
    const pid_t child = ::fork();  // It must not clean for its parent.
    if (child == 0) {
      remove_litter();
      ::_exit(0);
    }
    ::waitpid(child, nullptr, 0);
    EXPECT_TRUE(fs::exists(folder / "gone"));
    remove_litter();
  }
  EXPECT_FALSE(fs::exists(folder / "gone"));
  EXPECT_TRUE(fs::exists(folder / "kept"));
  std::vector<Litter> many(200);  // more than there is room for
  for (Litter& one : many) one = Litter(folder / "kept");
}

}  // namespace
}  // namespace perfora::io
