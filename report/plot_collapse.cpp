// What is here: how runs collapse: a run after the other, a block a frame, with the stress it carries. What is not: one
// run in full (plot_run.cpp), the blocks themselves (block_picture.h).
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
constexpr std::size_t most_blocks = 8;   ///< of a run
constexpr double least_height = 55.0;    ///< of a block, where fewer of them in a row make it higher

/// Frames that are shown: all of them, or as many as fit.
std::vector<std::size_t> shown_frames(const results::RunResult& run) {
  if (run.frames.size() > most_blocks) return snapshot_frames(run, most_blocks);
  std::vector<std::size_t> chosen;
  for (std::size_t k = 0; k < run.frames.size(); ++k) chosen.push_back(k);
  return chosen;
}

double block_width(std::size_t in_line) {
  const auto count = static_cast<double>(in_line);
  return (page_width - 2.0 * page_margin - (count - 1.0) * block_gap) / count;
}

/// Blocks beside each other: all of them, of wide blocks fewer, over each other in lines.
std::size_t blocks_in_line(const results::RunResult& run) {
  std::size_t count = most_blocks;
  while (count > 1 && block_width(count) * run.height / run.width < least_height) count /= 2;
  return count;
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

/// A line of blocks with its captions, in whole pixels: lines alike.
double height_of_line(const results::RunResult& run) {
  return std::ceil(block_width(blocks_in_line(run)) * run.height / run.width + caption_height);
}

double row_height(const LabelledRun& row) {
  const std::size_t in_line = blocks_in_line(row.run);
  const std::size_t lines = (shown_frames(row.run).size() + in_line - 1) / in_line;
  return label_height + static_cast<double>(std::max<std::size_t>(1, lines)) * height_of_line(row.run);
}

void draw_row(Canvas& canvas, const LabelledRun& row, double top) {
  const std::size_t in_line = blocks_in_line(row.run);
  const double width = block_width(in_line);
  const TextStyle label{.size = 17.0, .bold = true};
  canvas.text(page_margin, top + 12.0, canvas.fit(row_text(row), page_width - 2.0 * page_margin, label), label);
  const std::vector<std::size_t> shown = shown_frames(row.run);
  for (std::size_t place = 0; place < shown.size(); ++place) {
    const results::FrameInfo& info = row.run.frames[shown[place]];
    const auto line = static_cast<double>(place / in_line), column = static_cast<double>(place % in_line);
    const double x = page_margin + column * (width + block_gap);
    const double base = top + label_height + width * row.run.height / row.run.width + line * height_of_line(row.run);
    const BlockPicture picture =
        picture_of_frame(results::read_frame(row.run, shown[place]), row.run.clipped, row.run.edges);
    const double scale = width / std::max(picture.extent_x(), row.run.width);
    draw_block(canvas, {x, base - picture.h_yy * scale, picture.extent_x() * scale, picture.h_yy * scale}, picture);
    canvas.text(x, base + 22.0, io::quantity(info.strain, io::Dimension::ratio) + " strain", {.size = 15.0});
    if (info.strain > 0.0)
      canvas.text(x, base + 41.0, io::quantity(stress_around(row.run, info.strain), io::Dimension::stress),
                  {.size = 15.0, .colour = palette::soft_ink});
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
