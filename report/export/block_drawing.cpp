// What is here: the sheet of a block put together. What is not: dimensions of lattices and lists of holes as texts
// (hole_list.h), SVG and DXF (drawing.h).
#include "report/export/block_drawing.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "geometry/wall.h"
#include "report/export/hole_list.h"

namespace perfora::report {
namespace {

using Align = Drawing::Align;

constexpr double sheet_mm = 1e3;                 // per metre
constexpr double margin = 10.0, binding = 20.0;  // of ISO 5457: the left one is for filing
constexpr double beside = 34.0, below = 34.0, above = 24.0, gap = 14.0, list_width = 96.0;
constexpr double small = 2.5, large = 3.5;  // text heights of ISO 3098
constexpr double head_length = 2.5, head_width = 0.9;
constexpr double row_height = 4.5, title_row = 6.0;

constexpr double letter = 0.78;  // mean width of a letter over the height of capitals

double text_width(const std::string& words, double height) {
  return letter * height * static_cast<double>(words.size());
}

std::string cut_to(const std::string& text, double width, double height) {
  const auto most = static_cast<std::size_t>(width / (letter * height));
  if (text.size() <= most) return text;
  std::size_t end = most > 3 ? most - 3 : 0;
  while (end > 0 && (static_cast<unsigned char>(text[end]) & 0xc0) == 0x80) --end;  // no half of a sign
  return text.substr(0, end) + "...";
}

class Sheet {
 public:
  explicit Sheet(const BlockSheet& sheet)
      : sheet_(sheet),
        width_(sheet_mm * sheet.layout.width),
        height_(sheet_mm * sheet.layout.height),
        list_(sheet.layout) {
    // Dimensions of small blocks would lie across each other: their texts fit between the ends, down to 1 mm.
    constexpr double least = 0.4;
    double fits = 1.0;
    for (const std::vector<Chain>& chains : {list_.chain_x(), list_.chain_y()})
      for (const Chain& chain : chains)
        fits = std::min(fits, sheet_mm * (chain.to - chain.from) / text_width(chain.words, small));
    beside_holes_ = small * std::max(least, fits);
  }

  Drawing made() {
    choose_sheet();
    drawing_.title = sheet_.title;
    draw_frame();
    draw_outline();
    draw_holes();
    draw_pitches();
    draw_wall();
    draw_loading();
    const double bottom = draw_title_block();
    draw_list(bottom);
    return std::move(drawing_);
  }

 private:
  void choose_sheet() {
    constexpr std::array<std::pair<double, double>, 5> sizes = {
        {{297.0, 210.0}, {420.0, 297.0}, {594.0, 420.0}, {841.0, 594.0}, {1189.0, 841.0}}};
    constexpr const char* names[] = {"A4", "A3", "A2", "A1", "A0"};
    const double wide = binding + beside + width_ + gap + list_width + margin;
    const double high = margin + below + height_ + above + margin;
    drawing_.width = wide;
    drawing_.height = std::max(high, 210.0);
    size_name_ = "no ISO size";
    for (std::size_t k = sizes.size(); k-- > 0;) {
      const auto [long_side, short_side] = sizes[k];
      const bool landscape = wide <= long_side && high <= short_side, upright = wide <= short_side && high <= long_side;
      if (!landscape && !upright) continue;
      drawing_.width = landscape ? long_side : short_side;
      drawing_.height = landscape ? short_side : long_side;
      size_name_ = names[k];
    }
    right_ = drawing_.width - margin;
    const double room_x = right_ - list_width - gap - binding - beside - width_;
    const double room_y = drawing_.height - 2.0 * margin - below - above - height_;
    drawing_.origin = {binding + beside + 0.5 * room_x, margin + below + 0.5 * room_y};
  }

  Point on_sheet(Point block) const {
    return {drawing_.origin.x + sheet_mm * block.x, drawing_.origin.y + sheet_mm * block.y};
  }
  /// mm from the lower left corner of the block.
  Point at(double x, double y) const { return {drawing_.origin.x + x, drawing_.origin.y + y}; }
  void line(Layer layer, Point from, Point to) { drawing_.lines.push_back({layer, from, to}); }
  void text(Layer layer, Point place, double height, Align align, const std::string& words, double angle = 0.0) {
    drawing_.texts.push_back({layer, place, height, align, angle, words});
  }
  /// A head with its tip at `tip`, coming from `from`.
  void head(Layer layer, Point from, Point tip, double length = head_length, double breadth = head_width) {
    const double dx = tip.x - from.x, dy = tip.y - from.y, size = std::hypot(dx, dy);
    if (!(size > 0.0)) return;
    const double ux = dx / size, uy = dy / size;
    const Point back{tip.x - length * ux, tip.y - length * uy};
    drawing_.arrows.push_back({layer,
                               tip,
                               {back.x - 0.5 * breadth * uy, back.y + 0.5 * breadth * ux},
                               {back.x + 0.5 * breadth * uy, back.y - 0.5 * breadth * ux}});
  }
  void rectangle(Layer layer, double left, double bottom, double right, double top) {
    line(layer, {left, bottom}, {right, bottom});
    line(layer, {right, bottom}, {right, top});
    line(layer, {right, top}, {left, top});
    line(layer, {left, top}, {left, bottom});
  }

  void draw_frame() { rectangle(Layer::frame, binding, margin, right_, drawing_.height - margin); }

  void draw_outline() {
    drawing_.rims.push_back(
        {Layer::block, {{at(0, 0), 0}, {at(width_, 0), 0}, {at(width_, height_), 0}, {at(0, height_), 0}}});
  }

  void draw_rim(const geometry::Perforation& hole) {
    constexpr double tolerance = 1e-8;  // m
    const std::vector<geometry::Arc> arcs = hole.outline(tolerance);
    if (arcs.size() == 1 && arcs[0].to - arcs[0].from > 1.999 * std::numbers::pi) {
      drawing_.circles.push_back({Layer::holes, on_sheet(arcs[0].centre), 2.0 * sheet_mm * arcs[0].radius});
      return;
    }
    Drawing::Rim rim{Layer::holes, {}};
    const auto add = [&](Point place, double bulge) {
      constexpr double same = 1e-7;  // mm
      if (!rim.corners.empty() &&
          std::hypot(rim.corners.back().at.x - place.x, rim.corners.back().at.y - place.y) < same)
        rim.corners.pop_back();
      rim.corners.push_back({place, bulge});
    };
    for (const geometry::Arc& arc : arcs) {
      const auto end = [&](double angle) {
        return on_sheet({arc.centre.x + arc.radius * std::cos(angle), arc.centre.y + arc.radius * std::sin(angle)});
      };
      const bool turns = arc.radius > 0.0 && arc.to > arc.from;
      add(end(arc.from), turns ? std::tan(0.25 * (arc.to - arc.from)) : 0.0);
      if (turns) add(end(arc.to), 0.0);
    }
    const Point first = rim.corners.front().at, last = rim.corners.back().at;
    if (rim.corners.size() > 1 && rim.corners.back().bulge == 0.0 &&
        std::hypot(first.x - last.x, first.y - last.y) < 1e-7)
      rim.corners.pop_back();
    drawing_.rims.push_back(std::move(rim));
  }

  void draw_holes() {
    for (const geometry::Perforation& hole : sheet_.layout.cut_out(true, true)) draw_rim(hole);
    for (std::size_t k = 0; k < sheet_.layout.perforations.size(); ++k) {
      const geometry::Perforation& hole = sheet_.layout.perforations[k];
      const Point centre = on_sheet({hole.x, hole.y});
      const double extent = sheet_mm * hole.smallest_extent(), arm = std::min(2.0, 0.3 * extent);
      line(Layer::centres, {centre.x - arm, centre.y}, {centre.x + arm, centre.y});
      line(Layer::centres, {centre.x, centre.y - arm}, {centre.x, centre.y + arm});
      const double least_for_number = 2.4 * beside_holes_;
      if (extent < least_for_number) continue;
      text(Layer::text, {centre.x + 0.7, centre.y - 0.7 - beside_holes_}, beside_holes_, Align::left,
           std::to_string(k + 1));
      if (list_.few_sizes() && list_.first_of_its_size(k)) draw_size(hole, list_.size_text(k));
    }
  }

  /// The size across the hole, above its number.
  void draw_size(const geometry::Perforation& hole, const std::string& words) {
    const Point centre = on_sheet({hole.x, hole.y});
    if (text_width(words, beside_holes_) > sheet_mm * 0.8 * hole.smallest_extent()) return;
    text(Layer::dimensions, {centre.x, centre.y + 2.6}, beside_holes_, Align::middle, words);
  }

  /// A dimension between two places along x (or y), its line `offset` mm from the edge, outwards.
  void dimension(bool along_x, double from, double to, double offset, const std::string& words) {
    const auto place = [&](double along, double away) { return along_x ? at(along, -away) : at(-away, along); };
    for (const double end : {from, to}) line(Layer::dimensions, place(end, 1.0), place(end, offset + 1.5));
    line(Layer::dimensions, place(from, offset), place(to, offset));
    // Heads from outside where there is no room for them between the ends.
    const bool outside = to - from < 2.5 * head_length;
    const double tail = outside ? 2.0 * head_length : 0.0;
    if (outside) line(Layer::dimensions, place(from - tail, offset), place(to + tail, offset));
    head(Layer::dimensions, outside ? place(from - tail, offset) : place(to, offset), place(from, offset));
    head(Layer::dimensions, outside ? place(to + tail, offset) : place(from, offset), place(to, offset));
    // Above the line as it is read, which along y is farther out; below it where the next text would be too near.
    const bool narrow = text_width(words, beside_holes_) > to - from;
    const double near = 0.8, beyond = 0.8 + beside_holes_;
    const double away =
        along_x ? (narrow ? offset + beyond : offset - near) : (narrow ? offset - beyond : offset + near);
    text(Layer::dimensions, place(0.5 * (from + to), away), beside_holes_, Align::middle, words, along_x ? 0.0 : 90.0);
  }

  void draw_pitches() {
    constexpr double first = 10.0, second = 19.0;
    for (const bool along_x : {true, false}) {
      const double whole = along_x ? width_ : height_;
      const std::vector<Chain> chains = along_x ? list_.chain_x() : list_.chain_y();
      for (const Chain& chain : chains)
        dimension(along_x, sheet_mm * chain.from, sheet_mm * chain.to, first, chain.words);
      dimension(along_x, 0.0, whole, chains.empty() ? first : second, mm_text(whole, 3));
    }
  }

  void draw_wall() {
    const geometry::ThinnestWall wall = geometry::thinnest_wall(sheet_.layout);
    if (wall.first < 0 || !(wall.thickness > 0.0)) return;
    Point from = on_sheet(wall.from), to = on_sheet(wall.to);
    const double dx = to.x - from.x, dy = to.y - from.y, size = std::hypot(dx, dy);
    const double ux = dx / size, uy = dy / size;
    constexpr double tail = 5.0;
    // Heads point at the wall from inside the holes: it may be thinner than they are long.
    const Point before{from.x - tail * ux, from.y - tail * uy}, behind{to.x + tail * ux, to.y + tail * uy};
    line(Layer::dimensions, before, behind);
    head(Layer::dimensions, before, from);
    head(Layer::dimensions, behind, to);
    text(Layer::dimensions, {0.5 * (from.x + to.x) - 1.2 * uy, 0.5 * (from.y + to.y) + 1.2 * std::abs(ux)},
         beside_holes_, std::abs(ux) > std::abs(uy) ? Align::middle : Align::right,
         "t " + mm_text(sheet_mm * wall.thickness, 3));
    wall_note_ =
        fmt::format("t = {} mm, {}", mm_text(sheet_mm * wall.thickness, 3),
                    wall.first == wall.second ? fmt::format("hole {} and its next image", wall.first + 1)
                                              : fmt::format("holes {} and {}", wall.first + 1, wall.second + 1));
  }

  void draw_loading() {
    constexpr double foot = 2.0, length = 11.0;
    for (const double fraction : {0.2, 0.5, 0.8}) {
      const Point tip = at(fraction * width_, height_ + foot), tail = at(fraction * width_, height_ + foot + length);
      line(Layer::loading, tail, {tip.x, tip.y + 3.0});
      head(Layer::loading, tail, tip, 4.0, 2.4);
    }
    text(Layer::text, at(0.5 * width_, height_ + foot + length + 2.0), large, Align::middle, "direction of loading");
  }

  /// Right column, from the bottom up. Returns where it ends.
  double draw_title_block() {
    const double left = right_ - list_width;
    std::vector<std::pair<std::string, std::string>> rows = sheet_.notes;
    rows.insert(rows.begin(),
                {"block", fmt::format("{} x {} mm, holes through it", mm_text(width_, 3), mm_text(height_, 3))});
    rows.insert(rows.begin() + 1, {"holes", list_.summary()});
    if (sheet_.layout.cut_out(true, true).size() > sheet_.layout.perforations.size())
      rows.insert(rows.begin() + 2, {"at the edges", "a hole across an edge goes on at the opposite one"});
    if (!wall_note_.empty()) rows.insert(rows.begin() + 2, {"thinnest wall", wall_note_});
    rows.emplace_back("scale", "1:1, " + size_name_ + ", dimensions in mm");
    rows.emplace_back("from", sheet_.source);
    double y = margin;
    for (auto row = rows.rbegin(); row != rows.rend(); ++row, y += title_row) {
      text(Layer::text, {left + 2.0, y + 1.8}, small, Align::left, row->first);
      constexpr double words = 28.0;
      text(Layer::text, {left + words, y + 1.8}, small, Align::left,
           cut_to(row->second, list_width - words - 2.0, small));
      line(Layer::frame, {left, y + title_row}, {right_, y + title_row});
    }
    constexpr double heading = 10.0;
    text(Layer::text, {left + 2.0, y + 3.0}, large, Align::left, cut_to(sheet_.title, list_width - 4.0, large));
    line(Layer::frame, {left, y + heading}, {right_, y + heading});
    line(Layer::frame, {left, margin}, {left, y + heading});
    return y + heading;
  }

  void draw_list(double bottom) {
    const double left = right_ - list_width, top = drawing_.height - margin;
    constexpr std::array<double, 4> places = {12.0, 34.0, 56.0, 60.0};
    const auto row = [&](double y, const std::array<std::string, 4>& words) {
      for (std::size_t k = 0; k < places.size(); ++k)
        text(Layer::text, {left + places[k], y}, small, k < 3 ? Align::right : Align::left, words[k]);
    };
    double y = top - row_height;
    row(y, {"hole", "x", "y", "size"});
    line(Layer::frame, {left, y - 1.2}, {right_, y - 1.2});
    const std::size_t holes = sheet_.layout.perforations.size();
    const auto room = static_cast<std::size_t>(std::max(0.0, (y - 2.0 - bottom) / row_height));
    const std::size_t shown = holes <= room ? holes : room > 0 ? room - 1 : 0;
    for (std::size_t k = 0; k < shown; ++k) {
      const geometry::Perforation& hole = sheet_.layout.perforations[k];
      y -= row_height;
      row(y, {std::to_string(k + 1), mm_text(sheet_mm * hole.x, 3), mm_text(sheet_mm * hole.y, 3), list_.size_text(k)});
    }
    if (shown < holes)
      text(Layer::text, {left + 2.0, y - row_height}, small, Align::left,
           fmt::format("{} more: centres are marked, the DXF has them", holes - shown));
  }

  const BlockSheet& sheet_;
  Drawing drawing_;
  double width_, height_;        ///< of the block, mm
  double beside_holes_ = small;  ///< height of the texts in and around the block, mm
  double right_ = 0.0;
  HoleList list_;
  std::string size_name_, wall_note_;
};

}  // namespace

Drawing draw_block_sheet(const BlockSheet& sheet) {
  return Sheet(sheet).made();
}

}  // namespace perfora::report
