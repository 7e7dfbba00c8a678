// What is here: what the program that refreshes docs/developer/verification.md is made of. What is not: the checks
// themselves.
#pragma once

#include <filesystem>

namespace perfora::verification {

/// Puts the lines of DOCS/data/verification/checks.txt as tables into DOCS/developer/verification.md, each suite's
/// between its markers "<!-- checks: Suite -->" and "<!-- end -->". Throws std::runtime_error for a suite without
/// markers.
void insert_checks(const std::filesystem::path& docs);

/// Draws DOCS/images/verification-*.png from the tables in DOCS/data/verification.
void draw_pictures(const std::filesystem::path& docs);

}  // namespace perfora::verification
