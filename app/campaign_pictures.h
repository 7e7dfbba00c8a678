// What is here: pictures of the folders of studies, sweeps, ensembles and calibrations, from their files alone: what
// their commands draw at the end and `perfora plot DIR` at any time. What is not: drawing (report/), the files
// (results/).
#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace perfora::app {

/// Draws what is in `folder`; `title` empty: its own. `curve_files`: measured curves (CSV) beside those that the design
/// names; a calibration shows none. Throws io::InputError for a folder of no such work, and where there is nothing to
/// draw yet.
void draw_campaign(const std::filesystem::path& folder, const std::filesystem::path& out, const std::string& title = "",
                   const std::vector<std::string>& curve_files = {});

/// The cases of a sweep's folder whose run files were kept, frame by frame (replicate 0); `title` empty: its own.
/// False: there are none, and nothing is drawn. Throws io::InputError for a folder of no sweep.
bool draw_collapse(const std::filesystem::path& folder, const std::filesystem::path& out,
                   const std::string& title = "");

/// Draws the map in DIR/map.json, of `perfora map` or of a study.
void draw_map(const std::filesystem::path& folder, const std::filesystem::path& out, const std::string& title = "");

}  // namespace perfora::app
