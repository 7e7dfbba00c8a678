// What is here: one evaluation for Dakota through its files, in both forms, held against the program's own answer; what
// fails and what is refused. What is not: Dakota itself, which Debian does not have.
#include <gmock/gmock.h>

#include "tests/app/command_line.h"

namespace perfora::test {
namespace {

using ::testing::HasSubstr;

class Dakota : public CommandLine {
 protected:
  void write(const std::string& name, const std::string& text) const { std::ofstream(folder_ / name) << text; }
  /// As Dakota's manual prints it: values right-justified, tags behind them.
  void write_standard(const std::string& diameter, const std::string& responses, int count) const {
    write("params.in",
          "                                          2 variables\n"
          "                      " +
              diameter +
              " layout.diameter\n"
              "                                     square layout.family\n"
              "                                          " +
              std::to_string(count) + " functions\n" + responses +
              "                                          1 derivative_variables\n"
              "                                          1 DVV_1:layout.diameter\n"
              "                                          0 analysis_components\n"
              "                                          7 eval_id\n");
  }
  std::string results() const { return read_text(folder_ / "results.out"); }
};

TEST_F(Dakota, ResponsesAreTheMeasuresOfTheDesignWithItsVariables) {
  write_standard("5.500000000000000e-03",
                 "  1 ASV_1:plateau_stress\n  0 ASV_2:intermediate_peaks\n  1 ASV_3:porosity\n", 3);
  const Outcome outcome = run("evaluate d.toml --dakota params.in results.out");
  ASSERT_EQ(outcome.exit_code, 0) << outcome.error;
  EXPECT_EQ(outcome.output, "");
  const json record = json::parse(run("evaluate d.toml --set layout.diameter=5.5mm -o r.h5 --json --quiet").output);
  std::istringstream lines(results());
  double plateau = 0.0, porosity = 0.0;
  std::string first, second, more;
  lines >> plateau >> first >> porosity >> second;
  EXPECT_EQ(first, "plateau_stress");
  EXPECT_EQ(second, "porosity");
  EXPECT_EQ(plateau, record.at("plateau_stress").get<double>());
  EXPECT_EQ(porosity, record.at("porosity").get<double>());
  EXPECT_FALSE(lines >> more);
  EXPECT_EQ(run("evaluate d.toml --dakota params.in results.out").exit_code, 1) << "results that are there stay";
  EXPECT_EQ(run("evaluate d.toml --dakota params.in results.out --force").exit_code, 0);
}

TEST_F(Dakota, ApreproFormIsTheSame) {
  write_standard("5.500000000000000e-03", "  1 ASV_1:porosity\n", 1);
  ASSERT_EQ(run("evaluate d.toml --dakota params.in standard.out").exit_code, 0);
  write("params.in",
        "                    { DAKOTA_VARS = 2 }\n                    { layout.diameter = 5.500000000000000e-03 }\n"
        "                    { layout.family = \"square\" }\n                    { DAKOTA_FNS = 1 }\n"
        "                    { ASV_1:porosity = 1 }\n                    { DAKOTA_DER_VARS = 0 }\n"
        "                    { DAKOTA_AN_COMPS = 0 }\n                    { DAKOTA_EVAL_ID = 1 }\n");
  const Outcome outcome = run("evaluate d.toml --dakota params.in results.out");
  ASSERT_EQ(outcome.exit_code, 0) << outcome.error;
  EXPECT_EQ(results(), read_text(folder_ / "standard.out"));
}

TEST_F(Dakota, PointsWithoutAnAnswerFail) {
  write_standard("13e-3", "  1 ASV_1:porosity\n", 1);  // wider than the cell
  const Outcome overlapping = run("evaluate d.toml --dakota params.in results.out --quiet");
  EXPECT_EQ(overlapping.exit_code, 0);
  EXPECT_EQ(results(), "FAIL\n");
  EXPECT_NE(overlapping.error, "");
  write_standard("-1e-3", "  1 ASV_1:porosity\n", 1);
  EXPECT_EQ(run("evaluate d.toml --dakota params.in results.out --force").exit_code, 0);
  EXPECT_EQ(results(), "FAIL\n");
  write_standard("5.5e-3", "  1 ASV_1:porosity\n  1 ASV_2:stroke_at_cap\n", 2);  // there is no cap
  const Outcome early = run("evaluate d.toml --dakota params.in results.out --force");
  EXPECT_EQ(early.exit_code, 0);
  EXPECT_EQ(results(), "FAIL\n");
  EXPECT_THAT(early.error, HasSubstr("stroke_at_cap was not reached"));
}

TEST_F(Dakota, MistakesOfTheStudyAreRefused) {
  const auto error = [&] {
    const Outcome outcome = run("evaluate d.toml --dakota params.in results.out");
    EXPECT_EQ(outcome.exit_code, 1);
    EXPECT_FALSE(fs::exists(folder_ / "results.out"));
    return outcome.error;
  };
  write_standard("5.5e-3", "  1 ASV_1:plateau_stres\n", 1);
  EXPECT_THAT(error(), HasSubstr("did you mean plateau_stress?"));
  write_standard("5.5e-3", "  3 ASV_1:plateau_stress\n", 1);
  EXPECT_THAT(error(), HasSubstr("gradient"));
  write_standard("5.5e-3", "  1 ASV_1:plateau_stress\n", 2);
  EXPECT_THAT(error(), HasSubstr("names no response"));
  write_standard("5.5e-3", "  1 plateau_stress\n", 1);
  EXPECT_THAT(error(), HasSubstr("names no response"));
  write("params.in", "1 variables\n5.5e-3 layout.diametre\n1 functions\n1 ASV_1:porosity\n");
  EXPECT_THAT(error(), HasSubstr("did you mean layout.diameter?"));
  write("params.in", "1 variables\n5.5e-3 layout.diameter\n");
  EXPECT_THAT(error(), HasSubstr("ends too early"));
  write("params.in", "x variables\n");
  EXPECT_THAT(error(), HasSubstr("params.in:1: variables is \"x\""));
  write("params.in", "a text of four words\n");
  EXPECT_THAT(error(), HasSubstr("a parameters file of Dakota is wanted"));
  EXPECT_EQ(run("evaluate d.toml --dakota params.in").exit_code, 1);
  EXPECT_EQ(run("evaluate d.toml --dakota params.in results.out --replicates 2").exit_code, 1);
}

}  // namespace
}  // namespace perfora::test
