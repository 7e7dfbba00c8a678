// What is here: requests, their keys, and what becomes of a request that cannot be met. Nothing numerical is expected.
#include <gmock/gmock.h>

#include <set>

#include "optimize/evaluate/evaluation.h"
#include "tests/optimize/evaluate/design_support.h"

namespace perfora::optimize {
namespace {

TEST(Request, EqualOnesHaveEqualKeysAndOthersNot) {
  const DesignFolder folder;
  const auto path = folder.file("design.toml", small_design);
  const DesignFile design(path), again(path), other(path, {"layout.diameter=6.000001 mm"});
  EXPECT_EQ(make_request(design, 0).key(), make_request(again, 0).key());
  const std::set<std::string> keys = {make_request(design, 0).key(), make_request(design, 1).key(),
                                      make_request(design, 0, 0.5).key(), make_request(other, 0).key()};
  EXPECT_EQ(keys.size(), 4u);
}

TEST(Request, KeyDoesNotDependOnHowADesignIsWritten) {
  const DesignFile plain = DesignFile::from_toml("[layout]\ndiameter = 0.0125\nrows = 4\n", "a");
  const DesignFile units = DesignFile::from_toml("[layout]\nrows = 4\ndiameter = \"12.5 mm\"\n", "b");
  EXPECT_EQ(make_request(plain, 0).key(), make_request(units, 0).key());
}

// A program that did not know damage_form yet wrote no such line, and meant the default.
TEST(Request, KeyStaysWhenTheProgramLearnsAKey) {
  Request request = make_request(DesignFile::from_toml("[layout]\nrows = 4\n", "a"), 0);
  const std::string key = request.key();
  const std::string line = "damage_form = \"linear_damage\"\n";
  ASSERT_NE(request.design_toml.find(line), std::string::npos);
  request.design_toml.erase(request.design_toml.find(line), line.size());
  EXPECT_EQ(request.key(), key);
  request.design_toml = "[material]\ndamage_form = \"linear_force\"\n[layout]\nrows = 4\n";
  EXPECT_NE(request.key(), key);
}

TEST(Request, GoesThroughJson) {
  const Request request = make_request(DesignFile(), 4, 0.45);
  const Request again = request_from_json(nlohmann::json::parse(to_json(request).dump()));
  EXPECT_EQ(again.key(), request.key());
  EXPECT_EQ(again.design_toml, request.design_toml);
}

TEST(Request, WhereARunIsWrittenIsNoPartOfTheKey) {
  Request request = make_request(DesignFile(), 4, 0.45);
  const std::string key = request.key();
  EXPECT_FALSE(to_json(request).contains("run_file"));
  request.run_file = "/somewhere/run.h5";
  request.frames = true;
  EXPECT_EQ(request.key(), key);
  const Request again = request_from_json(to_json(request));
  EXPECT_EQ(again.run_file, request.run_file);
  EXPECT_TRUE(again.frames);
}

// A killed run goes on from its checkpoint; what something else left there is begun again; a finished one is read.
TEST(Request, ARunFileIsGoneOnWith) {
  const DesignFolder folder;
  const DesignFile design(folder.file("design.toml", small_design));
  Request request = make_request(design, 0, 0.01);
  const Evaluation straight = evaluate_request(request, 1);
  ASSERT_EQ(straight.status, results::RunStatus::completed) << straight.reason;
  request.run_file = folder / "run.h5";
  std::filesystem::create_directories(folder / "run.part");
  std::ofstream(folder / "run.part/checkpoint.h5") << "not one";
  std::ofstream(folder / "run.part/config.toml") << "# results_version 0\n";
  const Evaluation written = evaluate_request(request, 1);
  EXPECT_EQ(written.status, results::RunStatus::completed) << written.reason;
  EXPECT_TRUE(std::filesystem::exists(request.run_file));
  EXPECT_FALSE(std::filesystem::exists(folder / "run.part"));
  const Evaluation read = evaluate_request(request, 1);
  for (const Evaluation* one : {&written, &read}) {
    EXPECT_EQ(one->curve.stress_yy, straight.curve.stress_yy);
    EXPECT_EQ(to_json(one->summary), to_json(straight.summary));
  }
  EXPECT_EQ(read.performance.seconds, written.performance.seconds);  // not run again
}

TEST(Request, ADesignThatCannotBeLaidOutFailsWithItsReason) {
  DesignFile design;
  design.design().layout.diameter = 0.024;  // walls of 1 mm
  const Evaluation evaluation = evaluate_request(make_request(design, 2), 1);
  EXPECT_EQ(evaluation.status, results::RunStatus::failed);
  EXPECT_THAT(evaluation.reason, ::testing::HasSubstr("horizon"));
  EXPECT_EQ(evaluation.replicate, 2);
}

}  // namespace
}  // namespace perfora::optimize
