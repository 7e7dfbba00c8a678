// What is here: tables read from CSV files, kinds of files, stored records. What is not: run files (test_evaluate.cpp),
// folders (test_campaign.cpp).
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

#include "perfora/campaign.h"
#include "perfora/pack.h"
#include "tests/perfora/face_support.h"

namespace perfora {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;

TEST(PublicResults, TableKeepsNumbersAndTexts) {
  const DesignFolder folder;
  const Table table =
      read_table(folder.file("t.csv", "label,strain_yy,plateau_stress_ci95\n\"a, b\",0.25,\nc,0.5,1e5\n"));
  EXPECT_EQ(table.rows(), 2U);
  EXPECT_THAT(table.texts("label"), ElementsAre("a, b", "c"));
  EXPECT_THAT(table.values("strain_yy"), ElementsAre(0.25, 0.5));
  EXPECT_TRUE(std::isnan(table.values("plateau_stress_ci95")[0]));
  EXPECT_EQ(table.columns[2].unit, "Pa");
  EXPECT_THAT(error_of([&] { static_cast<void>(table.values("strain_y")); }), HasSubstr("did you mean \"strain_yy\"?"));
}

TEST(PublicResults, KindsOfWhatTheProgramWrote) {
  const std::filesystem::path source = PERFORA_SOURCE_DIR;
  const DesignFolder folder;
  EXPECT_EQ(kind_of(source / "designs/quick.toml"), "design");
  EXPECT_EQ(kind_of(source / "designs/study-quick.toml"), "study file");
  EXPECT_EQ(kind_of(source / "designs/sweep-quick.toml"), "sweep file");
  EXPECT_EQ(kind_of(source / "docs/data/table1-to-60-percent.csv"), "table");
  EXPECT_EQ(kind_of(folder.file("note.txt", "text")), "");
  EXPECT_THAT(error_of([&] { static_cast<void>(kind_of(folder / "none")); }), HasSubstr("no such file"));
  PackOptions options;
  options.file = folder / "p.h5";
  static_cast<void>(pack(small_block(), options));
  EXPECT_EQ(kind_of(options.file), "packing");
  EXPECT_THAT(stored_record(options.file), HasSubstr("perfora.pack/1"));
  EXPECT_EQ(stored_record(folder / "note.txt"), "");
}

}  // namespace
}  // namespace perfora
