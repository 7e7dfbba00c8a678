// What is here: a material handed from one design to another: the file that `perfora calibrate` writes and
// `material.from` names. What is not: how it is found (optimize/search/calibration.h).
#pragma once

#include <filesystem>
#include <string>

#include "optimize/evaluate/design.h"

namespace perfora::optimize {

/// Sets the keys of [material], [packing] and [noise] that the file gives: stiffnesses, thresholds and horizon, and
/// with them the sizes and the solid fraction of the discs and the spread of strength, since E and strengths hold for
/// these together. `origin`: where the file is named. Throws io::InputError for a missing file, a bad one, a key of
/// another section, an imported packing, and a file that names another in turn.
void apply_calibrated_material(io::Schema& schema, const std::filesystem::path& path, const io::Origin& origin);

/// Such a file of a design's material, every number in full, with `remarks` (lines without #) above it. An imported
/// packing has no sizes to hand over: its file is then without [packing].
std::string calibrated_material(const DesignFile& design, const std::string& remarks);

}  // namespace perfora::optimize
