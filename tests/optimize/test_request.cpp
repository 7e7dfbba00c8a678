// What is here: requests, their keys, and what becomes of a request that cannot be met. Nothing numerical is expected.
#include <gmock/gmock.h>

#include <set>

#include "optimize/evaluation.h"
#include "tests/optimize/design_support.h"

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

TEST(Request, GoesThroughJson) {
  const Request request = make_request(DesignFile(), 4, 0.45);
  const Request again = request_from_json(nlohmann::json::parse(to_json(request).dump()));
  EXPECT_EQ(again.key(), request.key());
  EXPECT_EQ(again.design_toml, request.design_toml);
}

TEST(Request, ADesignThatCannotBeLaidOutFailsWithItsReason) {
  DesignFile design;
  design.design().layout.diameter = 0.024;  // walls of 1 mm
  const Evaluation evaluation = evaluate_request(make_request(design, 2), 1);
  EXPECT_EQ(evaluation.status, solver::RunStatus::failed);
  EXPECT_THAT(evaluation.reason, ::testing::HasSubstr("horizon"));
  EXPECT_EQ(evaluation.replicate, 2);
}

}  // namespace
}  // namespace perfora::optimize
