// What is here: a material handed over from a file: what is taken, what counts more, what is refused. Nothing numerical
// is expected but what the files say. What is not: calibration itself.
#include <gmock/gmock.h>

#include "optimize/evaluate/calibrated_material.h"
#include "optimize/evaluate/request.h"
#include "tests/optimize/evaluate/design_support.h"

namespace perfora::optimize {
namespace {

using testing::HasSubstr;
using testing::StartsWith;

const char* mortar =
    "# mortar\n[material]\nnormal_stiffness = 4.9e8\nhorizon = 2.5\n"
    "[packing]\nmean_diameter = \"0.6 mm\"\nmaximum_diameter = \"1.2 mm\"\nsolid_fraction = 0.8\n"
    "[noise]\nkind = \"perlin\"\n";

class CalibratedMaterial : public testing::Test {
 protected:
  void SetUp() override { folder.file("mortar.toml", mortar); }
  DesignFile design(const std::string& text, const std::vector<std::string>& overrides = {}) const {
    return DesignFile(folder.file("design.toml", text), overrides);
  }
  std::string refused(const std::string& text) const {
    return complaint([&] { (void)design(text); });
  }
  const DesignFolder folder;
};

TEST_F(CalibratedMaterial, ADesignTakesMaterialDiscsAndNoise) {
  const Design taken = design("[material]\nfrom = \"mortar.toml\"\n[layout]\ndiameter = \"8 mm\"\n").design();
  EXPECT_EQ(taken.solver.material.normal_stiffness, 4.9e8);
  EXPECT_EQ(taken.solver.material.horizon, 2.5);
  EXPECT_EQ(taken.packing.mean_diameter, 0.6e-3);
  EXPECT_EQ(taken.packing.solid_fraction, 0.8);
  EXPECT_EQ(taken.solver.noise.kind, solver::NoiseKind::perlin);
  EXPECT_EQ(taken.solver.material.tangential_stiffness, 8.246e6) << "what the file leaves out stays";
  EXPECT_EQ(taken.layout.diameter, 8e-3);
}

TEST_F(CalibratedMaterial, WhatTheDesignSaysItselfCountsMoreWhereverItStands) {
  const Design own = design(
                         "[noise]\nkind = \"none\"\n[packing]\nmean_diameter = \"0.7 mm\"\n"
                         "[material]\nhorizon = 3\nfrom = \"mortar.toml\"\nfriction_coefficient = 0.5\n",
                         {"packing.solid_fraction=0.75"})
                         .design();
  EXPECT_EQ(own.solver.material.horizon, 3.0);
  EXPECT_EQ(own.solver.material.normal_stiffness, 4.9e8);
  EXPECT_EQ(own.packing.mean_diameter, 0.7e-3);
  EXPECT_EQ(own.packing.solid_fraction, 0.75);
  EXPECT_EQ(own.solver.noise.kind, solver::NoiseKind::none);
  // Given on the command line the file comes last.
  const Design set =
      design("[material]\nhorizon = 3\n", {"material.from=" + (folder / "mortar.toml").string()}).design();
  EXPECT_EQ(set.solver.material.horizon, 2.5);
}

TEST_F(CalibratedMaterial, TheResolvedDesignHoldsTheValuesAndNoFile) {
  const DesignFile read = design("[material]\nfrom = \"mortar.toml\"\n");
  const std::string text = read.schema().to_toml();
  EXPECT_THAT(text, HasSubstr("from = \"\""));
  std::filesystem::remove(folder / "mortar.toml");
  EXPECT_EQ(DesignFile::from_toml(text, "stored").schema().to_toml(), text);
  EXPECT_EQ(read.clone().schema().to_toml(), text);
  DesignFile written;
  written.design() = read.design();
  EXPECT_EQ(make_request(written, 0).key(), make_request(read, 0).key());
  EXPECT_THAT(read.schema().origin("material.horizon").file, HasSubstr("mortar.toml"));
}

TEST_F(CalibratedMaterial, WhatIsWrittenComesBack) {
  DesignFile source;
  source.design().solver.material.normal_stiffness = 1.0 / 3.0 * 1e9;
  source.design().solver.material.characteristic_length = 0.0123;
  source.design().packing.solid_fraction = 0.719;
  folder.file("mortar.toml", calibrated_material(source, "Found\n  E: 8 GPa"));
  DesignFile taken = design("[material]\nfrom = \"mortar.toml\"\n");
  EXPECT_EQ(taken.schema().to_toml(), source.schema().to_toml());
  EXPECT_THAT(calibrated_material(source, "Found\n  E: 8 GPa"), StartsWith("# Found\n#   E: 8 GPa\n\n[material]\n"));
  source.design().packing.file = "/discs.csv";
  EXPECT_THAT(calibrated_material(source, ""), testing::Not(HasSubstr("[packing]")));
}

TEST_F(CalibratedMaterial, MistakesAreNamed) {
  const std::string from = "[material]\nhorizon = 3\nfrom = \"mortar.toml\"\n";
  std::filesystem::remove(folder / "mortar.toml");
  const std::string at = (folder / "design.toml").string(), file = (folder / "mortar.toml").string();
  EXPECT_THAT(refused(from), StartsWith(at + ":3: material.from: there is no file " + file));
  folder.file("mortar.toml", "[material]\nhorizont = 3\n");
  EXPECT_THAT(refused(from), StartsWith(file + ":2: material.horizont: unknown key in [material]; did you mean"));
  folder.file("mortar.toml", "[cell]\nwidth = \"50 mm\"\n");
  EXPECT_THAT(refused(from),
              StartsWith(file + ":2: cell.width: is no key of a material; named by material.from of " + at));
  folder.file("mortar.toml", "[packing]\nfile = \"discs.csv\"\n");
  EXPECT_THAT(refused(from), StartsWith(file + ":2: packing.file: is no key of a material"));
  folder.file("mortar.toml", "[material]\nfrom = \"other.toml\"\n");
  EXPECT_THAT(refused(from),
              StartsWith(file + ":2: material.from: a material file that takes its material from another"));
  folder.file("mortar.toml", "[material]\nhorizon = \"3 mm\"\n");
  EXPECT_THAT(refused(from), StartsWith(file + ":2: material.horizon: "));
}

}  // namespace
}  // namespace perfora::optimize
