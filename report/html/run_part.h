// What is here: the part of a page about one run: its curves, its block frame by frame, how far it can be trusted. What
// is not: the page (page.h), folders of work (campaign_parts.h).
#pragma once

#include <vector>

#include "report/html/part.h"
#include "results/run_file.h"

namespace perfora::report {

/// What a run's part may take.
struct RunPartOptions {
  std::vector<results::Curve> measured;  ///< drawn beside its curve
  std::size_t most_bytes = 3'600'000;    ///< of the frames, packed; frames are left out in turn until they fit
};

/// Facts: `title`, `block` (one line), `verdict`, `tables`, `history`, `marks`, `frames`, `fragments`, `cracks`,
/// `validity`, `command`, `config`. Numbers: "history", "discs", "places", "frames". Throws io::InputError for a run
/// file whose frames cannot be read.
Part run_part(const results::RunResult& run, const RunPartOptions& options);

/// The frames and what is counted in them, added to `part` (frames_part.cpp).
void add_frames(const results::RunResult& run, std::size_t most_bytes, Part& part);

/// Whether what the numbers rest on is in order: rows {name, value, guide, good}.
nlohmann::json validity_facts(const nlohmann::json& summary, double mean_diameter, const Configured& keys);

}  // namespace perfora::report
