// What is here: R.h5 read, checked and written. What is not: anything that is computed from it.
#include "results/run_file.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "geometry/packing_file.h"
#include "results/file_parts.h"
#include "results/formats.h"

namespace perfora::results {
namespace {

Edges read_edges(const io::Hdf5Reader& file) {
  const std::string sides = optional_attribute(file, "sides");
  return {optional_attribute(file, "top_bottom") == "platens", sides == "walls", sides == "free"};
}

const char* sides_name(const Edges& edges) {
  return edges.walls ? "walls" : edges.free ? "free" : "periodic";
}

std::vector<FrameInfo> read_frame_list(const io::Hdf5Reader& file) {
  std::vector<FrameInfo> frames;
  if (!file.has("/frames")) return frames;
  for (const std::string& name : file.children("/frames"))
    frames.push_back(read_frame_info(file, "/frames/" + name, name));
  std::stable_sort(frames.begin(), frames.end(), [](const auto& a, const auto& b) { return a.strain < b.strain; });
  return frames;
}

Bonds read_bonds(const io::Hdf5Reader& file, std::int32_t discs) {
  Bonds bonds;
  if (!file.has("/bonds")) return bonds;
  bonds.reference_length = finite_doubles(file, "/bonds/rest_length");
  bonds.strength_factor = finite_doubles(file, "/bonds/strength_factor");
  bonds.pairs = file.int32s("/bonds/pairs");
  require_size(file, "/bonds/strength_factor", bonds.strength_factor, bonds.size());
  require_size(file, "/bonds/pairs", bonds.pairs, 2 * bonds.size());
  require_discs(file, "/bonds/pairs", bonds.pairs, discs);
  return bonds;
}

}  // namespace

RunResult read_run(const std::filesystem::path& path) {
  const io::Hdf5Reader file(path);
  require_format(file, run_format, "a run", "give the R.h5 of `perfora evaluate`");
  RunResult run;
  run.path = path;
  run.status = optional_attribute(file, "status");
  run.reason = optional_attribute(file, "reason");
  run.provenance = read_provenance(file);
  run.width = file.attribute_double("/", "width");
  run.height = file.attribute_double("/", "height");
  run.mean_diameter = file.attribute_double("/", "mean_diameter");
  if (!(run.width > 0.0) || !(run.height > 0.0)) refuse(file, "width", "the block has no size", "positive sizes");
  run.edges = read_edges(file);
  run.history = read_history(file, "/history");
  for (const auto& [name, column] :
       {std::pair("strain_yy", &run.history.strain_yy), std::pair("stress_yy", &run.history.stress_yy)})
    if (column->empty() && !file.has(std::string("/history/") + name))
      refuse(file, std::string("/history/") + name, "is missing");
  run.frames = read_frame_list(file);
  run.clipped = geometry::read_packing(file, "/clipped");
  require_packing(file, "/clipped", run.clipped);
  run.layout = geometry::read_layout(file, "/layout");
  run.events = read_events(file, "/events", run.clipped.size());
  run.bonds = read_bonds(file, run.clipped.size());
  run.summary = read_summary(file);
  return run;
}

Frame read_frame(const RunResult& run, std::size_t index) {
  const io::Hdf5Reader file(run.path);
  const FrameInfo& info = run.frames.at(index);
  return read_frame_group(file, "/frames/" + info.name, info, run.clipped.size());
}

void write_frame(const std::filesystem::path& path, const Frame& frame) {
  io::Hdf5Writer file(path);
  write_frame_group(file, "/frame", frame);
  file.commit();
}

void write_run(const std::filesystem::path& path, const RunResult& run,
               const std::vector<std::filesystem::path>& frame_files, const geometry::Packing* periodic) {
  io::Hdf5Writer file(path);
  write_head(file, run_format, run.provenance, run.summary);
  file.attribute("/", "status", run.status);
  file.attribute("/", "reason", run.reason);
  file.attribute("/", "width", run.width);
  file.attribute("/", "height", run.height);
  file.attribute("/", "mean_diameter", run.mean_diameter);
  file.attribute("/", "top_bottom", std::string(run.edges.platens ? "platens" : "periodic"));
  file.attribute("/", "sides", std::string(sides_name(run.edges)));
  write_history(file, "/history", run.history);
  file.group("/frames");
  for (std::size_t k = 0; k < frame_files.size(); ++k)
    file.copy_from(frame_files[k], "/frame", fmt::format("/frames/{:05d}", k));
  write_events(file, "/events", run.events);
  file.dataset("/bonds/pairs", run.bonds.pairs, 2);
  file.dataset("/bonds/rest_length", run.bonds.reference_length, 0, "m");
  file.dataset("/bonds/strength_factor", run.bonds.strength_factor);
  if (periodic != nullptr) geometry::write_packing(file, "/packing", *periodic);
  geometry::write_packing(file, "/clipped", run.clipped);
  geometry::write_layout(file, "/layout", run.layout);
  file.commit();
}

}  // namespace perfora::results
