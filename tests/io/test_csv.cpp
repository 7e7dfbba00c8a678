// What is here: tables as spreadsheets, NumPy and gnuplot write them, and the mistakes in them.
// What is not: what columns mean.
#include "io/csv.h"

#include <gmock/gmock.h>

#include "io_support.h"

namespace perfora::io {
namespace {

using testing::AllOf;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::StartsWith;

const std::vector<std::string> wanted = {"x", "y", "radius"};

class Csv : public testing::Test {
 protected:
  CsvTable read(const std::string& text) const { return read_csv(folder.file("a.csv", text), wanted, 3); }
  std::string error_of(const std::string& text) const {
    const std::string said = input_error([&] { (void)read(text); });
    EXPECT_THAT(said, StartsWith((folder / "a.csv").string() + ":"));
    return said.substr((folder / "a.csv").string().size());
  }
  const TemporaryFolder folder;
};

TEST_F(Csv, HeaderNamesTheColumnsInAnyOrder) {
  const CsvTable table = read("# written by hand\nradius,colour,Y, \"x\"\n\n0.5,7,2,1 # first\n1.5,7,4,3\n");
  EXPECT_THAT(table.columns, ElementsAre(ElementsAre(1.0, 3.0), ElementsAre(2.0, 4.0), ElementsAre(0.5, 1.5)));
  EXPECT_THAT(table.lines, ElementsAre(4, 5));
  EXPECT_EQ(table.rows(), 2U);
}

TEST_F(Csv, WithoutHeaderTheColumnsStandInOrder) {
  EXPECT_THAT(read("1,2,0.5\n").columns, ElementsAre(ElementsAre(1.0), ElementsAre(2.0), ElementsAre(0.5)));
  EXPECT_THAT(read("1 2\t 0.5\n+3   -4 1e-3").columns,
              ElementsAre(ElementsAre(1.0, 3.0), ElementsAre(2.0, -4.0), ElementsAre(0.5, 1e-3)));
  EXPECT_THAT(read("# x y radius\r\n1.0e+00 2.0e+00 5.0e-01\r\n").columns,
              ElementsAre(ElementsAre(1.0), ElementsAre(2.0), ElementsAre(0.5)));
  EXPECT_THAT(read("\xEF\xBB\xBF"
                   "x y radius\n1 2 3\n")
                  .lines,
              ElementsAre(2));
}

TEST_F(Csv, ReadsTheNearestDouble) {
  EXPECT_EQ(read("0.1,1e-320,123456789.123456789\n").columns[2][0], 123456789.123456789);
}

TEST_F(Csv, WrongNumbersNameLineAndColumn) {
  EXPECT_EQ(error_of("x,y,radius\n1,2,3\n1,abc,3\n"),
            ":3: column y: \"abc\" is not a finite number; plain numbers in SI with a decimal point are wanted; "
            "correct this line");
  EXPECT_THAT(error_of("1,2,nan\n"), StartsWith(":1: column radius: \"nan\" is not a finite number"));
  EXPECT_THAT(error_of("1,2,-inf\n"), HasSubstr("not a finite number"));
  EXPECT_THAT(error_of("1,2,1e999\n"), HasSubstr("not a finite number"));
  EXPECT_THAT(error_of("1,2,\n"), StartsWith(":1: column radius: is empty"));
  EXPECT_THAT(error_of("1,,3\n"), StartsWith(":1: column y: is empty"));
  EXPECT_THAT(error_of("1,2,3 mm\n"), HasSubstr("\"3 mm\" is not"));
  EXPECT_THAT(error_of("1;2;3\n"), StartsWith(":1: "));
}

TEST_F(Csv, WrongColumnCountsNameTheLine) {
  EXPECT_THAT(error_of("x,y,radius\n1,2\n"), StartsWith(":2: has 2 values; the header names 3 columns"));
  EXPECT_THAT(error_of("x,y,radius\n1,2,3,4\n"), StartsWith(":2: has 4 values"));
  EXPECT_THAT(error_of("1,2,3,4\n"), StartsWith(":1: has 4 values; the 3 columns x, y, radius are wanted"));
}

TEST_F(Csv, WrongHeaders) {
  EXPECT_THAT(error_of("x,y,r\n1,2,3\n"), StartsWith(":1: has no column radius; its columns are x, y, r"));
  EXPECT_THAT(error_of("x,y,x,radius\n1,2,3,4\n"), StartsWith(":1: names the column x twice"));
}

TEST_F(Csv, EmptyAndTooLongFiles) {
  for (const char* text : {"", "\n\n", "# only a comment\n", "x,y,radius\n"})
    EXPECT_THAT(error_of(text), StartsWith(": holds no rows of numbers"));
  EXPECT_EQ(read("1,2,3\n1,2,3\n1,2,3\n").rows(), 3U);
  EXPECT_THAT(error_of("1,2,3\n1,2,3\n1,2,3\n1,2,3\n"), StartsWith(":4: is more than the 3 rows allowed"));
  EXPECT_THAT(input_error([&] { (void)read_csv(folder / "none.csv", wanted, 3); }),
              HasSubstr("none.csv: does not exist"));
}

}  // namespace
}  // namespace perfora::io
