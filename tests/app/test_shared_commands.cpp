// What is here: evaluations left to other processes as a user starts them: workers, the job array's script, requests
// taken and answered by hand, each with the result of one process. What is not: kills at every
// moment (tests/optimize/search/test_shared.cpp).
#include "command_line.h"

namespace perfora::test {
namespace {

class SharedCommands : public StudyCommands {};

TEST_F(SharedCommands, WorkersOfAFolderGiveTheSameResult) {
  ASSERT_EQ(run("optimize s.toml -o one --no-run-file --workers 2 --quiet").exit_code, 0);
  // One of three is killed while it works.
  EXPECT_EQ(shell("\"$PERFORA\" work many --wait 60 --quiet & first=$!\n"
                  "\"$PERFORA\" work many --wait 60 --quiet & second=$!\n"
                  "\"$PERFORA\" work many --wait 60 --quiet & killed=$!\n"
                  "( sleep 1; kill -9 $killed ) 2>/dev/null &\n"
                  "\"$PERFORA\" optimize s.toml -o many --no-run-file --shared > out.txt 2> err.txt || exit 9\n"
                  "wait $first || exit 8\nwait $second || exit 7"),
            0)
      << read_text(folder_ / "err.txt");
  EXPECT_EQ(result("many"), result("one"));
  EXPECT_FALSE(fs::exists(folder_ / "many" / "shared"));
  EXPECT_EQ(run("work many").exit_code, 0) << "there is nothing left";
  // The job array, as Slurm starts it; its first task draws the best design, too.
  const std::string script = PERFORA_SOURCE_DIR "/docs/user/slurm-array.sh";
  EXPECT_EQ(shell("SLURM_ARRAY_TASK_MIN=0 SLURM_ARRAY_TASK_ID=1 sh " + script +
                  " s.toml array 2>/dev/null & other=$!\n" + "SLURM_ARRAY_TASK_MIN=0 SLURM_ARRAY_TASK_ID=0 sh " +
                  script + " s.toml array > out.txt 2> err.txt || exit 9\nwait $other || exit 8"),
            0)
      << read_text(folder_ / "err.txt");
  EXPECT_EQ(result("array"), result("one"));
  EXPECT_TRUE(fs::exists(folder_ / "array" / "best.h5"));
}

TEST_F(SharedCommands, RequestsAreTakenAndAnsweredByHand) {
  ASSERT_EQ(run("optimize s.toml -o one --no-run-file --workers 2 --quiet").exit_code, 0);
  EXPECT_EQ(shell("\"$PERFORA\" optimize s.toml -o many --no-run-file --shared > out.txt 2> err.txt & asks=$!\n"
                  "\"$PERFORA\" ask many --wait 60 -o job.json || exit 9\n"
                  "\"$PERFORA\" ask many --wait 60 > other.json || exit 8\n"
                  "cmp -s job.json other.json && exit 7\n"
                  "\"$PERFORA\" worker < job.json > answer.jsonl || exit 6\n"
                  "\"$PERFORA\" tell many other.json job.json 2> wrong.txt && exit 5\n"
                  "\"$PERFORA\" tell many job.json answer.jsonl || exit 4\n"
                  "\"$PERFORA\" ask many --again > again.json || exit 3\n"
                  "\"$PERFORA\" worker < other.json > answer.jsonl || exit 6\n"
                  "\"$PERFORA\" tell many other.json answer.jsonl || exit 2\n"
                  "rm -f many/shared/claims/*\n"  // by the word of the user: nobody answers what was taken again
                  "\"$PERFORA\" work many --quiet || exit 1\nwait $asks"),
            0)
      << read_text(folder_ / "err.txt");
  EXPECT_EQ(result("many"), result("one"));
  EXPECT_NE(read_text(folder_ / "wrong.txt").find("is no evaluation"), std::string::npos);
  EXPECT_EQ(run("tell many job.json answer.jsonl").exit_code, 1) << "nobody asks any more";
  EXPECT_EQ(run("ask many").output, "");
}

}  // namespace
}  // namespace perfora::test
