// What is here: `perfora export` and `perfora draw` as a user runs them. What is not: what the files hold
// (tests/export), other programs (tests/viewers).
#include <gmock/gmock.h>

#include "tests/app/command_line.h"

namespace perfora::test {
namespace {

using ::testing::HasSubstr;

class ExportAndDraw : public CommandLine {};

// What would be ignored is refused; a design that is drawn obeys.
TEST_F(ExportAndDraw, KeysOfADesignAreRefusedBesideResults) {
  ASSERT_EQ(run("pack d.toml -o p.h5").exit_code, 0);
  for (const char* command : {"show p.h5 --set layout.diameter=5mm", "report p.h5 --seed 2", "plot p.h5 --set a.b=1",
                              "export p.h5 --csv --packing-seed 3", "draw p.h5 --set layout.diameter=5mm"}) {
    const Outcome outcome = run(command);
    EXPECT_EQ(outcome.exit_code, 1) << command;
    EXPECT_THAT(outcome.error, HasSubstr("changes a design, and results are taken as they are")) << command;
  }
  EXPECT_EQ(run("plot d.toml --set layout.diameter=5mm -o a.svg").exit_code, 0);
  EXPECT_EQ(run("plot d.toml -o b.svg").exit_code, 0);
  EXPECT_NE(read_text(folder_ / "a.svg"), read_text(folder_ / "b.svg"));
  EXPECT_THAT(run("plot d.toml --set layout.diametre=5mm -o c.svg").error, HasSubstr("did you mean layout.diameter"));
}

TEST_F(ExportAndDraw, APackingNeverReplacesItsDesign) {
  const std::string before = read_text(folder_ / "d.toml");
  const Outcome outcome = run("pack d.toml -o d.toml --force");
  EXPECT_EQ(outcome.exit_code, 1);
  EXPECT_THAT(outcome.error, HasSubstr("the packing file does not end in .h5"));
  EXPECT_EQ(read_text(folder_ / "d.toml"), before);
}

TEST_F(ExportAndDraw, SeveralFormatsAtOnce) {
  ASSERT_EQ(run("evaluate d.toml -o r.h5 --threads 1 --set output.frame_data=all").exit_code, 0);
  const Outcome exported = run("export r.h5 --lammps-dump --csv --vtk --axis strain -o one --json");
  ASSERT_EQ(exported.exit_code, 0) << exported.error;
  const json record = json::parse(exported.output);
  EXPECT_EQ(record["schema"], "perfora.export/1");
  for (const char* name :
       {"one.dump", "one.pvd", "one.discs.csv", "one.bonds.csv", "one.contacts.csv", "one.breaks.csv"}) {
    EXPECT_TRUE(fs::exists(folder_ / name)) << name;
    EXPECT_THAT(record["outputs"].dump(), HasSubstr(name));
  }
  EXPECT_THAT(read_text(folder_ / "one.dump"), HasSubstr("stress_yy"));
  EXPECT_THAT(run("export r.h5 --csv -o one").error, HasSubstr("--force"));
  EXPECT_EQ(run("export r.h5 --csv -o one --force").exit_code, 0);
  EXPECT_EQ(run("export r.h5 --lammps-data -o two.data").exit_code, 0);
  EXPECT_TRUE(fs::exists(folder_ / "two.data")) << "the extension may be written";
  EXPECT_EQ(run("export r.h5 --xyz --at \"0.5 %\" --quiet").error, "");
  EXPECT_TRUE(fs::exists(folder_ / "r.xyz")) << "the name of the run, in this folder";
  for (const std::string& name : files()) EXPECT_FALSE(name.ends_with(".lock")) << name;
}

TEST_F(ExportAndDraw, ExportSaysWhatIsWrong) {
  ASSERT_EQ(run("pack d.toml -o p.h5").exit_code, 0);
  EXPECT_EQ(run("export p.h5 --vtk").exit_code, 0);
  EXPECT_THAT(run("export p.h5").error, HasSubstr("--lammps-dump, --lammps-data, --vtk"));
  EXPECT_THAT(run("export p.h5 --xdmf -o x").error, HasSubstr("this is a packing"));
  EXPECT_THAT(run("export p.h5 --vtk --axis stress").error, HasSubstr("--axis"));
  EXPECT_THAT(run("export d.toml --vtk").error, HasSubstr("d.toml"));
  for (const char* bad :
       {"export p.h5", "export p.h5 --xdmf -o x", "export d.toml --vtk", "export p.h5 --vtk --at wide"})
    EXPECT_EQ(run(bad).exit_code, 1) << bad;
}

// Drawn, read back and packed: the same holes.
TEST_F(ExportAndDraw, ADrawingIsADesign) {
  ASSERT_EQ(run("draw d.toml -o b.dxf").exit_code, 0);
  ASSERT_EQ(run("draw d.toml -o b.svg --title \"A & B\" --note \"mortar=C25, E 8 GPa\" --note dry").exit_code, 0);
  const std::string sheet = read_text(folder_ / "b.svg");
  for (const char* words : {"A &amp; B", ">mortar<", ">C25, E 8 GPa<", ">note<", ">dry<"})
    EXPECT_THAT(sheet, HasSubstr(words));
  EXPECT_THAT(run("draw d.toml -o b.svg").error, HasSubstr("--force"));
  EXPECT_THAT(run("draw d.toml -o b.png").error, HasSubstr(".svg or .dxf"));
  const json whole = json::parse(run("pack d.toml --json -o p.h5").output);
  for (const std::string drawing : {"b.dxf", "b.svg"}) {
    const Outcome packed =
        run("pack d.toml --json --force -o q.h5 --set layout.family=list --set layout.file=" + drawing);
    ASSERT_EQ(packed.exit_code, 0) << packed.error;
    const json again = json::parse(packed.output);
    EXPECT_EQ(again["perforations"], 1);
    EXPECT_NEAR(again["porosity"].get<double>(), whole["porosity"].get<double>(), 1e-9);
  }
  ASSERT_EQ(run("draw p.h5 -o c.dxf --json").exit_code, 0);
  EXPECT_THAT(read_text(folder_ / "c.dxf"), HasSubstr("HOLES"));
  EXPECT_EQ(run("draw d.toml --quiet").error, "");
  EXPECT_TRUE(fs::exists(folder_ / "d.svg"));
}

}  // namespace
}  // namespace perfora::test
