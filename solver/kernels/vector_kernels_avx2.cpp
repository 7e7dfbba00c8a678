// What is here: the vector loops for AVX2 (compile options in CMakeLists.txt). What is not: the loops themselves
// (bond_kernel.h, contact_kernel.h).
#include "solver/kernels/bond_kernel.h"
#include "solver/kernels/contact_kernel.h"

namespace perfora::solver {

const VectorKernels vector_kernels_avx2 = {lanes, "avx2", quartic, general, quartic_weak, general_weak, contacts};

}  // namespace perfora::solver
