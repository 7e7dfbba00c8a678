// What is here: requests, their keys, and what becomes of a request that cannot be met. Nothing numerical is expected.
#include <gmock/gmock.h>

#include <set>

#include "io/text.h"
#include "optimize/evaluate/request.h"
#include "tests/optimize/evaluate/design_support.h"

namespace perfora::optimize {
namespace {

TEST(Request, EqualOnesHaveEqualKeysAndOthersNot) {
  const DesignFolder folder;
  const auto path = folder.file("design.toml", small_design);
  const DesignFile design(path), again(path), other(path, {"layout.diameter=6.000001 mm"});
  EXPECT_EQ(make_request(design, 0).key(), make_request(again, 0).key());
  const std::set<std::string> keys = {make_request(design, 0).key(), make_request(design, 1).key(),
                                      make_request(other, 0).key()};
  EXPECT_EQ(keys.size(), 3u);
}

/// A value that the key accepts and that is not its default.
void perturb(io::Schema& schema, const io::Key& key) {
  std::vector<io::Value> values{{true},
                                {false},
                                {std::string("elsewhere.csv")},
                                {io::ValueList{{0.31}}},
                                {io::ValueList{{io::ValueList{{0.01}, {0.02}, {0.003}}}}},
                                {io::ValueList{{io::ValueList{{0.01}, {0.02}}}}}};
  for (const std::string& choice : key.choices) values.push_back({choice});
  for (const double number : {0.31, 2.0, 3.0, 0.003, 17.0, 0.6}) values.push_back({number});
  for (const io::Value& value : values) {
    try {
      schema.set(key.full_name(), value, {"test", 0, ""});
    } catch (const io::InputError&) {
      continue;
    }
    if (!key.at_default()) return;
  }
  ADD_FAILURE() << "no other value for " << key.full_name();
}

// Whatever changes what happens in a run changes its key; what only reads or writes it, or ends it, does not.
TEST(Request, EveryKeyThatChangesThePathChangesTheKey) {
  const std::set<std::string> beside_the_path = {"output.frames",
                                                 "output.frame_strains",        // writing a frame has no side effect
                                                 "output.checkpoint_interval",  // nor has a checkpoint
                                                 "output.curve",                // drawn beside the run
                                                 "material.grade",              // the same states (theory.md)
                                                 "material.characteristic_length",  // only printed
                                                 "material.from",  // other keys take what its file says
                                                 "loading.until",  // the path up to there is the same
                                                 "seeds.search",   // no simulation draws from it
                                                 "material_test.size",
                                                 "material_test.tension",  // of the tests of the solid material
                                                 "material_test.compression",
                                                 "material_test.shear",  //
                                                 "material_test.oedometric",
                                                 "material_test.past_peak"};
  const std::string key = make_request(DesignFile(), 0).key();
  std::set<std::string> keys = {key}, found;
  const DesignFile defaults;
  for (const io::Key& one : defaults.schema().keys()) {
    DesignFile design;
    const bool read_at_once = one.full_name() == "material.from" || one.full_name() == "target.curve";
    if (!read_at_once) perturb(design.schema(), *design.schema().find(one.full_name()));
    const std::string other = make_request(design, 0).key();
    const bool of_the_curve = one.section == "measures" || one.section.starts_with("target");
    if (of_the_curve)
      EXPECT_EQ(other, key) << one.full_name() << " is read from the finished curve";
    else if (other == key)
      found.insert(one.full_name());
    else
      EXPECT_TRUE(keys.insert(other).second) << one.full_name() << " has the key of another change";
  }
  EXPECT_EQ(found, beside_the_path);
}

TEST(Request, HowFarItGoesIsNoPartOfTheKeyButOfTheFullOne) {
  const DesignFile design;
  const Request near = make_request(design, 0, 0.3), far = make_request(design, 0, 0.5);
  EXPECT_EQ(near.key(), far.key());
  EXPECT_NE(near.full_key(), far.full_key());
  EXPECT_EQ(near.strain(), 0.3);
  EXPECT_EQ(make_request(design, 0).strain(), design.design().solver.loading.until);
}

TEST(Request, KeyDoesNotDependOnHowADesignIsWritten) {
  const DesignFile plain = DesignFile::from_toml("[layout]\ndiameter = 0.0125\nrows = 4\n", "a");
  const DesignFile units = DesignFile::from_toml("[layout]\nrows = 4\ndiameter = \"12.5 mm\"\n", "b");
  EXPECT_EQ(make_request(plain, 0).key(), make_request(units, 0).key());
}

// A program that did not know damage_form yet wrote no such line, and meant the default.
TEST(Request, KeyStaysWhenTheProgramLearnsAKey) {
  const Request request = make_request(DesignFile::from_toml("[layout]\nrows = 4\n", "a"), 0);
  nlohmann::json record = to_json(request);
  std::string text = record.at("design");
  const std::string line = "damage_form = \"linear_damage\"\n";
  ASSERT_NE(text.find(line), std::string::npos);
  record["design"] = text.erase(text.find(line), line.size());
  EXPECT_EQ(request_from_json(record).key(), request.key());
  record["design"] = "[material]\ndamage_form = \"linear_force\"\n[layout]\nrows = 4\n";
  EXPECT_NE(request_from_json(record).key(), request.key());
}

// Holes from a file: the key changes with what the file holds, and not with where it lies; a request that was written
// down before the file changed keeps its key, and is not answered with other holes.
TEST(Request, FilesCountByWhatTheyHold) {
  const DesignFolder here, there;
  std::string text = small_design;
  text.replace(text.find("family = \"square\""), std::string("family = \"square\"").size(),
               "family = \"list\"\nfile = \"holes.csv\"");
  const auto written = [&](const DesignFolder& folder, const char* diameter) {
    folder.file("holes.csv", std::string("x,y,diameter\n0.006,0.006,") + diameter + "\n");
    return DesignFile(folder.file("design.toml", text));
  };
  const Request six = make_request(written(here, "0.006"), 0), moved = make_request(written(there, "0.006"), 0);
  EXPECT_EQ(moved.key(), six.key());
  EXPECT_EQ(moved.full_key(), six.full_key());
  EXPECT_TRUE(same_configuration(to_json(six).at("design"), DesignFile(*moved.design)));
  const nlohmann::json record = to_json(six);
  const Request five = make_request(written(here, "0.005"), 0);
  EXPECT_NE(five.key(), six.key());
  EXPECT_NE(five.full_key(), six.full_key());
  EXPECT_FALSE(same_configuration(record.at("design"), DesignFile(*five.design)));
  const Request again = request_from_json(record);
  EXPECT_EQ(again.key(), six.key());
  // Not a failed design, which a journal would keep: the request is tried again once the file is back.
  EXPECT_THROW(static_cast<void>(evaluate_request(again, 1)), io::SurroundingsError);
  const std::string refused = complaint([&] { DesignFile(*again.design).require_valid(); });
  EXPECT_NE(refused.find("layout.file_checksum"), std::string::npos) << refused;
  EXPECT_NE(refused.find("put the earlier file back"), std::string::npos) << refused;
}

TEST(Request, GoesThroughJson) {
  const Request request = make_request(DesignFile(), 4, 0.45);
  const Request again = request_from_json(nlohmann::json::parse(to_json(request).dump()));
  EXPECT_EQ(again.key(), request.key());
  EXPECT_EQ(again.until, 0.45);
  EXPECT_EQ(again.replicate, 4);
  EXPECT_EQ(to_json(again), to_json(request));
  EXPECT_FALSE(to_json(request).contains("fidelity"));
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
