// What is here: the picture of a map: what can be reached, and where the wish lies. What is not: its data
// (results/map_record.h).
#pragma once

#include <filesystem>

#include "results/map_record.h"

namespace perfora::report {

/// Cap ratio, undulation, end of the plateau and porosity against the plateau stress, a point a design (mean over its
/// replicates), with what is wished as bands. Throws io::InputError for an extension other than .png, .svg, .pdf.
void plot_map(const results::MapRecord& record, const std::filesystem::path& out);

}  // namespace perfora::report
