// What is here: stress-strain curves of experiments or other programs, read from a CSV file. What is not: histories of
// runs (run_file.h), comparing curves.
#pragma once

#include <filesystem>

#include "results/curve.h"

namespace perfora::results {

/// Whether a curve has one stress at every strain: wanted where it is interpolated, not where it is only drawn.
enum class StrainOrder { any, rising };

/// The curve in the columns `strain` (or `strain_yy`) and `stress` (or `stress_yy`) of a CSV file; others are skipped.
/// Its first line names them with their units in brackets ("strain [%], stress [MPa]"), without a unit they are SI;
/// '#' starts a comment. Compression is positive, strains are engineering ones. The curve is called as the file,
/// without its extension. Throws io::InputError, which names file, line and column: a missing or empty file, a missing
/// column, a unit of something else, text in place of a number, a strain of 1 or more, fewer than two rows, and with
/// StrainOrder::rising a strain not above the one before.
Curve read_curve(const std::filesystem::path& path, StrainOrder order = StrainOrder::any);

}  // namespace perfora::results
