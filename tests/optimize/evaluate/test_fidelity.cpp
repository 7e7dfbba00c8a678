// What is here: fidelities applied to designs. What is not: studies and sweeps that use them (their own tests).
#include <gmock/gmock.h>

#include "optimize/evaluate/request.h"
#include "tests/optimize/evaluate/design_support.h"

namespace perfora::optimize {
namespace {

TEST(Fidelity, ChangesTheDesignThatIsRun) {
  const DesignFile design;
  DesignFile cheap = design.clone();
  apply({"cell", {{"layout.rows", {std::int64_t{1}}}, {"loading.rate", {std::string("40 1/s")}}}, 0.25}, cheap,
        {"ladder.toml", 0, ""});
  EXPECT_EQ(cheap.design().layout.rows, 1);
  EXPECT_EQ(cheap.design().solver.loading.rate, 40.0);
  EXPECT_EQ(cheap.design().solver.loading.until, 0.25);
  EXPECT_NE(make_request(cheap, 0).key(), make_request(design, 0).key());
}

TEST(Fidelity, OneWithoutChangesIsTheDesign) {
  DesignFile design;
  const std::string before = design.schema().to_toml();
  apply({}, design, {});
  EXPECT_EQ(design.schema().to_toml(), before);
}

TEST(Fidelity, WithoutOutputNothingThatARunGivesChanges) {
  DesignFile design;
  design.schema().set_override("output.frames=all");
  design.schema().set_override("output.checkpoint_interval=7");
  const std::string key = make_request(design, 0).key();
  apply({"", changes_without_output(), 0.0}, design, {});
  EXPECT_EQ(design.design().solver.output.frames, solver::FrameChoice::none);
  EXPECT_EQ(design.design().solver.output.checkpoint_interval, solver::OutputOptions{}.checkpoint_interval);
  EXPECT_EQ(make_request(design, 0).key(), key);
}

TEST(Fidelity, IsRefusedWhereItIsWritten) {
  DesignFile design;
  const io::Origin origin{"ladder.toml", 3, ""};
  EXPECT_THAT(complaint([&] {
                apply({"", {{"layout.row", {std::int64_t{1}}}}, 0.0}, design, origin);
              }),
              ::testing::HasSubstr("ladder.toml:3"));
  EXPECT_THAT(complaint([&] { apply({"", {}, 0.95}, design, origin); }), ::testing::HasSubstr("0.95"));
}

TEST(Fidelity, ItsNameTravelsWithTheRequestAndIsNoPartOfTheKey) {
  Request request = make_request(DesignFile(), 0);
  const std::string key = request.key();
  request.fidelity = "coarse";
  EXPECT_EQ(request.key(), key);
  EXPECT_EQ(request_from_json(to_json(request)).fidelity, "coarse");
}

}  // namespace
}  // namespace perfora::optimize
