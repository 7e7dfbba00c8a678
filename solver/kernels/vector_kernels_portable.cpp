// What is here: the vector loops for any machine (compile options in CMakeLists.txt). What is not: the loops themselves
// (bond_kernel.h, contact_kernel.h).
#include "solver/kernels/bond_kernel.h"
#include "solver/kernels/contact_kernel.h"

namespace perfora::solver {

const VectorKernels vector_kernels_portable = {lanes,        "portable",   quartic, general,
                                               quartic_weak, general_weak, contacts};

}  // namespace perfora::solver
