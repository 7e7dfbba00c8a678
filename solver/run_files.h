// What is here: the files of a run: frames and checkpoint in R.part/ while it goes on, R.h5 at its end. What is not:
// when they are written (run.cpp).
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include "solver/frame.h"
#include "solver/response.h"
#include "solver/run_request.h"
#include "solver/simulation.h"

namespace perfora::io {
class Hdf5Writer;
}

namespace perfora::solver {

/// The folder R.part/ beside R.h5. Every file in it is written whole and renamed.
class RunFolder {
 public:
  explicit RunFolder(const std::filesystem::path& run_file);
  const std::filesystem::path& path() const { return folder_; }
  /// An empty folder with config.toml; what an earlier run left there is removed.
  void start_afresh(const std::string& config);
  /// Whether it holds a checkpoint of this configuration (loading.until aside). Throws io::InputError when it holds one
  /// of another.
  bool can_resume(const std::string& config) const;
  std::filesystem::path frame_file(int number) const;
  std::filesystem::path checkpoint_file() const { return folder_ / "checkpoint.h5"; }
  void remove() const;

 private:
  std::filesystem::path folder_;
};

/// A frame (docs/formats.md, "/frames") as a file of its own, or into a group of an open file.
void write_frame(const std::filesystem::path& file, const FrameData& frame);
void write_frame_group(io::Hdf5Writer& file, const std::string& group, const FrameData& frame);
void write_events(io::Hdf5Writer& file, const std::string& group, const std::vector<BreakEvent>& events);

/// What run.cpp keeps beside the simulation and must find again.
struct RunProgress {
  History history;
  std::int64_t rows = 0;
  int frames = 0;
  double kinetic_ratio = 0.0;  ///< kinetic over elastic energy at the last row before the peak was passed
  double seconds = 0.0;        ///< wall time so far
};

void write_checkpoint(const std::filesystem::path& file, const Simulation& simulation, const RunProgress& progress);
/// Throws io::InputError when the file does not belong to a simulation of this size.
RunProgress read_checkpoint(const std::filesystem::path& file, Simulation& simulation);

/// Assembles R.h5 from the request, the simulation and the frames of the folder.
void write_run_file(const RunRequest& request, const Simulation& simulation, const RunFolder& folder,
                    const RunProgress& progress, const Response& response, const std::string& summary);

}  // namespace perfora::solver
