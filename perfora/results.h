// What is here: what a result is (measures, tables, an evaluation, a run) and the readers of the files that hold them.
// What is not: making results (pack.h, evaluate.h, campaign.h), packings (pack.h), folders of campaigns (campaign.h).
#pragma once

#include <cstddef>
#include <filesystem>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include "perfora/design.h"

namespace perfora {

/// How work ended.
enum class Status {
  completed,  ///< as wanted
  stopped,    ///< by its caller, a signal or a time limit; it can go on
  failed      ///< numerical trouble: a packing that was not reached, an unstable step; the reason is said beside it
};

/// One number that a packing or a run is summed up by (docs/user/formats.md lists all).
struct Measure {
  std::string key;        ///< "plateau_stress"
  std::string label;      ///< for people: "plateau stress"
  std::string dimension;  ///< "stress", "ratio", "count", ...; empty: a plain number
  std::string unit;       ///< SI: "Pa"; empty: none
  std::string help;       ///< one clause
  double value = 0.0;     ///< SI; NaN where it was not reached
};

/// The value of a measure. Throws Error for a key that `measures` lacks, naming the nearest one.
double value_of(const std::vector<Measure>& measures, const std::string& key);

/// One column of a table.
struct Column {
  std::string name;                ///< "strain_yy"
  std::string unit;                ///< SI: "Pa"; empty: none, or not known
  std::vector<double> values;      ///< NaN where a field is empty or no number
  std::vector<std::string> texts;  ///< the fields as written; empty but for tables of CSV files
};

/// Equally long columns, one entry a row.
struct Table {
  std::vector<Column> columns;  ///< in the order of the file

  /// Number of rows.
  std::size_t rows() const;
  /// Whether there is a column of that name.
  bool has(const std::string& name) const;
  /// The numbers of a column, valid as long as this table. Throws Error where there is none of that name.
  std::span<const double> values(const std::string& name) const;
  /// The fields of a column as written, valid as long as this table; empty but for tables of CSV files. Throws Error
  /// where there is none of that name.
  std::span<const std::string> texts(const std::string& name) const;
};

/// Whether the wishes of a design's [target] are met (docs/user/theory.md, "Verdict").
struct Verdict {
  std::string outcome;  ///< "met", "missed", "not shown", "out of reach"; empty: nothing was wished
  std::string text;     ///< one line: the outcome and the wishes that decide it
  std::string note;     ///< what the numbers are worth beyond their scatter
};

/// What one evaluation of a design gave.
struct Evaluation {
  Status status = Status::completed;  ///< how it ended
  std::string reason;                 ///< in words: "reached strain 0.6", "wall time", ...
  int replicate = 0;                  ///< which packing and strength field: 0, 1, ...
  std::vector<Measure> measures;      ///< of the packing, then of the run
  Table curve;                        ///< a row a history row (docs/user/formats.md names the columns)
  std::vector<std::string> warnings;  ///< what speaks against its numbers, a sentence each; not kept in files
  Verdict verdict;                    ///< on this one block, which shows little; an ensemble's shows more
  double seconds = 0.0;               ///< wall time of the compression
  std::string record;                 ///< what to_json() gives without the curve

  /// The value of a measure, NaN where it was not reached. Throws Error for an unknown key.
  double measure(const std::string& key) const;
  /// Engineering strain of the curve, compression positive; valid as long as this evaluation.
  std::span<const double> strain() const;
  /// Stress of the curve, Pa, compression positive; as long as strain().
  std::span<const double> stress() const;
  /// The record perfora.evaluate/1 (docs/user/formats.md), what `perfora evaluate --json` prints; `with_curve` adds the
  /// history, all of it, so that from_json() gives the same back in another process. Throws Error for the latter of an
  /// evaluation that was not made by the library.
  std::string to_json(bool with_curve = false) const;
  /// An evaluation from its record, its curve from the history in it. Throws Error for a text that is none.
  static Evaluation from_json(const std::string& text);

 private:
  friend struct Inside;
  struct Content;
  std::shared_ptr<const Content> content_;
};

/// A run file.
struct Run {
  Evaluation evaluation;              ///< its result
  std::string design;                 ///< all keys of the design, TOML, for Design::from_toml()
  std::string program_version;        ///< that wrote it
  std::vector<double> frame_strains;  ///< engineering strain of each frame that it holds, rising
};

/// Reads a run file R.h5. Throws Error for a file that is missing, damaged or no run.
Run read_run(const std::filesystem::path& file);

/// Reads a CSV file of the program: histories, cases, runs, curves, candidates of a study. Throws Error.
Table read_table(const std::filesystem::path& file);

/// What a file or folder holds: "run", "packing", "material tests", "elastic response", "checkpoint", "table" (CSV);
/// "study", "sweep", "ensemble", "calibration" of a folder; "study file", "sweep file", "calibration file", "design" of
/// TOML; empty for anything else. Throws Error for what is missing or cannot be read.
std::string kind_of(const std::filesystem::path& path);

/// The JSON record that a result file (.h5, .json) or the folder of a finished campaign holds, as `perfora show --json`
/// prints it; empty where it holds none. Throws Error.
std::string stored_record(const std::filesystem::path& path);

}  // namespace perfora
