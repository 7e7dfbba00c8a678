// What is here: R.h5, P.h5, T.h5 and elastic answers read into plain structs, checked on the way in (docs/formats.md).
// What is not: how such files are written (solver, geometry), pictures, exports.
#pragma once

#include <cstdint>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "geometry/packing.h"
#include "geometry/perforation.h"

namespace perfora::report {

/// One column of the history, SI.
struct Column {
  std::string name;
  std::string units;
  std::vector<double> values;
};

/// What is known of a frame before its discs are read.
struct FrameInfo {
  std::string name;  ///< "00000"
  double strain = 0.0;
  double time = 0.0;                          ///< s
  double h_xx = 0.0, h_xy = 0.0, h_yy = 0.0;  ///< edges of the block, m
};

/// Discs and bonds at one strain; n discs, m intact bonds.
struct Frame {
  FrameInfo info;
  std::vector<double> position;          ///< (n,2), m from the block's lower left corner, wrapped where it is periodic
  std::vector<double> angle;             ///< rad
  std::vector<std::int32_t> fragment;    ///< 0 is the largest
  std::vector<double> damage;            ///< share of the original bonds lost, 0 to 1
  std::vector<std::int32_t> bond_pairs;  ///< (m,2)
  std::vector<double> bond_damage;       ///< D
};

/// One entry a broken bond; equally long.
struct Events {
  std::vector<double> time, strain, x, y, energy;
  std::vector<std::int32_t> i, j, mode, bond;
  std::size_t size() const { return time.size(); }
};

/// All bonds ever made; m bonds.
struct Bonds {
  std::vector<std::int32_t> pairs;  ///< (m,2), i < j
  std::vector<double> rest_length;  ///< m
  std::vector<double> strength_factor;
  std::size_t size() const { return rest_length.size(); }
};

/// Who made a file, as its attributes tell; empty where they say nothing.
struct Provenance {
  std::string program_version, git_revision, compiler, simd, command_line, seeds;
  std::int64_t threads = 0, results_version = 0;
  double seconds = 0.0;
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
  std::vector<Column> history;    ///< equally long, in the order of docs/formats.md, further ones after them
  std::vector<FrameInfo> frames;  ///< by rising strain
  Events events;
  Bonds bonds;
  geometry::PerforationLayout layout;
  geometry::Packing clipped;
  std::string config;      ///< TOML
  nlohmann::json summary;  ///< object; {} when the file has none

  std::size_t rows() const { return history.empty() ? 0 : history.front().values.size(); }
  /// Throws io::InputError naming the file when there is no such column.
  const std::vector<double>& column(std::string_view name) const;
};

/// P.h5.
struct PackResult {
  std::filesystem::path path;
  Provenance provenance;
  geometry::Packing periodic, clipped;
  geometry::PerforationLayout layout;
  std::string config;
  nlohmann::json summary;
};

/// One test of T.h5; the frame is read for replicate 0 only.
struct MaterialTest {
  std::string name;  ///< "tension", "compression", "shear", "oedometric"
  int replicate = 0;
  std::vector<double> strain, stress;  ///< stress Pa; positive as the test loads
  std::optional<Frame> frame;          ///< the sample at the end
};

/// T.h5.
struct MaterialResult {
  std::filesystem::path path;
  Provenance provenance;
  geometry::Packing sample;
  std::vector<MaterialTest> tests;  ///< by name, then by replicate
  std::string config;
  nlohmann::json summary;
};

/// Elastic answer (`perfora evaluate --elastic`); n discs.
struct ElasticResult {
  std::filesystem::path path;
  Provenance provenance;
  geometry::Packing clipped;
  geometry::PerforationLayout layout;
  std::vector<double> disc_strain;  ///< strain at which the first bond of a disc yields; infinite where none does
  struct {
    std::vector<double> x, y, strain;  ///< m; by rising strain
    std::vector<std::int32_t> mode;    ///< 0 tension, 1 shear
  } first_bonds;
  std::string config;
  nlohmann::json summary;
};

/// Throws io::InputError for a file that is missing, not HDF5, of another `format`, or whose columns are unequally long
/// or not finite.
RunResult read_run(const std::filesystem::path& path);
/// `index` into run.frames. Throws as read_run does; also when an index in it points outside the discs.
Frame read_frame(const RunResult& run, std::size_t index);
PackResult read_pack(const std::filesystem::path& path);
MaterialResult read_material_tests(const std::filesystem::path& path);
ElasticResult read_elastic(const std::filesystem::path& path);

/// A number of a summary (also of its objects `summary` and `pack`), std::nullopt where the key is missing or null (not
/// reached).
std::optional<double> summary_number(const nlohmann::json& summary, std::string_view key);

/// The plateau window (start, end; engineering strain), std::nullopt where the summary has none.
std::optional<std::pair<double, double>> plateau_window(const nlohmann::json& summary);

/// The history as CSV: one line of names, then one line a row, 17 digits. Units: SI, as docs/formats.md lists them.
std::string history_csv(const RunResult& run);

}  // namespace perfora::report
