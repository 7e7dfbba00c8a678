// What is here: one picture a frame. What is not: choosing frames (output.frames of the design).
#include "report/movie.h"

#include <fmt/format.h>

#include <algorithm>

#include "io/error.h"
#include "io/text.h"
#include "report/block_picture.h"
#include "report/canvas.h"
#include "report/chart.h"
#include "results/summary_numbers.h"

namespace perfora::report {
namespace {

constexpr double page_width = 1280.0, page_height = 720.0, margin = 36.0, middle = 620.0, top = 96.0, bottom = 60.0;

/// Largest stress that the axis shows: the first peak, or four times the plateau where that is more, so that the last
/// percent of strain do not hide the rest.
double stress_shown(const results::RunResult& run) {
  const auto& stress = run.history.stress_yy;
  const double most = stress.empty() ? 0.0 : *std::max_element(stress.begin(), stress.end());
  constexpr double room = 1.15, plateaus = 4.0;
  const double peak = results::summary_number(run.summary, "first_peak_stress").value_or(most);
  const double plateau = results::summary_number(run.summary, "plateau_stress").value_or(0.0);
  const double wanted = room * std::max(peak, plateaus * plateau);
  return wanted > 0.0 ? std::min(wanted, room * std::max(most, 1e-300)) : 1.0;
}

void draw_frame(const results::RunResult& run, std::size_t k, const std::string& title, double tallest_stress,
                const std::filesystem::path& out) {
  const results::Frame frame = results::read_frame(run, k);
  Canvas canvas(out, page_width, page_height);
  const TextStyle title_style{.size = 24.0, .bold = true};
  canvas.text(margin, 44.0, canvas.fit(title, page_width - 2.0 * margin, title_style), title_style);
  canvas.text(margin, 72.0, io::quantity(frame.info.strain, io::Dimension::ratio) + " strain",
              {.size = 18.0, .colour = palette::soft_ink});
  const io::PrintUnit unit = io::unit_for(tallest_stress, io::Dimension::stress);
  const double last = run.history.strain_yy.empty() ? 1.0 : 100.0 * std::max(1e-6, run.history.strain_yy.back());
  Chart chart(canvas, {margin + 70.0, top, middle - margin - 110.0, page_height - top - bottom - 20.0},
              {0.0, last, "strain (%)"}, {0.0, tallest_stress * io::scale_of(unit), "stress (" + unit.name + ")"});
  chart.draw_axes();
  std::vector<double> x, y;
  for (std::size_t row = 0; row < run.history.rows(); ++row) {
    x.push_back(100.0 * run.history.strain_yy[row]);
    y.push_back(run.history.stress_yy[row] * io::scale_of(unit));
  }
  chart.polyline(x, y, palette::grid, 2.0);
  const auto now = static_cast<std::size_t>(
      std::upper_bound(x.begin(), x.end(), 100.0 * frame.info.strain * (1.0 + 1e-12)) - x.begin());
  chart.polyline(std::span(x).first(now), std::span(y).first(now), palette::blue, 2.6);
  chart.vertical(100.0 * frame.info.strain, palette::ink, 1.2);

  const BlockPicture picture = picture_of_frame(frame, run.clipped, run.edges);
  const results::FrameInfo& first = run.frames.front();
  const Box room{middle, top, page_width - margin - middle, page_height - top - bottom};
  const double scale = std::min(room.width / std::max(picture.extent_x(), first.h_xx), room.height / first.h_yy);
  const double width = scale * picture.extent_x(), height = scale * picture.h_yy;
  draw_block(canvas, {room.x + 0.5 * (room.width - width), room.bottom() - height, width, height}, picture);
  draw_scale_bar(canvas, room.right(), room.bottom() + 30.0, scale);
  draw_fragment_key(canvas, middle, page_height - 8.0);
  canvas.write();
}

}  // namespace

std::string movie_frame_name(std::size_t number) {
  return fmt::format("frame-{:04}.png", number);
}

std::size_t draw_movie(const results::RunResult& run, const std::string& title, const std::filesystem::path& folder) {
  if (run.frames.empty())
    throw io::InputError({run.path.string(), 0, ""}, "this run kept no frames", "",
                         "run it with output.frames = \"all\"");
  const double tallest = stress_shown(run);
  for (std::size_t k = 0; k < run.frames.size(); ++k) draw_frame(run, k, title, tallest, folder / movie_frame_name(k));
  return run.frames.size();
}

}  // namespace perfora::report
