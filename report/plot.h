// What is here: pictures of one run, one packing, material tests and one elastic response, 1600 pixels wide (PNG; SVG
// and PDF by extension). What is not: studies (plot_study.h).
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "results/curve.h"
#include "results/elastic_file.h"
#include "results/frame.h"
#include "results/pack_file.h"
#include "results/run_file.h"

namespace perfora::results {
struct CalibrationRecord;
}

namespace perfora::report {

struct PlotOptions {
  std::string title;                    ///< "": the name of the file
  std::optional<double> target_stress;  ///< Pa: a line to compare the plateau with
  /// Drawn thin beside the curves of runs, under their names (plot_run, plot_comparison).
  std::vector<results::Curve> measured = {};
};

/// What plot_run shows: a run and up to three of its frames (intact, at the first peak, last).
struct RunPicture {
  const results::RunResult* run = nullptr;
  struct Snapshot {
    std::string caption;
    results::Frame frame;
  };
  std::vector<Snapshot> snapshots;
};

/// The frames a picture shows, in their order: the first, the one nearest to the first peak (strain from the summary),
/// the last; fewer where they coincide. Up to `most`, at least 3, with others as evenly spaced in strain as the frames
/// allow.
std::vector<std::size_t> snapshot_frames(const results::RunResult& run, std::size_t most = 3);

/// R.h5 -> picture: stress over strain with first peak, plateau and what else the summary knows; the block at
/// three strains with its fragments, a wide block at as many as find room over each other. Throws io::InputError for a
/// bad R.h5 or an extension other than .png, .svg, .pdf.
void plot_run(const std::filesystem::path& run_file, const std::filesystem::path& out, const PlotOptions& options = {});
void draw_run(const RunPicture& picture, const std::filesystem::path& out, const PlotOptions& options = {});

/// One run of a picture of several.
struct LabelledRun {
  std::string label;
  results::RunResult run;
  std::string design = {};  ///< runs of one design (other seeds) share it; plot_comparison only
};

/// How runs collapse: a row a run (up to eight of its frames side by side, all to one scale within the row, with strain
/// and stress), under its label, first peak, plateau and the strain from which it only rises. Throws io::InputError as
/// results::read_frame does, and for an extension other than .png, .svg, .pdf.
void plot_collapse(const std::vector<LabelledRun>& rows, const std::filesystem::path& out, const PlotOptions& options);

/// Runs side by side: stress over strain, linear up to the highest first peak and logarithmic (smoothed), and a table
/// of their numbers. Runs of one design have shades of one colour. Throws io::InputError for no run or
/// an extension other than .png, .svg, .pdf.
void plot_comparison(const std::vector<LabelledRun>& rows, const std::filesystem::path& out,
                     const PlotOptions& options);

/// A design before any run -> picture: its holes, its thinnest wall, the direction of loading. options.title is its
/// heading; `mean_diameter` (m) tells how many discs the wall holds.
void plot_layout(const geometry::PerforationLayout& layout, double mean_diameter, const std::filesystem::path& out,
                 const PlotOptions& options);

/// P.h5 -> picture: the clipped block, discs by size, rims of the perforations, the size distribution and the measured
/// quality.
void plot_packing(const std::filesystem::path& packing_file, const std::filesystem::path& out,
                  const PlotOptions& options = {});
void draw_packing(const results::PackResult& pack, const std::filesystem::path& out, const PlotOptions& options = {});

/// T.h5 -> picture: stress over strain of every test and replicate, the cracked sample of each test, the material's
/// numbers.
void plot_material_tests(const std::filesystem::path& test_file, const std::filesystem::path& out,
                         const PlotOptions& options = {});

/// Calibration -> chart: compressive over tensile strength against delta_t0/delta_n0, a curve a zeta_max, with what was
/// wanted and found. Throws io::InputError for an extension other than .png, .svg, .pdf.
void plot_reachable(const results::CalibrationRecord& record, const std::filesystem::path& out,
                    const PlotOptions& options = {});

/// Elastic response -> picture: the block coloured by how near each disc is to its first yield when the block yields
/// first (compression along y at fixed width), the first bonds marked, the moduli and a colour bar with the fraction of
/// discs.
void plot_elastic(const std::filesystem::path& elastic_file, const std::filesystem::path& out,
                  const PlotOptions& options = {});
void draw_elastic(const results::ElasticResult& elastic, const std::filesystem::path& out,
                  const PlotOptions& options = {});

}  // namespace perfora::report
