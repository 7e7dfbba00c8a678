// What is here: R.h5 -> R.xdmf, which ParaView opens: discs, bonds and the cell at every frame.
// What is not: other formats.
#pragma once

#include <filesystem>

#include "report/export/scene.h"

namespace perfora::report {

/// Writes `out` (R.xdmf) and beside it `<out>.h5`, which holds what XDMF needs and R.h5 has not: the connectivity of
/// the discs, and of each frame the bonds that do not cross the periodic boundary (the others would be lines right
/// through the block). All else is read from `run_file`: keep the three together. Three collections through time:
/// `discs` (points; radius, angle, fragment, damage), `bonds` (lines; damage), `cell` (outline; strain). ParaView 5.11
/// offers several readers: "XDMF Reader" shows the three as named blocks, the Xdmf3 readers show them without names.
/// Throws io::InputError for a bad run file; a run without frames gives empty collections.
void write_xdmf(const std::filesystem::path& run_file, const std::filesystem::path& out,
                TimeAxis axis = TimeAxis::time);

}  // namespace perfora::report
