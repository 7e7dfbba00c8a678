// What is here: the pictures of a film: a run frame by frame, the curve so far beside the block, all to one scale. What
// is not: making a film of them (app/movie.cpp), the three snapshots of one picture (plot.h).
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "results/run_file.h"

namespace perfora::report {

/// Writes folder/frame-0000.png and so on, 1280 x 720 pixels, one a frame of the run; returns how many. Throws
/// io::InputError for a run without frames, and as results::read_frame does.
std::size_t draw_movie(const results::RunResult& run, const std::string& title, const std::filesystem::path& folder);

/// "frame-0007.png"
std::string movie_frame_name(std::size_t number);

}  // namespace perfora::report
