// What is here: what a result file shows of its discs and bonds, moment by moment, as plain columns: what every export
// writes. What is not: formats (one file each), the list of exports (registry.h).
#pragma once

#include <fmt/format.h>

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "results/break_event.h"
#include "results/frame.h"
#include "results/run_file.h"

namespace perfora::report {

/// Which quantity stands on the time axis of an export.
enum class TimeAxis { time, strain };

/// What a user may choose of an export.
struct ExportOptions {
  TimeAxis axis = TimeAxis::time;
  /// Only the frame nearest to this strain; of exports of one moment the frame instead of the start.
  std::optional<double> at;
};

/// One number a disc, bond or contact. Whole numbers are written without a decimal point.
struct Column {
  std::string name;  ///< "fragment", "velocity_x"
  std::string unit;  ///< SI; "" for plain numbers
  bool whole = false;
  std::vector<double> values;
};

/// Adds `between` and a value of a column as all texts of exports have it: with the digits that bring back its bits.
void add_value(fmt::memory_buffer& out, char between, const Column& column, std::size_t row);

/// The discs and the intact bonds at one moment.
struct Moment {
  results::FrameInfo info;
  std::vector<double> position;  ///< (n,2), m from the block's lower left corner
  std::vector<Column> columns;
  std::vector<std::int32_t> pairs;  ///< (m,2) intact bonds
  std::vector<Column> bond_columns;
  std::vector<std::int32_t> contacts;  ///< (c,2) pairs that touch; empty where the frames do not hold them
  std::vector<Column> contact_columns;
};

/// Of the material, SI; what the file's configuration says, grade included.
struct SceneMaterial {
  double normal_stiffness = 0.0, tangential_stiffness = 0.0;  ///< N/m
  double density = 0.0;                                       ///< kg/m3
};

/// A run (R.h5) or a packing (P.h5, one moment without bonds).
class Scene {
 public:
  /// Throws io::InputError for a file that is neither, or damaged, and where `at` is given for a file without frames.
  Scene(const std::filesystem::path& file, const ExportOptions& options);

  const std::filesystem::path& path() const { return path_; }
  const std::vector<double>& radius() const { return radius_; }  ///< m
  std::size_t discs() const { return radius_.size(); }
  const results::Edges& edges() const { return edges_; }
  /// Frames that are exported, by rising strain. Empty for a run that kept none.
  std::size_t size() const { return chosen_.size(); }
  const results::FrameInfo& info(std::size_t k) const { return chosen_[k].info; }
  /// Place of frame k in its file.
  std::size_t number(std::size_t k) const { return chosen_[k].place; }
  double axis_value(std::size_t k) const;  ///< s or strain
  Moment moment(std::size_t k) const;      ///< reads the file
  /// Before loading, with every bond that was made.
  Moment start() const;
  bool chose_a_moment() const { return options_.at.has_value(); }
  /// All bonds ever made; empty of a packing.
  const results::Bonds& bonds() const { return bonds_; }
  const std::vector<results::BreakEvent>& events() const { return events_; }
  bool is_run() const { return run_.has_value(); }
  const TimeAxis& axis() const { return options_.axis; }
  /// Throws io::InputError where the configuration in the file does not name it.
  SceneMaterial material() const;
  std::string title() const;  ///< "R.h5 by perfora 0.1.0"

 private:
  struct Chosen {
    results::FrameInfo info;
    std::size_t place = 0;
  };
  void choose(const std::vector<results::FrameInfo>& frames);

  std::filesystem::path path_;
  ExportOptions options_;
  std::vector<double> radius_, start_position_;
  results::FrameInfo start_info_;
  results::Edges edges_;
  results::Bonds bonds_;
  std::vector<results::BreakEvent> events_;
  std::vector<Chosen> chosen_;
  std::optional<results::RunResult> run_;  ///< of a run: to read its frames by
  results::Provenance provenance_;
};

/// Bonds that do not cross the periodic boundary, by their places in `pairs`: the others would be lines right through
/// the block.
std::vector<std::size_t> bonds_inside(const results::FrameInfo& cell, const std::vector<double>& position,
                                      const std::vector<std::int32_t>& pairs);

}  // namespace perfora::report
