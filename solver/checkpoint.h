// What is here: the checkpoint of a run: everything it needs to continue with the same bits. What is not: the folder
// it lies in (run_folder.h), when it is written (run.cpp).
#pragma once

#include <cstdint>
#include <filesystem>
#include <vector>

#include "results/history.h"
#include "solver/peak_watch.h"
#include "solver/simulation.h"

namespace perfora::solver {

/// What run.cpp keeps beside the simulation and must find again.
struct RunProgress {
  results::History history;
  std::vector<double> frame_strains;  ///< of the frames kept so far, rising
  PeakWatch watch;
  double peak_frame_stress = 0.0, peak_frame_strain = 0.0;  ///< largest mean of a segment so far, and where
  double kinetic_ratio = 0.0;  ///< kinetic over elastic energy at the last look before the peak was passed
  double seconds = 0.0;        ///< wall time so far
};

void write_checkpoint(const std::filesystem::path& path, const Simulation& simulation, const RunProgress& progress);
/// Throws io::InputError when the file does not belong to a simulation of this size.
RunProgress read_checkpoint(const std::filesystem::path& path, Simulation& simulation);

}  // namespace perfora::solver
