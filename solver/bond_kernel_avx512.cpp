// What is here: the bond loops for AVX-512 (compile options in CMakeLists.txt). What is not: the loop itself
// (bond_kernel_body.h).
#include "solver/bond_kernel_body.h"

namespace perfora::solver {

const BondKernels bond_kernels_avx512 = {lanes, "avx512", quartic, general, quartic_weak, general_weak};

}  // namespace perfora::solver
