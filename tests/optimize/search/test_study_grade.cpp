// What is here: a search over the grade of the material with real simulations: how many it takes, and what candidates
// get. What is not: the similarity itself (tests/optimize/evaluate/test_grade.cpp).
#include <gtest/gtest.h>

#include <atomic>

#include "io/progress.h"
#include "optimize/search/study_run.h"
#include "tests/optimize/search/study_support.h"

namespace perfora::optimize {
namespace {

/// One hole of 6 mm in 12 x 12 mm, some 380 discs, pressed fast.
const char* const block =
    "[cell]\nwidth = \"12 mm\"\nheight = \"12 mm\"\n[layout]\nrows = 1\ncolumns = 1\ndiameter = \"6 mm\"\n"
    "[packing]\nsolid_fraction = 0.719\n[loading]\nuntil = 0.1\ntransits = 2\n";

class StudyOfGrade : public testing::Test {
 protected:
  StudyFolder folder;
  std::atomic<int> simulated = 0;
  void SetUp() override {
    io::set_verbosity(io::Verbosity::quiet);
    folder.file("design.toml", block);
  }
  void TearDown() override { io::set_verbosity(io::Verbosity::normal); }

  Study study(const std::string& target) {
    return read_study(folder.file("study.toml",
                                  "[study]\ndesign = \"design.toml\"\nalgorithm = \"GN_DIRECT_L\"\nmaxeval = 12\n"
                                  "replicates = 1\nfinal_replicates = 1\n[target]\nwindow = [0.02, 0.06]\n"
                                  "plateau_stress = " +
                                      target + "\n[variables]\n\"material.grade\" = [0.5, 8.5]\n"));
  }
  WorkOptions options(const std::string& name, bool resume = false) {
    WorkOptions made;
    made.folder = folder / name;
    made.resume = resume;
    made.make_executor = [this] {
      return make_in_process_executor(
          [this](const Request& request) {
            ++simulated;
            return evaluate_request(request, 1);
          },
          1);
    };
    return made;
  }
};

// The plateau of grade g is g times that of grade 1 (theory.md), whichever candidate was simulated.
TEST_F(StudyOfGrade, OneSimulationASeedServesAllCandidates) {
  const Study probe = study("\"1 MPa\"");
  const double of_one = evaluate_request(make_request(*probe.start, 0), 1).summary.plateau_stress;
  ASSERT_GT(of_one, 0.0);
  for (const bool resume : {false, true}) {
    StudyRun run(study(std::to_string(3.7 * of_one)), options("out", resume));
    run.run();
    EXPECT_EQ(simulated, 2) << "the seed of the search, and the fresh one";
    int candidates = 0;
    for (const Trace& trace : run.plan().traces)
      for (const Visit& visit : trace.visits) {
        ASSERT_TRUE(visit.answered && visit.detail.valid);
        EXPECT_NEAR(visit.detail.plateau_mean / (visit.candidate->values.front() * of_one), 1.0, 1e-12);
        ++candidates;
      }
    EXPECT_EQ(candidates, 12);
  }
}

// A measured curve of half the computed stresses is a grade of 0.5: the folder of the study serves the one of that
// grade (docs/user/tutorial-mortar.md, section 6).
TEST_F(StudyOfGrade, FolderServesTheStudyOfAnotherGrade) {
  const std::string text =
      "[study]\ndesign = \"design.toml\"\nalgorithm = \"GN_DIRECT_L\"\nmaxeval = 1\nreplicates = 1\n"
      "final_replicates = 0\n[target]\nwindow = [0.02, 0.06]\nplateau_stress = \"1 MPa\"\n"
      "[variables]\n\"layout.diameter\" = [\"5 mm\", \"7 mm\"]\n";
  StudyRun first(read_study(folder.file("study.toml", text)), options("out"));
  first.run();
  const double of_one = first.plan().traces.front().visits.front().detail.plateau_mean;
  ASSERT_GT(of_one, 0.0);
  const int before = simulated;
  const std::string half = text + "[map]\nfrom = \"out\"\n[set]\nmaterial.grade = 0.5\n";
  StudyRun second(read_study(folder.file("half.toml", half)), options("half"));
  second.run();
  EXPECT_EQ(simulated, before);
  EXPECT_NEAR(second.plan().traces.front().visits.front().detail.plateau_mean / of_one, 0.5, 1e-12);
}

}  // namespace
}  // namespace perfora::optimize
