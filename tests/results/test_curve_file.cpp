// What is here: curves of experiments as spreadsheets write them, and the mistakes in them. What is not: CSV syntax
// (tests/io/test_csv.cpp).
#include "results/curve_file.h"

#include <gmock/gmock.h>

#include "tests/io/io_support.h"

namespace perfora::results {
namespace {

using io::input_error;
using io::TemporaryFolder;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::StartsWith;

class CurveFile : public testing::Test {
 protected:
  Curve read(const std::string& text, StrainOrder order = StrainOrder::any) const {
    return read_curve(folder.file("press 7.csv", text), order);
  }
  std::string error_of(const std::string& text, StrainOrder order = StrainOrder::any) const {
    const std::string said = input_error([&] { (void)read(text, order); }), file = (folder / "press 7.csv").string();
    EXPECT_THAT(said, StartsWith(file + ":"));
    return said.substr(file.size());
  }
  const TemporaryFolder folder;
};

TEST_F(CurveFile, UnitsStandInTheHeader) {
  // 0.4 % is 0.004 and 1.5 MPa is 1.5e6 Pa, to the last bit.
  const Curve curve = read("# block 7\nstrain [%], stress [MPa]\n0, 0\n0.4, 1.5 # peak\n\n50,0.2\n");
  EXPECT_THAT(curve.strain, ElementsAre(0.0, 0.004, 0.5));
  EXPECT_THAT(curve.stress, ElementsAre(0.0, 1.5e6, 2e5));
  EXPECT_EQ(curve.name, "press 7");
}

TEST_F(CurveFile, HeadersMayDiffer) {
  EXPECT_THAT(read("time,Stress (kPa),Strain\n1,2,0.1\n2,3,0.2\n").stress, ElementsAre(2e3, 3e3));
  EXPECT_THAT(read("strain [%]\tstress [MPa]\n1\t2\n2\t3\n").strain, ElementsAre(0.01, 0.02));
  EXPECT_THAT(read("strain [-] stress [N/mm^2]\n0.1 2\n0.2 3\n").stress, ElementsAre(2e6, 3e6));
  EXPECT_THAT(read("\"strain [%]\",\"stress [MPa]\"\r\n1,2\r\n2,3\r\n").strain, ElementsAre(0.01, 0.02));
  EXPECT_THAT(read("strain_yy,strain_yy_log,stress_yy\n0,0,5\n0.1,0.105,6\n").stress, ElementsAre(5.0, 6.0));
}

TEST_F(CurveFile, MistakesNameLineAndColumn) {
  EXPECT_EQ(error_of("strain [%], stress [MPa]\n0,0\n1,high\n"),
            ":3: column stress: \"high\" is not a finite number; plain numbers in MPa with a decimal point are wanted; "
            "correct this line");
  EXPECT_EQ(error_of("strain [mm], stress [MPa]\n0,0\n"),
            ":1: column strain: \"mm\" is no unit of a ratio; accepted are %; correct the unit or leave it out for SI");
  EXPECT_EQ(error_of("strain [%], force [kN]\n0,0\n"),
            ":1: has no column stress or stress_yy; its columns are strain, force; a first line such as "
            "\"strain [%], stress [MPa]\" is wanted");
  EXPECT_THAT(error_of("0,0\n1,2\n"), StartsWith(":1: the first line does not name the columns"));
  EXPECT_THAT(error_of("strain [%]; stress [MPa]\n0,5; 1,2\n"), StartsWith(":1: values are separated by semicolons"));
  EXPECT_THAT(error_of("strain [%], stress [MPa]\n0,5, 1,2\n"), StartsWith(":2: has 4 values; the header names 2"));
  EXPECT_THAT(error_of("strain, stress\n0,0\n40,1e6\n"), HasSubstr(":3: column strain: 4000 % is no engineering"));
  EXPECT_THAT(error_of("strain, stress\n0.1,1\n"), StartsWith(":2: is the only row"));
  EXPECT_THAT(error_of("strain, stress\n"), StartsWith(": holds no rows"));
  EXPECT_THAT(input_error([&] { (void)read_curve(folder / "none.csv"); }), HasSubstr("none.csv: does not exist"));
}

TEST_F(CurveFile, UnloadingIsDrawnButIsNoFunction) {
  const std::string text = "strain [%], stress [MPa]\n1,2\n0.5,0\n";
  EXPECT_EQ(read(text).strain.size(), 2U);
  EXPECT_EQ(error_of(text, StrainOrder::rising),
            ":3: column strain: 0.5 % is not above the 1 % of the row before; rising strains are wanted; leave out "
            "unloading and repeated rows");
}

}  // namespace
}  // namespace perfora::results
