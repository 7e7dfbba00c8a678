// What is here: a program of someone else's: packs and crushes a small design through the library. What is not:
// anything but the public headers.
#include <iostream>

#include "optimize/evaluate/design.h"
#include "optimize/evaluate/evaluation.h"

int main() {
  perfora::optimize::DesignFile file;
  auto& design = file.design();
  design.layout.width = design.layout.height = 0.020;
  design.layout.rows = design.layout.columns = 1;
  design.layout.diameter = 0.008;
  design.packing.mean_diameter = 0.5044e-3;
  design.solver.loading.until = 0.002;
  const auto packed = perfora::optimize::pack_design(file, {}, 0);
  std::cout << packed.summary.discs << " discs, porosity " << packed.summary.porosity << "\n";
  const auto evaluation = perfora::optimize::evaluate_design(file, {}, 0);
  std::cout << evaluation.summary.steps << " steps to strain " << evaluation.summary.final_strain << "\n";
  return evaluation.summary.final_strain >= 0.002 * 0.999 ? 0 : 1;
}
