// What is here: designs changed as a workshop changes them, by closed forms; the analysis of such blocks with formulas
// for simulations. What is not: real simulations, the command.
#include <gmock/gmock.h>

#include <cmath>
#include <numbers>
#include <set>

#include "geometry/layout.h"
#include "optimize/campaign/tolerance_result.h"
#include "tests/optimize/campaign/sweep_support.h"

namespace perfora::optimize {
namespace {

using geometry::Circle;
using geometry::Perforation;

std::vector<Perforation> holes_of(const Design& design) {
  return geometry::place_perforations(design.layout, design.seeds.effective(0).layout).perforations;
}

double diameter_of(const Perforation& hole) {
  return std::get<Circle>(hole.shape).diameter;
}

/// 20 x 20 circles of 16 mm, 50 mm apart.
DesignFile many_holes() {
  Design design;
  design.layout.width = design.layout.height = 1.0;
  design.layout.rows = design.layout.columns = 20;
  design.layout.diameter = 0.016;
  return DesignFile(design);
}

TEST(Deviation, EveryHoleHasASizeOfItsOwn) {
  const DesignFile design = many_holes();
  const auto nominal = holes_of(design.design());
  const auto changed = holes_of(deviated(design, Deviation::hole_size, 0.2e-3, 5));
  ASSERT_EQ(changed.size(), nominal.size());
  double sum = 0.0, squares = 0.0;
  for (std::size_t k = 0; k < changed.size(); ++k) {
    const double difference = diameter_of(changed[k]) - 0.016;
    EXPECT_LE(std::abs(difference), 0.2e-3);
    EXPECT_EQ(changed[k].x, nominal[k].x);
    sum += difference;
    squares += difference * difference;
  }
  // Uniform within +- a: mean 0 with a standard error of a/sqrt(3 n), variance a^2/3.
  const double n = static_cast<double>(changed.size());
  EXPECT_LT(std::abs(sum / n), 4.0 * 0.2e-3 / std::sqrt(3.0 * n));
  EXPECT_NEAR(squares / n, 0.2e-3 * 0.2e-3 / 3.0, 0.15 * 0.2e-3 * 0.2e-3 / 3.0);
  EXPECT_EQ(holes_of(deviated(design, Deviation::hole_size, 0.2e-3, 5)), changed);
  EXPECT_NE(holes_of(deviated(design, Deviation::hole_size, 0.2e-3, 6)), changed);
}

TEST(Deviation, EveryHoleMovesWithinADisc) {
  const DesignFile design = many_holes();
  const auto nominal = holes_of(design.design());
  const auto changed = holes_of(deviated(design, Deviation::hole_position, 0.5e-3, 5));
  double squares = 0.0;
  for (std::size_t k = 0; k < changed.size(); ++k) {
    const double moved = std::hypot(changed[k].x - nominal[k].x, changed[k].y - nominal[k].y);
    EXPECT_LE(moved, 0.5e-3 * (1.0 + 1e-9));
    EXPECT_NEAR(diameter_of(changed[k]), 0.016, 1e-15);
    squares += moved * moved;
  }
  // Uniform on a disc of radius R: mean square R^2/2, with a standard deviation of R^2/sqrt(12).
  EXPECT_NEAR(squares / static_cast<double>(changed.size()), 0.5 * 0.25e-6, 4.0 * 0.25e-6 / std::sqrt(12.0 * 400.0));
}

TEST(Deviation, LengthsAreThoseOfTheLaidBlock) {
  Design design = many_holes().design();
  design.layout.scale = 2.0;
  const auto nominal = holes_of(design);
  const auto changed = holes_of(deviated(DesignFile(design), Deviation::hole_size, 0.2e-3, 5));
  double most = 0.0;
  for (std::size_t k = 0; k < changed.size(); ++k)
    most = std::max(most, std::abs(diameter_of(changed[k]) - diameter_of(nominal[k])));
  EXPECT_LE(most, 0.2e-3);
  EXPECT_GT(most, 0.19e-3);
}

TEST(Deviation, OtherShapesAreSpreadByTheirKeys) {
  Design design = many_holes().design();
  design.layout.shape = geometry::ShapeKind::ellipse;
  design.layout.aspect = 2.0;
  const DesignFile ellipses(design);
  EXPECT_EQ(why_not(Deviation::hole_size, ellipses), "");
  const Design size = deviated(ellipses, Deviation::hole_size, 0.2e-3, 5);
  EXPECT_NEAR(size.layout.size_spread, 0.0125, 1e-5);  // 0.2 mm of 16 mm
  EXPECT_EQ(size.seeds.effective(0).layout, 5U);
  EXPECT_EQ(size.seeds.effective(0).packing, design.seeds.effective(0).packing) << "the same discs";
  EXPECT_NEAR(deviated(ellipses, Deviation::hole_position, 0.5e-3, 5).layout.jitter, 0.5e-3, 1e-15);
  design.layout.jitter = 1e-4;  // its own draw would change with the seed
  EXPECT_THAT(why_not(Deviation::hole_size, DesignFile(design)), testing::HasSubstr("no circles"));
}

// About the middle of the block, (25, 25) mm: (12.5, 12.5) lies (-12.5, -12.5) from it.
TEST(Deviation, ThePatternTurnsAndLeans) {
  Design design;
  design.layout.width = design.layout.height = 0.05;
  design.layout.rows = design.layout.columns = 2;
  design.layout.diameter = 0.01;
  EXPECT_THAT(why_not(Deviation::tilt, DesignFile(design)), testing::HasSubstr("platens"));
  EXPECT_THAT(why_not(Deviation::shear, DesignFile(design)), testing::HasSubstr("platens"));
  design.solver.boundary.top_bottom = solver::TopBottom::platens;
  EXPECT_NE(why_not(Deviation::tilt, DesignFile(design)), "");
  EXPECT_EQ(why_not(Deviation::shear, DesignFile(design)), "");
  design.solver.boundary.sides = solver::Sides::free;
  ASSERT_EQ(why_not(Deviation::tilt, DesignFile(design)), "");
  const double angle = 5.0 * std::numbers::pi / 180.0;
  const auto turned = holes_of(deviated(DesignFile(design), Deviation::tilt, angle, 1));
  ASSERT_EQ(turned.size(), 4U);
  const double x = 0.025 - 0.0125 * (std::cos(angle) - std::sin(angle));
  const double y = 0.025 - 0.0125 * (std::cos(angle) + std::sin(angle));
  EXPECT_TRUE(std::any_of(turned.begin(), turned.end(),
                          [&](const Perforation& hole) { return std::hypot(hole.x - x, hole.y - y) < 1e-12; }));
  for (const Perforation& hole : holes_of(deviated(DesignFile(design), Deviation::shear, 0.02, 1)))
    EXPECT_NEAR(std::remainder(hole.x - 0.0125, 0.025), 0.02 * (hole.y - 0.025), 1e-12);
}

/// A constant stress: 200 kPa, 1 % more a replicate, and 10 kPa more for each 0.1 mm of the mean hole beyond 16 mm.
double level_of(const Request& request) {
  double sum = 0.0;
  const auto holes = holes_of(*request.design);
  for (const Perforation& hole : holes) sum += diameter_of(hole) - 0.016;
  return 2e5 * (1.0 + 0.01 * request.replicate) + 1e8 * sum / static_cast<double>(holes.size());
}

class ToleranceTest : public SweepTest {
 protected:
  ToleranceTest() {
    folder.file("block.toml",
                "[cell]\nwidth = \"50 mm\"\nheight = \"50 mm\"\n[layout]\nfamily = \"square\"\ndiameter = \"16 "
                "mm\"\nrows = 2\ncolumns = 2\n[packing]\nmean_diameter = \"0.5044 mm\"\n[loading]\nuntil = "
                "0.45\n[target]\nplateau_stress = \"0.2 MPa\"\ntolerance = 0.05\n");
  }
  WorkOptions counting(const std::string& name) {
    WorkOptions made = options(name);
    made.make_executor = [this] {
      return make_in_process_executor(
          [this](const Request& request) {
            ++asked;
            EXPECT_EQ(request.design->solver.material.grade, 1.0) << "another grade needs no simulation";
            Evaluation evaluation = fake_evaluation(request);
            results::History& curve = evaluation.curve;
            curve.stress_yy.assign(curve.strain_yy.size(), level_of(request));
            evaluation.summary.plateau_stress = level_of(request);
            evaluation.summary.final_strain = curve.strain_yy.back();
            for (const results::History::Column& column : results::History::columns())
              if (!column.optional && (curve.*column.values).empty())
                (curve.*column.values).assign(curve.strain_yy.size(), 0.0);
            return evaluation;
          },
          1);
    };
    return made;
  }
};

TEST_F(ToleranceTest, PairedChangesOfEveryDeviation) {
  const Tolerance tolerance = read_tolerance(folder / "block.toml", {"tolerance.replicates=3"});
  ASSERT_EQ(tolerance.cases.size(), 6U);
  nlohmann::json record;
  {
    SweepRun run(tolerance.sweep, counting("out"));
    run.run();
    record = to_json(tolerance, run);
    write_results(tolerance, run);
  }
  EXPECT_EQ(asked, 9) << "as designed, sizes, positions: three blocks each; periodic blocks have no tilt or shear";
  const auto wish = [](const nlohmann::json& one) { return one.at("wishes").at(0); };
  // 200, 202, 204 kPa: mean 202, wished 190 to 210; t_2 = 4.303 times 2/sqrt(3) makes 4.97.
  const nlohmann::json undisturbed = wish(record.at("undisturbed"));
  EXPECT_NEAR(undisturbed.at("mean").get<double>(), 202e3, 1.0);
  EXPECT_NEAR(undisturbed.at("interval").at(1).get<double>(), 206.97e3, 10.0);
  EXPECT_EQ(undisturbed.at("outcome"), "met");
  const nlohmann::json& deviations = record.at("deviations");
  // Stresses are in proportion to the grade: -+ 20.2 kPa in the mean, -+ 0.2 kPa from block to block.
  for (const std::size_t k : {std::size_t{2}, std::size_t{3}}) {
    const double sign = k == 2 ? -1.0 : 1.0;
    const nlohmann::json change = wish(deviations.at(k)).at("change");
    EXPECT_NEAR(change.at("mean").get<double>(), sign * 20.2e3, 1.0);
    EXPECT_NEAR(change.at("confidence_95").get<double>(), 497.0, 1.0);
    EXPECT_EQ(deviations.at(k).at("outcome"), "missed");
  }
  EXPECT_EQ(wish(deviations.at(1)).at("change").at("mean").get<double>(), 0.0) << "this formula knows no places";
  EXPECT_LE(std::abs(wish(deviations.at(0)).at("change").at("mean").get<double>()), 20e3);
  EXPECT_NE(wish(deviations.at(0)).at("change").at("mean").get<double>(), 0.0);
  for (const std::size_t k : {std::size_t{4}, std::size_t{5}}) EXPECT_TRUE(deviations.at(k).at("left_out").is_string());
  const std::string table = tolerance_csv(record);
  EXPECT_EQ(std::count(table.begin(), table.end(), '\n'), 1 + 1 + 4);
  // Nothing is run again.
  asked = 0;
  WorkOptions again = counting("out");
  again.resume = true;
  SweepRun resumed(read_tolerance(folder / "block.toml", {"tolerance.replicates=3"}).sweep, again);
  resumed.run();
  EXPECT_EQ(asked, 0);
}

TEST_F(ToleranceTest, ReadsADesignAFileAndTheFolderOfAStudy) {
  const auto file = folder.file("tolerance.toml", "[tolerance]\ndesign = \"block.toml\"\nhole_size = \"0.3 mm\"\n");
  EXPECT_EQ(read_tolerance(file).cases.front().amount, 0.3e-3);
  std::filesystem::create_directories(folder / "study");
  EXPECT_THAT(input_error([&] { read_tolerance(folder / "study"); }), testing::HasSubstr("best.toml"));
  std::filesystem::copy(folder / "block.toml", folder / "study" / "best.toml");
  const Tolerance of_study = read_tolerance(folder / "study"), of_design = read_tolerance(folder / "block.toml");
  const auto packing = [](const Tolerance& one) { return one.sweep.start->design().seeds.effective(0).packing; };
  EXPECT_NE(packing(of_study), packing(of_design)) << "seeds that chose the design flatter it";
  EXPECT_THAT(input_error([&] { read_tolerance(folder / "design.toml"); }), testing::HasSubstr("wishes nothing"));
  EXPECT_THAT(input_error([&] { read_tolerance(folder / "block.toml", {"tolerance.hole_sise=1"}); }),
              testing::HasSubstr("hole_size"));
}

}  // namespace
}  // namespace perfora::optimize
