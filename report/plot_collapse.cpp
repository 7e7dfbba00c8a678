// What is here: how runs collapse: a row a run, a block a frame, with the stress it carries. What is not: one run in
// full (plot_run.cpp), the blocks themselves (block_picture.h).
#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "io/text.h"
#include "report/block_picture.h"
#include "report/canvas.h"
#include "report/plot.h"
#include "results/frame.h"
#include "results/run_file.h"
#include "results/summary_numbers.h"

namespace perfora::report {
namespace {

constexpr double page_width = 1600.0;
constexpr double page_margin = 44.0;
constexpr double first_row = 130.0;
constexpr double block_gap = 14.0;
constexpr double label_height = 34.0;    ///< above the blocks of a row
constexpr double caption_height = 62.0;  ///< below them
constexpr std::size_t most_blocks = 8;   ///< in a row

/// Frames that are shown: all of them, or as many as fit, evenly, with the first, the peak's and the last among them.
std::vector<std::size_t> shown_frames(const results::RunResult& run) {
  std::vector<std::size_t> chosen;
  if (run.frames.size() <= most_blocks) {
    for (std::size_t k = 0; k < run.frames.size(); ++k) chosen.push_back(k);
    return chosen;
  }
  chosen = snapshot_frames(run);
  for (std::size_t k = 1; chosen.size() < most_blocks && k < most_blocks; ++k) {
    const double wanted = run.frames.back().strain * static_cast<double>(k) / (most_blocks - 1);
    const auto nearest = std::min_element(run.frames.begin(), run.frames.end(), [&](const auto& a, const auto& b) {
      return std::abs(a.strain - wanted) < std::abs(b.strain - wanted);
    });
    const auto index = static_cast<std::size_t>(nearest - run.frames.begin());
    if (std::find(chosen.begin(), chosen.end(), index) == chosen.end()) chosen.push_back(index);
  }
  std::sort(chosen.begin(), chosen.end());
  return chosen;
}

/// Mean stress over 0.5 % strain around a frame, Pa; the peak's frame shows the fall, not the peak.
double stress_around(const results::RunResult& run, double strain) {
  constexpr double half = 0.0025;
  const auto &strains = run.history.strain_yy, &stresses = run.history.stress_yy;
  double sum = 0.0, count = 0.0;
  for (std::size_t k = 0; k < strains.size(); ++k)
    if (std::abs(strains[k] - strain) <= half) sum += stresses[k], count += 1.0;
  return count > 0.0 ? sum / count : 0.0;
}

std::string row_text(const LabelledRun& row) {
  std::string text = row.label;
  const auto add = [&](const char* name, const char* key, io::Dimension dimension) {
    if (const auto value = results::summary_number(row.run.summary, key))
      text += fmt::format("{}{} {}", text.empty() ? "" : "   ", name, io::quantity(*value, dimension));
  };
  add("first peak", "first_peak_stress", io::Dimension::stress);
  add("plateau", "plateau_stress", io::Dimension::stress);
  add("only rising from", "only_rising_strain", io::Dimension::ratio);
  return text;
}

double row_height(const LabelledRun& row) {
  const double width = (page_width - 2.0 * page_margin - (most_blocks - 1) * block_gap) / most_blocks;
  return std::ceil(label_height + width * row.run.height / row.run.width + caption_height);  // whole pixels: rows alike
}

void draw_row(Canvas& canvas, const LabelledRun& row, double top) {
  const double width = (page_width - 2.0 * page_margin - (most_blocks - 1) * block_gap) / most_blocks;
  const double base = top + label_height + width * row.run.height / row.run.width;
  const TextStyle label{.size = 17.0, .bold = true};
  canvas.text(page_margin, top + 12.0, canvas.fit(row_text(row), page_width - 2.0 * page_margin, label), label);
  double x = page_margin;
  for (const std::size_t k : shown_frames(row.run)) {
    const results::FrameInfo& info = row.run.frames[k];
    const BlockPicture picture = picture_of_frame(results::read_frame(row.run, k), row.run.clipped, row.run.edges);
    const double scale = width / std::max(picture.extent_x(), row.run.width);
    draw_block(canvas, {x, base - picture.h_yy * scale, picture.extent_x() * scale, picture.h_yy * scale}, picture);
    canvas.text(x, base + 22.0, io::quantity(info.strain, io::Dimension::ratio) + " strain", {.size = 15.0});
    if (info.strain > 0.0)
      canvas.text(x, base + 41.0, io::quantity(stress_around(row.run, info.strain), io::Dimension::stress),
                  {.size = 15.0, .colour = palette::soft_ink});
    x += width + block_gap;
  }
}

}  // namespace

void plot_collapse(const std::vector<LabelledRun>& rows, const std::filesystem::path& out, const PlotOptions& options) {
  double height = first_row;
  for (const LabelledRun& row : rows) height += row_height(row);
  Canvas canvas(out, page_width, height);
  const TextStyle title{.size = 30.0, .bold = true};
  canvas.text(page_margin, 56.0, canvas.fit(options.title, page_width - 2.0 * page_margin, title), title);
  canvas.text(
      page_margin, 88.0,
      "Fragments by colour (the largest in concrete, crumbs grey, lost bonds red); stress as the mean over 0.5 % "
      "strain around the frame",
      {.size = 17.0, .colour = palette::soft_ink});
  double y = first_row;
  for (const LabelledRun& row : rows) {
    draw_row(canvas, row, y);
    y += row_height(row);
  }
  canvas.write();
}

}  // namespace perfora::report
