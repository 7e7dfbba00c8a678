// What is here: a small program that writes a made-up R.h5, exports of it and P.h5, for the checks of viewers and for
// looking at pictures. What is not: a test.
#include <cstdlib>
#include <filesystem>
#include <iostream>

#include "report/plot.h"
#include "report/export/registry.h"
#include "report/export/xdmf.h"
#include "tests/results/synthetic_run.h"

/// write_synthetic FOLDER [full]: R.h5, its exports, P.h5 and pictures; `full` has 37,000 discs.
int main(int argc, char** argv) {
  using namespace perfora::report;
  if (argc < 2) {
    std::cerr << "usage: write_synthetic FOLDER [full]\n";
    return EXIT_FAILURE;
  }
  const std::filesystem::path folder = argv[1];
  std::filesystem::create_directories(folder);
  perfora::results::testing::SyntheticRun synthetic =
      argc > 2 ? perfora::results::testing::make_run(0.15, 6, 0.5044e-3, 0.6) : perfora::results::testing::make_run(0.05, 2, 1e-3, 0.6);
  // A frame in which every bond is broken: viewers must take a grid without cells.
  synthetic.frames.back().bond_pairs.clear();
  synthetic.frames.back().bond_damage.clear();
  perfora::results::testing::write_run(synthetic, folder / "R.h5");
  perfora::results::testing::write_pack(synthetic, folder / "P.h5");
  write_xdmf(folder / "R.h5", folder / "R.xdmf");
  const Scene scene(folder / "R.h5", {});
  write_vtk(scene, folder / "R");
  write_lammps_dump(scene, folder / "R");
  write_xyz(scene, folder / "R");
  plot_run(folder / "R.h5", folder / "R.png");
  plot_packing(folder / "P.h5", folder / "P.png");
  return EXIT_SUCCESS;
}
