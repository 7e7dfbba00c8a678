// What is here: the whole way of one small design: packing files, run files, resume. Expected: agreement between ways
// that must agree bit for bit.
#include "optimize/evaluate/evaluation.h"
#include "optimize/evaluate/pack_file.h"
#include "optimize/evaluate/request.h"

#include <gmock/gmock.h>

#include "geometry/packing_file.h"
#include "io/hdf5.h"
#include "optimize/evaluate/estimate.h"
#include "optimize/evaluate/packing_cache.h"
#include "solver/bond_network.h"
#include "tests/optimize/evaluate/design_support.h"

namespace perfora::optimize {
namespace {

using ::testing::HasSubstr;

class Evaluating : public ::testing::Test {
 protected:
  DesignFile design(const std::vector<std::string>& overrides = {}) const {
    return DesignFile(folder_.file("design.toml", small_design), overrides);
  }
  /// Everything but what depends on the clock.
  static nlohmann::json comparable(const Evaluation& evaluation) {
    auto record = to_json(evaluation, true);
    record.erase("performance");
    return record;
  }
  DesignFolder folder_;
};

TEST_F(Evaluating, GivesAResultThatIsWhole) {
  const Evaluation evaluation = evaluate_design(design(), {}, 0);
  EXPECT_EQ(evaluation.status, results::RunStatus::completed);
  EXPECT_EQ(evaluation.pack.perforations, 1);
  EXPECT_NEAR(evaluation.pack.thinnest_wall.thickness, 0.006, 1e-12);
  EXPECT_NEAR(evaluation.summary.final_strain, 0.01, 1e-9);
  EXPECT_GT(evaluation.pack.bonds_per_disc, 10.0);
  EXPECT_EQ(evaluation.curve.strain_yy.size(), 21u);  // 0.01 in rows of 5e-4, and the start
}

TEST_F(Evaluating, APackingFromItsFileGivesTheSameBits) {
  const DesignFile file = design();
  const PackedDesign packed = pack_design(file, {}, 0);
  const auto record = pack_record(packed, file.design().seeds.effective(0), {});
  write_pack_file(folder_ / "p.h5", file, packed, record, "perfora pack");
  const Evaluation made = evaluate_design(file, {}, 0);
  EvaluateOptions options;
  options.packing_file = folder_ / "p.h5";
  EXPECT_EQ(comparable(evaluate_design(file, options, 0)), comparable(made));
  EXPECT_EQ(record["bonds_per_disc"], to_json(made, false)["bonds_per_disc"]);
  EXPECT_EQ(io::Hdf5Reader(folder_ / "p.h5").attribute_text("/", "format"), "perfora.pack/1");
}

TEST_F(Evaluating, AnotherPackingIsRefusedWithBothValues) {
  const DesignFile file = design();
  const PackedDesign packed = pack_design(file, {}, 0);
  write_pack_file(folder_ / "p.h5", file, packed, pack_record(packed, {}, {}), "");
  const DesignFile other = design({"seeds.packing=77"});
  const std::string text = complaint([&] { require_packing_file(other, folder_ / "p.h5", 0); });
  EXPECT_THAT(text, HasSubstr("77"));
  EXPECT_THAT(text, HasSubstr(std::to_string(file.design().seeds.effective(0).packing)));
}

// Discs clipped elsewhere by a slot of 5 x 1 mm across the edge: without being told of it bonds span the slot, which is
// narrower than a bond is long; told by a list none does, and porosity and walls know it.
TEST_F(Evaluating, AnImportedPackingCanBeGivenItsOpenings) {
  folder_.file("holes.csv", "shape,x,y,diameter,breadth,angle\nslot,11 mm,6 mm,5 mm,1 mm,30 deg\n");
  const std::vector<std::string> list{"layout.family=list", "layout.file=" + (folder_ / "holes.csv").string()};
  const PackedDesign native = pack_design(design(list), {}, 0);
  {
    std::ofstream csv(folder_ / "discs.csv");
    csv.precision(17);
    csv << "x,y,radius\n";
    for (std::size_t k = 0; k < native.clipped.x.size(); ++k)
      csv << native.clipped.x[k] << ',' << native.clipped.y[k] << ',' << native.clipped.radius[k] << '\n';
  }
  const std::string import = "packing.file=" + (folder_ / "discs.csv").string();
  const DesignFile told = design({list[0], list[1], import});
  const PackedDesign with = pack_design(told, {}, 0),
                     without = pack_design(design({"layout.family=none", import}), {}, 0);
  EXPECT_EQ(with.clipped.size(), native.clipped.size());
  EXPECT_EQ(with.summary.porosity, native.summary.porosity);
  EXPECT_EQ(with.summary.thinnest_wall.thickness, native.summary.thinnest_wall.thickness);
  const double diameter = with.periodic.mean_diameter();
  const auto spanning = [&](const geometry::PerforationLayout& layout) {
    const solver::BondNetwork net = solver::make_bond_network(with.clipped, layout, {}, {}, 1, diameter);
    int count = 0;
    for (std::size_t b = 0; b < net.i.size(); ++b)
      for (const geometry::Perforation& hole : with.layout.cut_out(true, true))
        for (const double turn : {-1.0, 0.0, 1.0}) {  // bonds across the upright edges, too
          const double x = with.clipped.x[static_cast<std::size_t>(net.i[b])] + turn * 0.012,
                       y = with.clipped.y[static_cast<std::size_t>(net.i[b])];
          const double dip = hole.segment_depth(x, y, x + net.reference_length[b] * net.direction_x[b],
                                                y + net.reference_length[b] * net.direction_y[b]);
          count += dip > (0.25 + 1e-9) * diameter ? 1 : 0;
        }
    return count;
  };
  EXPECT_EQ(spanning(with.layout), 0);
  EXPECT_GT(spanning(without.layout), 20);
  EXPECT_LT(with.summary.bonds_per_disc, without.summary.bonds_per_disc);
  EXPECT_EQ(estimate_design(told, 1).discs, with.clipped.size());
}

TEST_F(Evaluating, ReplicatesDifferAndRepeat) {
  const DesignFile file = design();
  const auto first = comparable(evaluate_design(file, {}, 0)), second = comparable(evaluate_design(file, {}, 1));
  EXPECT_NE(first["curve"], second["curve"]);
  clear_packing_cache();
  EXPECT_EQ(comparable(evaluate_design(file, {}, 1)), second);
}

TEST_F(Evaluating, ARequestIsTheSameEvaluation) {
  const DesignFile file = design();
  EXPECT_EQ(comparable(evaluate_request(make_request(file, 1), 1)), comparable(evaluate_design(file, {}, 1)));
}

TEST_F(Evaluating, TheRunFileHoldsItsSummaryAndAFinishedRunIsNotRunAgain) {
  const DesignFile file = design();
  EvaluateOptions options;
  options.run_file = folder_ / "r.h5";
  const Evaluation made = evaluate_design(file, options, 0);
  const auto written = std::filesystem::last_write_time(options.run_file);
  EXPECT_EQ(nlohmann::json::parse(io::Hdf5Reader(options.run_file).text("/summary")), evaluation_record(file, made));
  options.resume = true;
  EXPECT_EQ(to_json(evaluate_design(file, options, 0), true), to_json(made, true));
  EXPECT_EQ(std::filesystem::last_write_time(options.run_file), written);
  EXPECT_THAT(complaint([&] { static_cast<void>(evaluate_design(design({"loading.rate=41"}), options, 0)); }),
              HasSubstr("another design"));
  EXPECT_THAT(complaint([&] { static_cast<void>(evaluate_design(file, options, 1)); }), HasSubstr("another design"));
}

TEST_F(Evaluating, ASummaryThatAnotherProgramChangedIsRefusedInASentence) {
  EvaluateOptions options;
  options.run_file = folder_ / "r.h5";
  nlohmann::json record = to_json(evaluate_design(design(), options, 0), false);
  record["status"] = 3;
  io::Hdf5Writer writer(options.run_file);
  writer.text("/summary", record.dump());
  writer.text("/config", "");
  writer.commit();
  EXPECT_THAT(complaint([&] { static_cast<void>(finished_evaluation(design(), options.run_file, 0)); }),
              HasSubstr("its /summary is not one that this program wrote"));
}

TEST_F(Evaluating, AWallTimeLimitStopsAndResumeGivesTheSameBits) {
  const DesignFile file = design();
  const Evaluation straight = evaluate_design(file, {}, 0);
  EvaluateOptions options;
  options.run_file = folder_ / "r.h5";
  options.wall_time_limit = 1e-9;
  const Evaluation stopped = evaluate_design(file, options, 0);
  EXPECT_EQ(stopped.status, results::RunStatus::stopped);
  EXPECT_FALSE(finished_evaluation(file, options.run_file, 0).has_value());
  options.wall_time_limit = 0.0;
  options.resume = true;
  EXPECT_EQ(comparable(evaluate_design(file, options, 0)), comparable(straight));
}

TEST(Evaluation, FailureLeavesNothingReached) {
  const auto record = results::to_json(failed_evaluation("packing not reached", 2), false);
  EXPECT_EQ(record["status"], "failed");
  EXPECT_EQ(record["reason"], "packing not reached");
  EXPECT_TRUE(record["first_peak_stress"].is_null());
  EXPECT_TRUE(record["plateau_stress"].is_null());
  EXPECT_TRUE(record["solid_fraction"].is_null());
  EXPECT_EQ(results::evaluation_from_json(record).status, results::RunStatus::failed);
}

}  // namespace
}  // namespace perfora::optimize
