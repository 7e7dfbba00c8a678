// What is here: made-up runs and packings with the shape of real ones, in memory and as R.h5 and P.h5, for the tests of
// results and report. What is not: mechanics; nothing here is a result.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "results/run_file.h"

namespace perfora::results::testing {

struct SyntheticRun {
  RunResult run;
  std::vector<Frame> frames;
};

/// A square block of `size` (m) with `holes` x `holes` perforations of 20 mm per 25 mm of pitch (scaled with the size),
/// discs on a jittered triangular lattice, compressed to `until`. Frames at 0, 0.9 %, 10 %, ... Plateau of 0.025 MPa
/// after a peak of 0.55 MPa at 0.9 %.
SyntheticRun make_run(double size, int holes, double mean_diameter, double until, unsigned seed = 1);

/// Writes it as docs/user/formats.md says.
void write_run(const SyntheticRun& synthetic, const std::filesystem::path& path);
void write_pack(const SyntheticRun& synthetic, const std::filesystem::path& path);

/// An empty folder for one test, removed first when it is there.
std::filesystem::path fresh_folder(const std::string& name);

}  // namespace perfora::results::testing
