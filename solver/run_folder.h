// What is here: the folder R.part/ in which the closed files of a run grow: two checkpoints, written in turn, and
// frames. What is not: their contents (checkpoint.h, results/run_file.h), when they are written (run.cpp).
#pragma once

#include <array>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <string>
#include <vector>

#include "solver/checkpoint.h"

namespace perfora::solver {

/// The folder R.part/ beside R.h5. Every file in it is written whole and renamed, and a new checkpoint replaces the
/// older of two: at any moment the newest one stands or the one before.
class RunFolder {
 public:
  explicit RunFolder(const std::filesystem::path& run_file);
  const std::filesystem::path& path() const { return folder_; }
  /// An empty folder; what an earlier run left there is removed.
  void start_afresh() const;
  bool holds_checkpoint() const;

  /// Restores `simulation` from the newest checkpoint that is sound and whose frames are all there; says in a warning
  /// why one was passed over. Frames that no checkpoint can bring back are named in a warning and left out.
  /// `configuration`: of the run now (its end aside it must be that of the checkpoint); `comparable` turns both
  /// into what can be compared, empty: they are. Throws io::InputError when no checkpoint is sound, with the reason
  /// of each, and when it is that of another configuration.
  RunProgress resume(Simulation& simulation, const std::string& configuration,
                     const std::function<std::string(const std::string&)>& comparable);
  /// Replaces the older checkpoint, then removes the frames that neither names.
  void write_checkpoint(const Simulation& simulation, const RunProgress& progress, const std::string& configuration);

  /// The frame taken at this step.
  std::filesystem::path frame_file(std::int64_t step) const;
  /// Why that frame of `discs` discs cannot be used; empty: it can.
  std::string frame_problem(std::int64_t step, std::int32_t discs) const;
  /// Removes the folder, also one that is half removed. A failure is a warning: the result of the run stands elsewhere.
  void remove() const;

 private:
  /// A checkpoint that was found, or why it cannot be used.
  struct Found;
  struct LostFrame {
    std::int64_t step = 0;
    double strain = 0.0;
    std::string problem;
  };
  std::array<std::filesystem::path, 2> checkpoint_files() const;
  Found look_at(std::size_t slot, const Simulation& simulation) const;
  const Found& prefer_complete(std::vector<Found>& sound, std::int32_t discs) const;
  std::vector<LostFrame> lost_frames(const RunProgress& progress, std::int32_t discs) const;
  void remove_frames_but(const std::vector<std::int64_t>& steps) const;

  std::filesystem::path folder_;
  std::size_t next_ = 0;               ///< which of the two files is written next
  std::int64_t number_ = 0;            ///< of the last checkpoint
  std::int64_t other_peak_frame_ = 0;  ///< step of the peak's frame that the other checkpoint names
};

}  // namespace perfora::solver
