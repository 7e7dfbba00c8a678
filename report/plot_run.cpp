// What is here: the picture of one run. What is not: the parts it is put together from (curve_panel.h,
// block_picture.h).
#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "io/text.h"
#include "report/block_picture.h"
#include "report/canvas.h"
#include "report/curve_panel.h"
#include "report/measured_curves.h"
#include "report/plot.h"
#include "report/verdict_line.h"
#include "results/frame.h"
#include "results/run_file.h"
#include "results/summary_numbers.h"

namespace perfora::report {
namespace {

constexpr double page_width = 1600.0;
constexpr double page_height = 1000.0;
constexpr double left_margin = 120.0;
constexpr double right_margin = 44.0;
constexpr double middle = 850.0;  ///< where the blocks begin
constexpr double caption_height = 36.0;
constexpr double scale_height = 30.0;

std::string describe_edges(const results::Edges& edges) {
  if (edges.walls) return edges.platens ? " between platens and side walls" : " between side walls";
  if (edges.free) return edges.platens ? " between platens, free sides" : " with free sides";
  return edges.platens ? " between platens" : "";
}

std::string describe_block(const results::RunResult& run) {
  const std::size_t holes = run.layout.perforations.size();
  return fmt::format("{} block{}, {} hole{}, {} discs of {} mean diameter, {} bonds",
                     io::quantities({run.width, run.height}, io::Dimension::length, " x "), describe_edges(run.edges),
                     holes, holes == 1 ? "" : "s", io::count(run.clipped.size()),
                     io::quantity(run.mean_diameter, io::Dimension::length), io::count(run.bonds.size()));
}

std::string describe_damage(const results::RunResult& run) {
  std::string text;
  if (const auto broken = results::summary_number(run.summary, "broken_bonds"))
    text += io::count(*broken) + " bonds broken";
  if (const auto fragments = results::summary_number(run.summary, "fragments"))
    text += fmt::format("{}{} fragments", text.empty() ? "" : ", ", io::count(*fragments));
  return text;
}

CurveMarks marks_of(const results::RunResult& run, const PlotOptions& options) {
  CurveMarks marks;
  marks.peak_strain = results::summary_number(run.summary, "first_peak_strain");
  marks.peak_stress = results::summary_number(run.summary, "first_peak_stress");
  marks.plateau_stress = results::summary_number(run.summary, "plateau_stress");
  if (const auto window = results::plateau_window(run.summary)) {
    marks.plateau_start = window->first;
    marks.plateau_end = window->second;
  }
  marks.densification_strain = results::summary_number(run.summary, "densification_strain");
  marks.target_stress = options.target_stress;
  if (const auto verdict = run.summary.find("verdict"); verdict != run.summary.end() && verdict->is_object()) {
    marks.caps = results::stress_caps_from_json(verdict->value("caps", nlohmann::json::array()));
    for (const nlohmann::json& wish : verdict->value("wishes", nlohmann::json::array()))
      if (wish.value("measure", "") == "plateau_stress" && wish.at("low").is_number() && wish.at("high").is_number()) {
        const double low = wish.at("low").get<double>(), high = wish.at("high").get<double>();
        marks.target_stress = 0.5 * (low + high);
        marks.target_tolerance = 0.5 * (high - low);
      }
  }
  marks.measured = options.measured;
  return marks;
}

void draw_heading(Canvas& canvas, const results::RunResult& run, const PlotOptions& options) {
  const std::string title = options.title.empty() ? results::title_of(run.provenance, run.path) : options.title;
  const TextStyle title_style{.size = 30.0, .bold = true};
  const TextStyle line_style{.size = 17.0, .colour = palette::soft_ink};
  canvas.text(44.0, 56.0, canvas.fit(title, middle + 300.0, title_style), title_style);
  const std::string damage = describe_damage(run);
  canvas.text(44.0, 88.0,
              canvas.fit(describe_block(run) + (damage.empty() ? "" : "; " + damage), page_width - 88.0, line_style),
              line_style);
  draw_verdict(canvas, 44.0, 117.0, page_width - 88.0, run.summary);
  draw_measured_key(canvas, left_margin, page_height - 12.0, middle, options.measured);
  if (run.status != "completed" && !run.status.empty())
    canvas.text(page_width - right_margin, 56.0,
                canvas.fit(run.status + ": " + run.reason, 420.0, {.size = 18.0, .bold = true}),
                {.size = 18.0, .colour = palette::vermilion, .bold = true, .align = Align::right});
}

/// Where the snapshots stand on the curve: lettered badges over the upper edge, moved apart where they would overlap.
void draw_badges(Canvas& canvas, const Chart& chart, const std::vector<RunPicture::Snapshot>& snapshots) {
  constexpr double spacing = 27.0;
  double last = -1e9;
  const double y = chart.box().y - 18.0;
  for (std::size_t k = 0; k < snapshots.size(); ++k) {
    const double exact = chart.px(snapshots[k].frame.info.strain * 100.0);
    const double x = std::max(exact, last + spacing);
    last = x;
    canvas.line(exact, chart.box().y, exact, chart.box().y + 8.0, palette::ink, 1.6);
    canvas.line(exact, chart.box().y, x, y + 11.0, palette::ink, 1.2);
    canvas.badge(x, y, std::string(1, static_cast<char>('A' + k)));
  }
}

void draw_snapshot(Canvas& canvas, const results::RunResult& run, const RunPicture::Snapshot& snapshot, char letter,
                   const Box& room) {
  const BlockPicture picture = picture_of_frame(snapshot.frame, run.clipped, run.edges);
  const Box box = fit_block(
      picture, {room.x, room.y + caption_height, room.width, room.height - caption_height - scale_height}, 0.0);
  canvas.badge(box.x + 11.5, box.y - 18.0, std::string(1, letter));
  canvas.text(box.x + 32.0, box.y - 12.0, snapshot.caption, {.size = 17.0});
  draw_block(canvas, box, picture);
  draw_scale_bar(canvas, box.right(), box.bottom() + 22.0, box.width / picture.extent_x());
}

/// Area of the page that the snapshots' blocks fill in these rooms.
double area_of_blocks(const RunPicture& picture, const std::vector<Box>& rooms) {
  double area = 0.0;
  for (std::size_t k = 0; k < rooms.size(); ++k) {
    const results::FrameInfo& info = picture.snapshots[k].frame.info;
    const double height = rooms[k].height - caption_height - scale_height;
    if (height <= 0.0) return 0.0;
    const double scale = std::min(rooms[k].width / info.h_xx, height / info.h_yy);
    area += scale * scale * info.h_xx * info.h_yy;
  }
  return area;
}

/// Where two or more snapshots stand: one over the other (wide blocks), side by side (tall ones), or of three two above
/// the last; whichever shows them largest.
std::vector<Box> snapshot_rooms(const RunPicture& picture, const Box& whole, double gap) {
  const auto count = static_cast<double>(picture.snapshots.size());
  std::vector<Box> stacked, beside, two_above;
  const double row = (whole.height - (count - 1.0) * gap) / count, column = (whole.width - (count - 1.0) * gap) / count;
  for (std::size_t k = 0; k < picture.snapshots.size(); ++k) {
    const auto place = static_cast<double>(k);
    stacked.push_back({whole.x, whole.y + place * (row + gap), whole.width, row});
    beside.push_back({whole.x + place * (column + gap), whole.y, column, whole.height});
  }
  if (picture.snapshots.size() == 3) {
    const results::RunResult& run = *picture.run;
    const double half = (whole.width - gap) / 2.0;
    const double upper = std::min(caption_height + half * run.height / run.width + scale_height, 0.6 * whole.height);
    two_above = {{whole.x, whole.y, half, upper},
                 {whole.x + half + gap, whole.y, half, upper},
                 {whole.x, whole.y + upper + gap, whole.width, whole.height - upper - gap}};
  }
  std::vector<Box> best = stacked;
  for (const std::vector<Box>& other : {beside, two_above})
    if (area_of_blocks(picture, other) > area_of_blocks(picture, best)) best = other;
  return best;
}

constexpr Box snapshots_box{middle, 138.0, page_width - right_margin - middle, page_height - 138.0 - 50.0};
constexpr double snapshot_gap = 26.0;

/// How many undeformed blocks of this run find room over each other in the whole width: three at least.
std::size_t most_snapshots(const results::RunResult& run) {
  const double room = caption_height + snapshots_box.width * run.height / run.width + scale_height + snapshot_gap;
  return std::max<std::size_t>(3, static_cast<std::size_t>((snapshots_box.height + snapshot_gap) / room));
}

void draw_snapshots(Canvas& canvas, const RunPicture& picture) {
  const std::size_t count = picture.snapshots.size();
  if (count == 0) {
    canvas.text(middle + snapshots_box.width / 2.0, page_height / 2.0,
                "no frames in this file (output.frames = \"none\")",
                {.size = 18.0, .colour = palette::soft_ink, .align = Align::centre});
    return;
  }
  const results::RunResult& run = *picture.run;
  if (count == 1) return draw_snapshot(canvas, run, picture.snapshots[0], 'A', snapshots_box);
  const std::vector<Box> rooms = snapshot_rooms(picture, snapshots_box, snapshot_gap);
  for (std::size_t k = 0; k < count; ++k)
    draw_snapshot(canvas, run, picture.snapshots[k], static_cast<char>('A' + k), rooms[k]);
}

std::string caption_of(const results::FrameInfo& info, const char* what) {
  const std::string strain = io::quantity(info.strain, io::Dimension::ratio) + " strain";
  return what[0] == '\0' ? strain : fmt::format("{}, {}", what, strain);
}

}  // namespace

std::vector<std::size_t> snapshot_frames(const results::RunResult& run, std::size_t most) {
  if (run.frames.empty()) return {};
  const auto add_nearest = [&](std::vector<std::size_t>& chosen, double strain) {
    const auto nearest = std::min_element(run.frames.begin(), run.frames.end(), [&](const auto& a, const auto& b) {
      return std::abs(a.strain - strain) < std::abs(b.strain - strain);
    });
    chosen.push_back(static_cast<std::size_t>(nearest - run.frames.begin()));
  };
  std::vector<std::size_t> chosen = {0};
  if (const auto peak = results::summary_number(run.summary, "first_peak_strain")) add_nearest(chosen, *peak);
  chosen.push_back(run.frames.size() - 1);
  chosen.erase(std::unique(chosen.begin(), chosen.end()), chosen.end());
  const std::size_t free = most - std::min(most, chosen.size());
  for (std::size_t k = 1; k <= free; ++k)
    add_nearest(chosen, run.frames.back().strain * static_cast<double>(k) / static_cast<double>(free + 1));
  std::sort(chosen.begin(), chosen.end());
  chosen.erase(std::unique(chosen.begin(), chosen.end()), chosen.end());
  return chosen;
}

void draw_run(const RunPicture& picture, const std::filesystem::path& out, const PlotOptions& options) {
  Canvas canvas(out, page_width, page_height);
  const results::RunResult& run = *picture.run;
  draw_heading(canvas, run, options);
  const Chart chart =
      draw_curve_panel(canvas, {left_margin, 176.0, middle - left_margin - 50.0, page_height - 176.0 - 78.0},
                       {{run.history.strain_yy, run.history.stress_yy}}, marks_of(run, options));
  draw_badges(canvas, chart, picture.snapshots);
  draw_snapshots(canvas, picture);
  if (!picture.snapshots.empty()) draw_fragment_key(canvas, middle, page_height - 26.0);
  canvas.write();
}

void plot_run(const std::filesystem::path& run_file, const std::filesystem::path& out, const PlotOptions& options) {
  const results::RunResult run = results::read_run(run_file);
  RunPicture picture{&run, {}};
  const auto peak = results::summary_number(run.summary, "first_peak_strain");
  const std::vector<std::size_t> chosen = snapshot_frames(run, most_snapshots(run)), fewest = snapshot_frames(run);
  for (std::size_t k = 0; k < chosen.size(); ++k) {
    const results::FrameInfo& info = run.frames[chosen[k]];
    const bool at_peak = peak && fewest.size() == 3 && chosen[k] == fewest[1];
    const char* what = info.strain < 1e-6            ? "intact"
                       : at_peak                     ? "near the first peak"
                       : chosen[k] == fewest.back()  ? "last"
                       : chosen[k] == fewest.front() ? "first"
                                                     : "";
    picture.snapshots.push_back({caption_of(info, what), results::read_frame(run, chosen[k])});
  }
  draw_run(picture, out, options);
}

}  // namespace perfora::report
