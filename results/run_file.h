// What is here: R.h5, the file of a run: its record, its one reader and its one writer. What is not: checkpoints
// (solver/checkpoint.h), when files are written (solver/run.cpp), the groups it shares (file_parts.h).
#pragma once

#include <cstdint>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "geometry/packing.h"
#include "geometry/perforation.h"
#include "results/break_event.h"
#include "results/frame.h"
#include "results/history.h"
#include "results/provenance.h"

namespace perfora::results {

/// All bonds ever made; m bonds.
struct Bonds {
  std::vector<std::int32_t> pairs;       ///< (m,2), i < j
  std::vector<double> reference_length;  ///< m
  std::vector<double> strength_factor;
  std::size_t size() const { return reference_length.size(); }
};

/// What stands at the edges of the block.
struct Edges {
  bool platens = false;  ///< at top and bottom; else periodic
  bool walls = false;    ///< at the sides
  bool free = false;     ///< sides; neither: periodic
  bool open_x() const { return walls || free; }
};

/// R.h5 without its frames' discs (read_frame reads those one by one: a run with all frames may not fit in memory).
struct RunResult {
  std::filesystem::path path;
  std::string status, reason;
  Provenance provenance;
  double width = 0.0, height = 0.0, mean_diameter = 0.0;  ///< m
  Edges edges;
  History history;
  std::vector<FrameInfo> frames;  ///< by rising strain
  std::vector<BreakEvent> events;
  Bonds bonds;
  geometry::PerforationLayout layout;
  geometry::Packing clipped;
  nlohmann::json summary;  ///< object; {} when the file has none
};

/// Throws io::InputError for a file that is missing, not HDF5, of another `format`, or whose columns are unequally long
/// or not finite.
RunResult read_run(const std::filesystem::path& path);
/// `index` into run.frames. Throws as read_run does; also when an index in it points outside the discs.
Frame read_frame(const RunResult& run, std::size_t index);

/// A frame as a file of its own, which write_run takes in (docs/user/formats.md, "R.h5 (run)").
void write_frame(const std::filesystem::path& path, const Frame& frame);
/// R.h5, whole or not at all; `run.path` and `run.frames` do not count. `frame_files`: as write_frame wrote them, in
/// order. `periodic`: the packing before it was clipped; may be null. Throws std::runtime_error when the disk fails.
void write_run(const std::filesystem::path& path, const RunResult& run,
               const std::vector<std::filesystem::path>& frame_files, const geometry::Packing* periodic);

}  // namespace perfora::results
