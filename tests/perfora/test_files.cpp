// What is here: whole result files of the public face against what the rooms read. What is not: the formats
// (tests/results).
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "optimize/evaluate/elastic_response.h"
#include "perfora/evaluate.h"
#include "perfora/files.h"
#include "results/run_file.h"
#include "tests/perfora/face_support.h"

namespace perfora {
namespace {

using ::testing::HasSubstr;

TEST(PublicFiles, RunHoldsDiscsBondsBreaksAndFrames) {
  const DesignFolder folder;
  EvaluateOptions options;
  options.run_file = folder / "r.h5";
  Design design = small_block();
  design.set("loading.until", "3 %");  // beyond the first broken bond
  const Evaluation made = evaluate(design, options);
  const results::RunResult wanted = results::read_run(options.run_file);
  const RunFile file(options.run_file);
  EXPECT_EQ(file.run().evaluation.to_json(), made.to_json());
  EXPECT_EQ(file.discs().x, wanted.clipped.x);
  EXPECT_EQ(file.openings().size(), 1U);
  EXPECT_EQ(file.bonds().discs, wanted.bonds.pairs);
  ASSERT_GT(wanted.events.size(), 0U);
  ASSERT_EQ(file.events().rows(), wanted.events.size());
  const results::BreakEvent& last = wanted.events.back();
  EXPECT_EQ(file.events().values("strain").back(), last.strain);
  EXPECT_EQ(file.events().values("bond").back(), last.bond);
  EXPECT_EQ(file.events().values("mode").back(), static_cast<double>(last.mode));
  ASSERT_EQ(file.frames(), wanted.frames.size());
  const Frame frame = file.frame(file.frames() - 1);
  const results::Frame of_room = results::read_frame(wanted, file.frames() - 1);
  EXPECT_EQ(frame.position, of_room.position);
  EXPECT_EQ(frame.bonds, of_room.bond_pairs);
  EXPECT_EQ(frame.strain, of_room.info.strain);
  EXPECT_EQ(frame.height, of_room.info.h_yy);
  EXPECT_EQ(frame.fragment.size(), file.discs().x.size());
  EXPECT_THAT(error_of([&] { static_cast<void>(file.frame(file.frames())); }), HasSubstr("has no frame"));
  EXPECT_NE(error_of([] { RunFile("/nowhere/r.h5"); }), "");
}

TEST(PublicFiles, FramesHoldVelocitiesAndForcesWhereTheRunKeptThem) {
  const DesignFolder folder;
  EvaluateOptions options;
  options.run_file = folder / "r.h5";
  Design design = small_block();
  design.set("loading.until", "1 %");
  static_cast<void>(evaluate(design, options));
  const RunFile few(options.run_file);
  EXPECT_TRUE(few.frame(0).stress.empty());
  options.run_file = folder / "all.h5";
  design.set("output.frame_data", "all");
  static_cast<void>(evaluate(design, options));
  const RunFile all(options.run_file);
  const Frame frame = all.frame(all.frames() - 1);
  const results::Frame of_room = results::read_frame(results::read_run(options.run_file), all.frames() - 1);
  const std::size_t discs = all.discs().x.size(), bonds = frame.bonds.size() / 2;
  ASSERT_EQ(frame.stress.size(), 3 * discs);
  EXPECT_EQ(frame.stress, of_room.stress);
  EXPECT_EQ(frame.velocity, of_room.velocity);
  EXPECT_EQ(frame.spin.size(), discs);
  EXPECT_EQ(frame.bond_normal_force.size(), bonds);
  EXPECT_EQ(frame.bond_shear_force.size(), bonds);
  EXPECT_EQ(frame.contacts, of_room.contact_pairs);
  EXPECT_EQ(frame.contact_normal_force.size(), frame.contacts.size() / 2);
  EXPECT_EQ(frame.contact_shear_force.size(), frame.contacts.size() / 2);
}

TEST(PublicFiles, ElasticResponseIsTheFilesOne) {
  const DesignFolder folder;
  const auto design = optimize::DesignFile::from_toml(optimize::small_design, "design");
  const auto response = optimize::elastic_response(design, {}, 0);
  optimize::write_elastic_file(folder / "e.h5", design, response, optimize::to_json(response), "");
  const ElasticResponse read = read_elastic(folder / "e.h5");
  EXPECT_EQ(read.discs.x, response.packed.clipped.x);
  EXPECT_EQ(read.displacement[1].size(), 3 * read.discs.x.size());
  EXPECT_GT(read.stiffness[4], 0.0);
  EXPECT_GT(read.affine_stiffness[4], read.stiffness[4]);                       // relaxation makes it softer
  EXPECT_NEAR(read.stiffness[1], read.stiffness[3], 1e-6 * read.stiffness[4]);  // symmetric, as the solver converges
  EXPECT_THAT(read.record, HasSubstr("perfora.elastic/1"));
  EXPECT_EQ(Design::from_toml(read.design).to_toml(), small_block().to_toml());
  EXPECT_NE(error_of([&] { static_cast<void>(read_material_tests(folder / "e.h5")); }), "");
}

TEST(PublicFiles, StopIsHeardByPackingsAndRuns) {
  const auto stop = std::make_shared<Stop>();
  EXPECT_FALSE(stop->requested());
  stop->request();
  EXPECT_TRUE(stop->requested());
  PackOptions packing;
  packing.stop = stop;
  Design design = small_block();
  design.set("seeds.seed", 977);  // one that is not remembered
  const Packing none = pack(design, packing);
  EXPECT_EQ(none.status, Status::stopped);
  EXPECT_TRUE(none.discs.x.empty());
  EvaluateOptions run;
  run.stop = stop;
  EXPECT_EQ(evaluate(design, run).status, Status::stopped);
}

}  // namespace
}  // namespace perfora
