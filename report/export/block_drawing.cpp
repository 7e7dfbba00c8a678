// What is here: the sheet of a block put together. What is not: dimensions of lattices and lists of holes as texts
// (hole_list.h), SVG and DXF (drawing.h).
#include "report/export/block_drawing.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <sstream>

#include "geometry/wall.h"
#include "io/text.h"
#include "report/export/hole_list.h"

namespace perfora::report {
namespace {

using Align = Drawing::Align;

constexpr double sheet_mm = 1e3;                 // per metre
constexpr double margin = 10.0, binding = 20.0;  // of ISO 5457: the left one is for filing
constexpr double beside = 34.0, below = 34.0, above = 24.0, gap = 14.0, list_width = 96.0;
constexpr double small = 2.5, large = 3.5;  // text heights of ISO 3098
constexpr double head_length = 2.5, head_width = 0.9;
constexpr double row_height = 4.5, title_row = 6.0, heading = 10.0, large_row = 6.0;
constexpr double words_left = 28.0, words_width = list_width - words_left - 2.0;

constexpr double letter = 0.78;  // mean width of a letter over the height of capitals

double text_width(const std::string& words, double height) {
  return letter * height * static_cast<double>(words.size());
}

/// The text in lines of at most this width, broken between words, and within one that is longer.
std::vector<std::string> wrapped_lines(const std::string& text, double width, double height) {
  std::vector<std::string> lines;
  std::istringstream words(text);
  const auto most = static_cast<std::size_t>(std::max(1.0, width / (letter * height)));
  for (std::string word; words >> word;) {
    while (word.size() > most) {
      const std::string begin(io::beginning(word, most));  // no half of a sign
      if (begin.empty()) break;
      lines.push_back(begin);
      word.erase(0, begin.size());
    }
    if (!lines.empty() && text_width(lines.back() + " " + word, height) <= width)
      lines.back() += " " + word;
    else
      lines.push_back(word);
  }
  return lines;
}

/// A row of the title block.
struct TitleRow {
  std::string name;
  std::vector<std::string> lines;
};

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
    wall_ = geometry::thinnest_wall(sheet.layout);
    make_title_rows();
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
    draw_title_block();
    draw_list();
    return std::move(drawing_);
  }

 private:
  /// Right column, from the bottom up: what stands there, broken into lines.
  void make_title_rows() {
    std::vector<std::pair<std::string, std::string>> rows = {
        {"block", fmt::format("{} x {} mm, holes through it", mm_text(width_, 3), mm_text(height_, 3))},
        {"holes", list_.summary()}};
    if (has_wall())
      rows.emplace_back(
          "thinnest wall",
          fmt::format("t = {} mm, {}", mm_text(sheet_mm * wall_.thickness, 3),
                      wall_.first == wall_.second ? fmt::format("hole {} and its next image", wall_.first + 1)
                                                  : fmt::format("holes {} and {}", wall_.first + 1, wall_.second + 1)));
    if (sheet_.layout.cut_out(true, true).size() > sheet_.layout.perforations.size())
      rows.emplace_back("at the edges", "a hole across an edge goes on at the opposite one");
    rows.insert(rows.end(), sheet_.notes.begin(), sheet_.notes.end());
    for (const auto& [name, words] : rows) title_rows_.push_back({name, wrapped_lines(words, words_width, small)});
    scale_row_ = title_rows_.size();
    title_rows_.push_back({"scale", {}});  // names the sheet once it is chosen
    title_rows_.push_back({"from", wrapped_lines(sheet_.source, words_width, small)});
    title_lines_ = wrapped_lines(sheet_.title, list_width - 4.0, large);
  }

  static double height_of(const TitleRow& row) {
    return title_row + row_height * (std::max<double>(1.0, static_cast<double>(row.lines.size())) - 1.0);
  }

  double title_block_height() const {
    double height = heading + large_row * (std::max<double>(1.0, static_cast<double>(title_lines_.size())) - 1.0);
    for (const TitleRow& row : title_rows_) height += height_of(row);
    return height;
  }

  bool has_wall() const { return wall_.first >= 0 && wall_.thickness > 0.0; }

  /// Holes that a column of the list takes from the top of the sheet down to `bottom`.
  static std::size_t rows_of_list(double top, double bottom) {
    return static_cast<std::size_t>(std::max(0.0, (top - row_height - 2.0 - bottom) / row_height));
  }

  /// Columns of the list on a sheet, the one above the title block first; 0: they would not take all holes.
  std::size_t list_columns(double wide, double high) const {
    const std::size_t holes = sheet_.layout.perforations.size();
    const double room = wide - (binding + beside + width_ + gap + margin);
    const auto most = static_cast<std::size_t>(std::max(0.0, std::floor(room / list_width)));
    const std::size_t first = rows_of_list(high - margin, margin + title_block_height());
    const std::size_t each = rows_of_list(high - margin, margin);
    for (std::size_t columns = 1; columns <= most; ++columns)
      if (first + (columns - 1) * each >= holes) return columns;
    return 0;
  }

  void choose_sheet() {
    constexpr std::array<std::pair<double, double>, 5> sizes = {
        {{297.0, 210.0}, {420.0, 297.0}, {594.0, 420.0}, {841.0, 594.0}, {1189.0, 841.0}}};
    constexpr const char* names[] = {"A4", "A3", "A2", "A1", "A0"};
    const double wide = binding + beside + width_ + gap + list_width + margin;
    const double high = std::max(margin + below + height_ + above + margin,
                                 2.0 * margin + title_block_height() + 2.0 * row_height + 2.0);
    drawing_.width = wide;
    drawing_.height = std::max(high, 210.0);
    size_name_ = "no ISO size";
    // The smallest that takes the block and the whole list; where none takes the list, the smallest for the block.
    for (const bool with_list : {false, true})
      for (std::size_t k = sizes.size(); k-- > 0;)
        for (const bool landscape : {false, true}) {
          const double x = landscape ? sizes[k].first : sizes[k].second,
                       y = landscape ? sizes[k].second : sizes[k].first;
          if (wide > x || high > y) continue;
          const std::size_t columns = list_columns(x, y);
          if (with_list && columns == 0) continue;
          drawing_.width = x;
          drawing_.height = y;
          size_name_ = names[k];
          columns_ = std::max<std::size_t>(1, columns);
        }
    right_ = drawing_.width - margin;
    const double room_x = right_ - static_cast<double>(columns_) * list_width - gap - binding - beside - width_;
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
      // Smaller holes have smaller numbers, as long as a file viewer can show them.
      constexpr double least_number = 0.4, beside_centre = 0.28;
      const double height = std::min(beside_holes_, extent / 3.0);
      if (height < least_number) continue;
      text(Layer::text, {centre.x + beside_centre * height, centre.y - (1.0 + beside_centre) * height}, height,
           Align::left, std::to_string(k + 1));
      if (extent < 2.4 * beside_holes_) continue;
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
    if (!has_wall()) return;
    Point from = on_sheet(wall_.from), to = on_sheet(wall_.to);
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
         "t " + mm_text(sheet_mm * wall_.thickness, 3));
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

  void draw_title_block() {
    const double left = right_ - list_width;
    title_rows_[scale_row_].lines = {"1:1, " + size_name_ + ", dimensions in mm"};
    double y = margin;
    const auto draw_lines = [&](double from_left, const std::vector<std::string>& lines, double height, double step) {
      for (std::size_t k = 0; k < lines.size(); ++k)
        text(Layer::text, {left + from_left, y + 1.8 + step * static_cast<double>(lines.size() - 1 - k)}, height,
             Align::left, lines[k]);
    };
    for (auto row = title_rows_.rbegin(); row != title_rows_.rend(); ++row) {
      draw_lines(words_left, row->lines, small, row_height);
      const double height = height_of(*row);
      text(Layer::text, {left + 2.0, y + 1.8 + height - title_row}, small, Align::left, row->name);
      y += height;
      line(Layer::frame, {left, y}, {right_, y});
    }
    draw_lines(2.0, title_lines_, large, large_row);
    const double top = margin + title_block_height();
    line(Layer::frame, {left, top}, {right_, top});
    line(Layer::frame, {left, margin}, {left, top});
  }

  /// Columns from the right to the left: above the title block first, then over the whole height.
  void draw_list() {
    const std::size_t holes = sheet_.layout.perforations.size();
    const double top = drawing_.height - margin;
    constexpr std::array<double, 4> places = {12.0, 34.0, 56.0, 60.0};
    std::size_t next = 0;
    for (std::size_t column = 0; column < columns_; ++column) {
      const double right = right_ - static_cast<double>(column) * list_width, left = right - list_width;
      const auto row = [&](double y, const std::array<std::string, 4>& words) {
        for (std::size_t k = 0; k < places.size(); ++k)
          text(Layer::text, {left + places[k], y}, small, k < 3 ? Align::right : Align::left, words[k]);
      };
      double y = top - row_height;
      row(y, {"hole", "x", "y", "size"});
      line(Layer::frame, {left, y - 1.2}, {right, y - 1.2});
      std::size_t room = rows_of_list(top, column == 0 ? margin + title_block_height() : margin);
      const bool ends_short = column + 1 == columns_ && next + room < holes;  // a line says so
      if (ends_short && room > 0) --room;
      for (const std::size_t end = std::min(holes, next + room); next < end; ++next) {
        const geometry::Perforation& hole = sheet_.layout.perforations[next];
        y -= row_height;
        row(y, {std::to_string(next + 1), mm_text(sheet_mm * hole.x, 3), mm_text(sheet_mm * hole.y, 3),
                list_.size_text(next)});
      }
      if (ends_short)
        text(Layer::text, {left + 2.0, y - row_height}, small, Align::left,
             fmt::format("{} more: drawn to size, with their centres", holes - next));
    }
  }

  const BlockSheet& sheet_;
  Drawing drawing_;
  double width_, height_;        ///< of the block, mm
  double beside_holes_ = small;  ///< height of the texts in and around the block, mm
  double right_ = 0.0;
  HoleList list_;
  geometry::ThinnestWall wall_;
  std::vector<TitleRow> title_rows_;  ///< the lowest last
  std::vector<std::string> title_lines_;
  std::size_t columns_ = 1, scale_row_ = 0;  ///< of the list; place in title_rows_
  std::string size_name_;
};

}  // namespace

Drawing draw_block_sheet(const BlockSheet& sheet) {
  return Sheet(sheet).made();
}

}  // namespace perfora::report
