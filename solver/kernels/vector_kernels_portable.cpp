// What is here: the vector loops for any machine (compile options in CMakeLists.txt). What is not: the loops themselves
// (bond_sweep.h, contact_sweep.h).
#include "solver/kernels/bond_sweep.h"
#include "solver/kernels/contact_sweep.h"

namespace perfora::solver {

const VectorKernels vector_kernels_portable = {lanes,        "portable",   quartic,       general,
                                               quartic_weak, general_weak, sweep_contacts};

}  // namespace perfora::solver
