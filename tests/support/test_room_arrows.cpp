// What is here: every source file of the project held to the rules of the house, and made-up files that show each rule
// can fail. What is not: the rules (source_rules.cpp).
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <sstream>

#include "tests/support/source_rules.h"

namespace perfora::test {
namespace {

namespace fs = std::filesystem;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;

std::map<std::string, std::string> project_sources() {
  const fs::path source = PERFORA_SOURCE_DIR;
  std::map<std::string, std::string> files;
  const std::vector<std::string> folders = {"io",      "geometry", "results", "solver", "optimize",
                                            "perfora", "bindings", "report",  "app",    "tests"};
  for (const auto& folder : folders) {
    if (!fs::exists(source / folder)) continue;
    for (const auto& entry : fs::recursive_directory_iterator(source / folder)) {
      const auto extension = entry.path().extension();
      if (extension != ".h" && extension != ".cpp") continue;
      std::ostringstream text;
      text << std::ifstream(entry.path()).rdbuf();
      files[entry.path().lexically_relative(source).generic_string()] = text.str();
    }
  }
  return files;
}

std::string joined(const std::vector<std::string>& sentences) {
  std::string text;
  for (const auto& sentence : sentences) text += sentence + "\n";
  return text;
}

TEST(RoomArrows, EveryFileKeepsTheRules) {
  const auto files = project_sources();
  ASSERT_GT(files.size(), 20u) << "the tree was not found at " << PERFORA_SOURCE_DIR;
  for (const auto& [path, text] : files) EXPECT_EQ(joined(violations(path, text)), "");
  EXPECT_EQ(joined(violations_together(files)), "");
}

TEST(RoomArrows, FindsIncludesHoweverTheyAreWritten) {
  EXPECT_THAT(includes_of("// #include \"no.h\"\n#include <a/b.h>\n  #  include \"c.h\"  // why\nint x;\n"),
              ElementsAre("a/b.h", "c.h"));
}

struct Case {
  const char* path;
  const char* include;
  const char* complaint;  ///< "" where the include is right
};

void PrintTo(const Case& item, std::ostream* out) {
  *out << item.include << " in " << item.path;
}

class RoomArrowsCases : public ::testing::TestWithParam<Case> {};

TEST_P(RoomArrowsCases, IsJudgedRightly) {
  const auto found =
      violations(GetParam().path, std::string("// What is here.\n#include ") + GetParam().include + "\n");
  if (std::string(GetParam().complaint).empty())
    EXPECT_THAT(found, IsEmpty());
  else
    EXPECT_THAT(found, ElementsAre(HasSubstr(GetParam().complaint)));
}

INSTANTIATE_TEST_SUITE_P(
    MadeUp, RoomArrowsCases,
    ::testing::Values(
        Case{"io/x.h", "\"geometry/layout.h\"", "io knows nothing of geometry"},
        Case{"geometry/x.cpp", "<solver/run.h>", "geometry knows nothing of solver"},
        Case{"solver/x.cpp", "\"optimize/evaluate/design.h\"", "solver knows nothing of optimize/evaluate"},
        Case{"optimize/search/x.cpp", "\"report/plot.h\"", "optimize/search knows nothing of report"},
        Case{"optimize/evaluate/x.h", "\"optimize/campaign/sweep.h\"", "evaluate knows nothing of optimize/campaign"},
        Case{"optimize/campaign/x.h", "\"optimize/search/study.h\"", "campaign knows nothing of optimize/search"},
        Case{"optimize/search/x.h", "\"optimize/campaign/sweep.h\"", ""},
        Case{"app/x.cpp", "\"perfora/design.h\"", "app knows nothing of perfora"},
        Case{"optimize/search/x.h", "\"perfora/design.h\"", "knows nothing of perfora"},
        Case{"perfora/x.cpp", "\"optimize/search/study.h\"", ""},
        Case{"perfora/x.cpp", "\"report/plot.h\"", "perfora knows nothing of report"},
        Case{"bindings/x.cpp", "\"perfora/study.h\"", ""}, Case{"bindings/x.cpp", "<pybind11/numpy.h>", ""},
        Case{"bindings/x.cpp", "\"results/history.h\"", "bindings knows nothing of results"},
        Case{"bindings/x.cpp", "\"perfora/inside.h\"", "no public header"},
        Case{"app/x.cpp", "<pybind11/numpy.h>", "Python belongs"},
        Case{"perfora/x.h", "\"results/history.h\"", "neither of the standard library"},
        Case{"perfora/x.h", "\"perfora/inside.h\"", "neither of the standard library"},
        Case{"perfora/x.h", "<nlohmann/json.hpp>", "neither of the standard library"},
        Case{"perfora/x.h", "<filesystem>", ""}, Case{"perfora/x.h", "\"perfora/design.h\"", ""},
        Case{"perfora/inside.h", "\"results/history.h\"", ""}, Case{"tests/perfora/x.cpp", "\"perfora/pack.h\"", ""},
        Case{"results/x.h", "\"solver/run.h\"", "results knows nothing of solver"},
        Case{"report/x.cpp", "\"app/common.h\"", "report knows nothing of app"},
        Case{"solver/x.cpp", "\"../io/error.h\"", "not by \"..\""}, Case{"app/x.cpp", "\"report/plot.h\"", ""},
        Case{"report/x.cpp", "\"optimize/evaluate/design.h\"", "report knows nothing of optimize/evaluate"},
        Case{"report/x.cpp", "\"solver/run.h\"", "report knows nothing of solver"},
        Case{"report/x.cpp", "\"results/statistic.h\"", ""}, Case{"optimize/evaluate/x.cpp", "\"solver/run.h\"", ""},
        Case{"solver/x.cpp", "\"geometry/packing.h\"", ""}, Case{"geometry/x.cpp", "\"io/error.h\"", ""},
        Case{"io/x.cpp", "\"io/error.h\"", ""}, Case{"geometry/x.cpp", "<CGAL/spatial_sort.h>", ""},
        Case{"geometry/x.h", "<CGAL/spatial_sort.h>", "CGAL belongs"},
        Case{"solver/x.cpp", "<CGAL/spatial_sort.h>", "CGAL belongs"}, Case{"optimize/search/x.cpp", "<nlopt.hpp>", ""},
        Case{"optimize/search/x.h", "<nlopt.hpp>", "NLopt belongs"}, Case{"app/x.cpp", "<nlopt.h>", "NLopt belongs"},
        Case{"io/x.cpp", "<toml++/toml.h>", ""}, Case{"optimize/search/x.cpp", "<toml++/toml.h>", "toml++ belongs"},
        Case{"io/hdf5.cpp", "<hdf5.h>", ""}, Case{"io/hdf5_common.h", "<hdf5.h>", ""},
        Case{"io/hdf5.h", "<hdf5.h>", "HDF5's C API belongs"}, Case{"io/x.cpp", "<hdf5.h>", "HDF5's C API belongs"},
        Case{"report/x.cpp", "<H5Cpp.h>", "HDF5's C API belongs"}, Case{"tests/io/x.cpp", "<hdf5.h>", ""}));

TEST(RoomArrows, OpeningCommentIsWanted) {
  EXPECT_THAT(violations("io/x.h", "#pragma once\n"), ElementsAre(HasSubstr("no comment")));
  EXPECT_THAT(violations("tests/io/x.cpp", "\n// late\n"), ElementsAre(HasSubstr("no comment")));
}

TEST(RoomArrows, NumbersDoNotGoByTheLocale) {
  EXPECT_THAT(violations("io/x.cpp", "//\nconst double x = std::stod(text);\n"), ElementsAre(HasSubstr("locale")));
  EXPECT_THAT(violations("tests/io/x.cpp", "//\nconst double x = std::stod(text);\n"), IsEmpty());
}

TEST(RoomArrows, LongFilesAreRefused) {
  std::string text = "// What is here.\n";
  for (int line = 1; line < maximum_lines; ++line) text += "\n";
  EXPECT_THAT(violations("io/x.cpp", text), IsEmpty());
  EXPECT_THAT(violations("io/x.cpp", text + "\n"), ElementsAre(HasSubstr("split it")));
}

TEST(RoomArrows, OneFileAloneNamesNloptAndToml) {
  const std::string nlopt = "//\n#include <nlopt.hpp>\n";
  const std::string toml = "//\n#include <toml++/toml.h>\n";
  EXPECT_THAT(violations_together({{"optimize/search/a.cpp", nlopt}, {"io/a.cpp", toml}}), IsEmpty());
  EXPECT_THAT(violations_together({{"optimize/search/a.cpp", nlopt}, {"optimize/search/b.cpp", nlopt}}),
              ElementsAre(HasSubstr("optimize/search/b.cpp: a second file")));
  EXPECT_THAT(violations_together({{"io/a.cpp", toml}, {"io/b.cpp", toml}}),
              ElementsAre(HasSubstr("io/b.cpp: a second file")));
}

TEST(RoomArrows, ShapesAreNamedInGeometryAlone) {
  const std::string shapes = "//\nusing Shape = std::variant<Circle, Slot>;\n";
  const std::string user = "//\nconst double d = std::get<geometry::Slot>(hole.shape).length;\n";
  EXPECT_THAT(violations_together({{"geometry/shapes.h", shapes}, {"geometry/wall.cpp", user}}), IsEmpty());
  EXPECT_THAT(violations_together({{"geometry/shapes.h", shapes}, {"tests/solver/x.cpp", user}}), IsEmpty());
  EXPECT_THAT(violations_together({{"geometry/shapes.h", shapes}, {"solver/x.cpp", user}}),
              ElementsAre(HasSubstr("solver/x.cpp: names the shape Slot")));
}

TEST(RoomArrows, FolderInsideTheSolverStandsOnItsOwn) {
  const std::string none = "//\n", kernel = "//\n#include \"solver/kernels/kernels.h\"\n";
  EXPECT_THAT(violations_together({{"solver/kernels/kernels.h", "//\n#include \"solver/state.h\"\n"},
                                   {"solver/state.h", none},
                                   {"solver/run.h", kernel}}),
              IsEmpty());
  EXPECT_THAT(violations_together({{"solver/kernels/kernels.h", "//\n#include \"solver/run.h\"\n"},
                                   {"solver/run.h", "//\n#include \"solver/simulation.h\"\n"},
                                   {"solver/simulation.h", kernel}}),
              ElementsAre(HasSubstr("which includes solver/kernels/kernels.h")));
}

}  // namespace
}  // namespace perfora::test
