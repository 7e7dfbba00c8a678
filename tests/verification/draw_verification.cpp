// What is here: the pictures of docs/developer/verification.md, from the tables the checks wrote, and the program
// around them.
#include "tests/verification/draw_verification.h"

#include <algorithm>
#include <cstdio>
#include <exception>
#include <fstream>
#include <sstream>
#include <stdexcept>
#include <string>
#include <vector>

#include "report/canvas.h"
#include "report/chart.h"

namespace perfora::verification {
namespace {

using namespace report;

/// Columns of a table that write_table() wrote.
std::vector<std::vector<double>> columns_of(const std::filesystem::path& file) {
  std::ifstream in(file);
  if (!in) throw std::runtime_error("cannot read " + file.string());
  std::string line;
  std::getline(in, line);
  std::vector<std::vector<double>> columns(1 + static_cast<std::size_t>(std::count(line.begin(), line.end(), ',')));
  while (std::getline(in, line)) {
    std::istringstream cells(line);
    std::string cell;
    for (auto& column : columns)
      if (std::getline(cells, cell, ',')) column.push_back(std::stod(cell));
  }
  return columns;
}

enum class Style { line, dashes, points };

struct Curve {
  std::vector<double> x, y;
  std::string name;
  Colour colour;
  Style style = Style::line;
};

void draw_curve(Canvas& canvas, Chart& chart, const Curve& curve) {
  if (curve.style == Style::line) chart.polyline(curve.x, curve.y, curve.colour, 2.4);
  if (curve.style == Style::dashes)
    for (std::size_t k = 0; k + 1 < curve.x.size(); ++k)
      canvas.line(chart.px(curve.x[k]), chart.py(curve.y[k]), chart.px(curve.x[k + 1]), chart.py(curve.y[k + 1]),
                  curve.colour, 1.8, {7.0, 5.0});
  if (curve.style == Style::points)
    for (std::size_t k = 0; k < curve.x.size(); ++k)
      canvas.disc(chart.px(curve.x[k]), chart.py(curve.y[k]), 5.0, curve.colour, palette::paper);
}

constexpr double page_width = 1300.0, page_height = 520.0;

/// Half a page: title, chart, key in a corner of the chart.
void panel(Canvas& canvas, int half, const std::string& title, const Axis& x, const Axis& y,
           const std::vector<Curve>& curves, bool key_at_the_top = true) {
  const Box box{95.0 + half * 0.5 * page_width, 60.0, 0.5 * page_width - 130.0, page_height - 150.0};
  Chart chart(canvas, box, x, y);
  chart.draw_axes();
  canvas.text(box.x, 36.0, title, {.size = 19.0, .bold = true});
  for (const Curve& curve : curves) draw_curve(canvas, chart, curve);
  constexpr double line_height = 25.0;
  double at = key_at_the_top ? box.y + 26.0 : box.bottom() - 16.0 - line_height * (double(curves.size()) - 1.0);
  for (const Curve& curve : curves) {
    const double right = box.right() - 14.0;
    const double left = right - canvas.text_width(curve.name, {.size = 15.0}) - 46.0;
    if (curve.style == Style::points)
      canvas.disc(left + 18.0, at - 5.0, 5.0, curve.colour, palette::paper);
    else
      canvas.line(left, at - 5.0, left + 36.0, at - 5.0, curve.colour, 2.4,
                  curve.style == Style::dashes ? std::vector<double>{7.0, 5.0} : std::vector<double>{});
    canvas.text(right, at, curve.name, {.size = 15.0, .align = Align::right, .halo = true});
    at += line_height;
  }
}

void draw_contacts(const std::filesystem::path& data, const std::filesystem::path& picture) {
  Canvas canvas(picture, page_width, page_height);
  const auto e = columns_of(data / "restitution.csv"), roll = columns_of(data / "rolling.csv"),
             closed = columns_of(data / "restitution_closed.csv");
  panel(canvas, 0, "Two discs that collide", {0.0, 1.0, "viscous_rate", false}, {0.0, 1.0, "restitution", false},
        {{closed[0], closed[1], "closed form", palette::soft_ink, Style::line},
         {e[0], e[1], "measured", palette::blue, Style::points}});
  panel(canvas, 1, "A disc that slides, spins up and rolls", {0.0, 1.5, "time over the time of slipping", false},
        {0.0, 1.05, "over the first speed", false},
        {{roll[0], roll[1], "speed", palette::blue, Style::line},
         {roll[0], roll[2], "spin times radius", palette::vermilion, Style::line},
         {{0.0, 1.5}, {2.0 / 3.0, 2.0 / 3.0}, "two thirds", palette::soft_ink, Style::dashes}},
        false);
  canvas.write();
}

Curve level(double value, const std::string& name, const Colour& colour) {
  return {{0.0, 0.35}, {value, value}, name, colour, Style::dashes};
}

void draw_holes(const std::filesystem::path& data, const std::filesystem::path& picture) {
  Canvas canvas(picture, page_width, page_height);
  const auto square = columns_of(data / "holes_square.csv"), staggered = columns_of(data / "holes_staggered.csv"),
             edge = columns_of(data / "hole_edge.csv");
  panel(canvas, 0, "Sheets with holes: Young's modulus", {0.0, 0.35, "r_H/T", false},
        {0.4, 0.85, "E over that of the solid", false},
        {level(square[3][0], "square array, along the pitch: Slot", palette::blue),
         {square[0], square[1], "discs, square cell", palette::blue, Style::points},
         {staggered[0], staggered[2], "discs, staggered cell, at 45 degrees", palette::green, Style::points},
         level(square[4][0], "square array, at 45 degrees: Slot", palette::vermilion),
         {square[0], square[2], "discs, square cell, at 45 degrees", palette::purple, Style::points},
         {staggered[0], staggered[1], "discs, staggered cell", palette::vermilion, Style::points}});
  panel(canvas, 1, "Stress beside a hole", {1.0, 2.25, "distance from the centre over R", false},
        {1.0, 2.4, "stress over the mean stress", false},
        {{edge[0], edge[2], "continuum, periodic cell", palette::soft_ink, Style::line},
         {edge[0], edge[3], "Kirsch, lone hole", palette::green, Style::dashes},
         {edge[0], edge[1], "discs", palette::blue, Style::points}});
  canvas.write();
}

}  // namespace

void draw_pictures(const std::filesystem::path& docs) {
  const auto data = docs / "data" / "verification";
  draw_contacts(data, docs / "images" / "verification-contacts.png");
  draw_holes(data, docs / "images" / "verification-holes.png");
}

}  // namespace perfora::verification

int main(int count, char** arguments) {
  if (count != 2) {
    std::fprintf(stderr, "use: draw_verification DOCS\n");
    return 1;
  }
  try {
    perfora::verification::insert_checks(arguments[1]);
    perfora::verification::draw_pictures(arguments[1]);
  } catch (const std::exception& error) {
    std::fprintf(stderr, "draw_verification: %s\n", error.what());
    return 1;
  }
  return 0;
}
