// What is here: the picture of a study: its search, its best design, and what that gained. What is not: its data
// (results/study_record.h), where they come from.
#pragma once

#include <filesystem>

#include "results/study_record.h"

namespace perfora::report {

/// Draws it, 1600 x 1000 pixels. Throws io::InputError for an extension other than .png, .svg, .pdf.
void plot_study(const results::StudyRecord& picture, const std::filesystem::path& out);

}  // namespace perfora::report
