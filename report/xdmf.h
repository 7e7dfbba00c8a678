// What is here: R.h5 -> R.xdmf, which ParaView opens: discs, bonds and the cell at every frame.
// What is not: other formats.
#pragma once

#include <filesystem>

namespace perfora::report {

/// Writes `out` (R.xdmf) and beside it `<out>.h5`, which holds what XDMF needs and R.h5 has not: the connectivity of
/// the discs, and of each frame the bonds that do not cross the periodic boundary (the others would be lines right
/// through the block). All else is read from `run_file`: keep the three together. A frame is a set of three grids:
/// `discs` (points; radius, angle, fragment, damage), `bonds` (lines; damage), `cell` (outline). Throws io::InputError
/// for a bad run file or one without frames' group; a run with no frame gives an empty collection.
void write_xdmf(const std::filesystem::path& run_file, const std::filesystem::path& out);

}  // namespace perfora::report
