// What is here: studies by perfora-mpi as a user starts them: the result of one process, whatever happens to its ranks.
// What is not: other ways to many processes (test_shared_commands.cpp).
#include <cstdlib>

#include "command_line.h"

namespace perfora::test {
namespace {

/// More ranks than processors, and as root in a container: both are refused by Open MPI unless one says so. Its ranks
/// are not bound to cores, which other tests use, too.
constexpr const char* script_head =
    "export OMPI_ALLOW_RUN_AS_ROOT=1 OMPI_ALLOW_RUN_AS_ROOT_CONFIRM=1 OMPI_MCA_rmaps_base_oversubscribe=1\n"
    "export OMPI_MCA_hwloc_base_binding_policy=none OMPI_MCA_btl=self,vader,tcp "
    "OMPI_MCA_btl_vader_single_copy_mechanism=none\n"
    "export PERFORA_MPI='" PERFORA_MPI_PROGRAM "'\n";

class Mpi : public StudyCommands {
 protected:
  void SetUp() override {
    if (std::system("command -v mpirun > /dev/null") != 0) GTEST_SKIP() << "mpirun is missing";
    StudyCommands::SetUp();
    run_by_child_processes();
  }
  /// What is to come out, in the folder "one".
  void run_by_child_processes() {
    fs::remove_all(folder_ / "one");
    ASSERT_EQ(run("optimize s.toml -o one --no-run-file --workers 2 --quiet").exit_code, 0);
  }
  /// The same study with evaluations of a second: long enough to be disturbed.
  void slow_down() {
    std::string design = read_text(folder_ / "d.toml");
    design.replace(design.find("until = 0.01"), 12, "until = 0.2");
    std::ofstream(folder_ / "d.toml") << design;
    run_by_child_processes();
  }
  int shell(const std::string& script) const { return StudyCommands::shell(script_head + script); }
  bool has_finished(const std::string& folder) const {
    return read_text(folder_ / folder / "journal.jsonl").find("\"event\":\"finished\"") != std::string::npos;
  }
  std::string messages() const { return read_text(folder_ / "err.txt"); }
};

TEST_F(Mpi, RanksGiveTheSameResult) {
  EXPECT_EQ(shell("mpirun -n 4 \"$PERFORA_MPI\" optimize s.toml -o many --no-run-file > out.txt 2> err.txt"), 0)
      << messages();
  EXPECT_NE(messages().find("3 ranks to evaluate"), std::string::npos) << messages();
  EXPECT_EQ(result("many"), result("one"));
  EXPECT_EQ(read_text(folder_ / "many" / "best.toml"), read_text(folder_ / "one" / "best.toml"));
  EXPECT_EQ(shell("mpirun -n 3 \"$PERFORA_MPI\" optimize s.toml -o two --no-run-file --workers 1 > out.txt 2> err.txt"),
            0)
      << messages();
  EXPECT_EQ(result("two"), result("one"));
}

TEST_F(Mpi, AKilledRankEndsTheJobAndResumeGoesOn) {
  slow_down();
  // The youngest process is a rank that evaluates; the study is under way when its journal has an evaluation.
  EXPECT_NE(
      shell(
          "mpirun -n 3 \"$PERFORA_MPI\" optimize s.toml -o many --no-run-file > out.txt 2> err.txt & job=$!\n"
          "for i in $(seq 600); do grep -qs '\"event\":\"evaluation\"' many/journal.jsonl && break; sleep 0.05; done\n"
          "kill -9 $(pgrep -n -f \"$PERFORA_MPI optimize s.toml -o many\")\nwait $job"),
      0);
  ASSERT_TRUE(fs::exists(folder_ / "many" / "journal.jsonl")) << messages();
  if (has_finished("many")) GTEST_SKIP() << "it was killed too late to tell";
  EXPECT_EQ(run("optimize s.toml -o many --no-run-file --resume --quiet").exit_code, 0);
  EXPECT_EQ(result("many"), result("one"));
}

TEST_F(Mpi, AStoppedJobGoesOn) {
  slow_down();  // mpirun takes a second to pass the signal on
  EXPECT_NE(
      shell(
          "mpirun -n 3 \"$PERFORA_MPI\" optimize s.toml -o many --no-run-file > out.txt 2> err.txt & job=$!\n"
          "for i in $(seq 600); do grep -qs '\"event\":\"evaluation\"' many/journal.jsonl && break; sleep 0.05; done\n"
          "kill -TERM $job\nwait $job"),
      0);
  if (has_finished("many")) GTEST_SKIP() << "it was stopped too late to tell";
  EXPECT_EQ(shell("mpirun -n 2 \"$PERFORA_MPI\" optimize s.toml -o many --no-run-file --resume > out.txt 2> err.txt"),
            0)
      << messages();
  EXPECT_EQ(result("many"), result("one"));
}

TEST_F(Mpi, TimeLimitsAreTroubles) {
  EXPECT_EQ(
      shell(
          "mpirun -n 2 \"$PERFORA_MPI\" optimize s.toml -o many --no-run-file --time-limit 0.001 > out.txt 2> err.txt"),
      3)
      << messages();
  EXPECT_NE(messages().find("took more than 0.001 s (time_limit), 3 times in a row"), std::string::npos) << messages();
  EXPECT_EQ(run("optimize s.toml -o many --no-run-file --resume --quiet").exit_code, 0);
  EXPECT_EQ(result("many"), result("one"));
}

TEST_F(Mpi, OneRankAloneIsRefused) {
  EXPECT_EQ(shell("mpirun -n 1 \"$PERFORA_MPI\" optimize s.toml -o many --no-run-file > out.txt 2> err.txt"), 1);
  EXPECT_NE(messages().find("mpirun -n 4 perfora-mpi"), std::string::npos) << messages();
}

}  // namespace
}  // namespace perfora::test
