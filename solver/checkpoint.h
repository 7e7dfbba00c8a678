// What is here: the checkpoint of a run: everything it needs to continue with the same bits, as one file that proves
// itself. What is not: the list of the members in it (checkpoint_members.h), the folder it lies in and which of two is
// taken (run_folder.h), when it is written (run.cpp).
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include "results/history.h"
#include "solver/peak_watch.h"
#include "solver/simulation.h"

namespace perfora::solver {

/// What run.cpp keeps beside the simulation and must find again.
struct RunProgress {
  results::History history;
  std::int64_t centred_rows = 0;          ///< rows of it whose stresses are means up to their far end (samples.h)
  std::vector<double> frame_strains;      ///< of the frames kept so far, rising
  std::vector<std::int64_t> frame_steps;  ///< the steps they were taken at, which name their files
  PeakWatch watch;
  double peak_frame_stress = 0.0, peak_frame_strain = 0.0;  ///< largest mean of a segment so far, and where
  std::int64_t peak_frame_step = 0;                         ///< step of the frame taken there; 0: none
  double kinetic_ratio = 0.0;  ///< kinetic over elastic energy at the last look before the peak was passed
  double seconds = 0.0;        ///< wall time so far
};

struct Checkpoint {
  std::int64_t number = 0;    ///< rises with each checkpoint of a run
  std::string configuration;  ///< what a resumed run must share with the run it goes on from
  Simulation::Snapshot simulation;
  RunProgress run;
};

/// Written whole and renamed, with a checksum over all of it.
void write_checkpoint(const std::filesystem::path& path, Checkpoint checkpoint);

/// Reads a checkpoint for a simulation that was set up from the same design. Nothing of it can lead the simulation
/// outside its arrays. Throws io::InputError that names the file, the dataset and what is wrong: a checksum that does
/// not fit, another format, another design, lengths that do not belong together, indices and numbers out of range.
Checkpoint read_checkpoint(const std::filesystem::path& path, const Simulation& simulation);

}  // namespace perfora::solver
