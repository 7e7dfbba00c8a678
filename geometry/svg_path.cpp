// What is here: path data of SVG. What is not: the other languages of SVG (svg_text.cpp). Arcs: SVG 1.1, appendix F.6.
#include <numbers>

#include "geometry/svg_text.h"

namespace perfora::geometry {
namespace {

struct EndArc {
  double rx = 0.0, ry = 0.0, angle = 0.0;
  bool large = false, sweep = false;
  Point end;
};

/// From the ends of an arc to its centre, and on into the outline.
void add_arc(DrawnOutline& outline, const EndArc& arc) {
  const Point start = outline.last();
  double rx = std::abs(arc.rx), ry = std::abs(arc.ry);
  if (rx == 0.0 || ry == 0.0 || start == arc.end) return outline.add(arc.end);
  const double c = std::cos(arc.angle), s = std::sin(arc.angle);
  const double dx = 0.5 * (start.x - arc.end.x), dy = 0.5 * (start.y - arc.end.y);
  const double x = c * dx + s * dy, y = -s * dx + c * dy;
  const double reach = x * x / (rx * rx) + y * y / (ry * ry);
  if (reach > 1.0) {  // too small for its ends: grown until it reaches
    rx *= std::sqrt(reach);
    ry *= std::sqrt(reach);
  }
  const double below = rx * rx * y * y + ry * ry * x * x;
  const double root =
      std::sqrt(std::max(0.0, (rx * rx * ry * ry - below) / below)) * (arc.large == arc.sweep ? -1.0 : 1.0);
  const double cx = root * rx * y / ry, cy = -root * ry * x / rx;
  const Point centre{c * cx - s * cy + 0.5 * (start.x + arc.end.x), s * cx + c * cy + 0.5 * (start.y + arc.end.y)};
  const double from = std::atan2((y - cy) / ry, (x - cx) / rx);
  double turn = std::atan2((-y - cy) / ry, (-x - cx) / rx) - from;
  if (arc.sweep && turn < 0.0) turn += 2.0 * std::numbers::pi;
  if (!arc.sweep && turn > 0.0) turn -= 2.0 * std::numbers::pi;
  outline.ellipse(centre, {rx * c, rx * s}, {-ry * s, ry * c}, from, from + turn);
  outline.add(arc.end);
}

/// Goes through the commands of one path.
class PathReader {
 public:
  PathReader(std::string_view data, const Affine& to_metres) : scanner_(data), to_metres_(to_metres) {}

  SvgPath read() {
    char command = '\0';
    while (path_.problem.empty() && !scanner_.at_end()) {
      const char next = scanner_.peek();
      const bool letter = (next >= 'a' && next <= 'z') || (next >= 'A' && next <= 'Z');
      if (letter)
        command = scanner_.sign();
      else if (command == 'M' || command == 'm')
        command = command == 'M' ? 'L' : 'l';
      else if (command == 'Z' || command == 'z' || command == '\0')
        path_.problem = "a number stands where a command is wanted";
      if (path_.problem.empty()) obey(command);
      if (!path_.pieces.empty() && path_.pieces.back().outline.too_long()) path_.problem = "it has too many corners";
    }
    return std::move(path_);
  }

 private:
  double number() {
    const auto value = scanner_.number();
    if (!value && path_.problem.empty()) path_.problem = "a number is missing or broken";
    return value.value_or(0.0);
  }
  bool flag() {
    const auto value = scanner_.flag();
    if (!value && path_.problem.empty()) path_.problem = "a flag of an arc is missing";
    return value.value_or(false);
  }
  Point point(bool relative) {
    const double x = number(), y = number();
    return relative ? Point{now_.x + x, now_.y + y} : Point{x, y};
  }
  DrawnOutline& outline() { return path_.pieces.back().outline; }

  void begin(Point place) {
    path_.pieces.push_back({DrawnOutline(to_metres_), false});
    outline().add(place);
    now_ = begun_ = place;
  }
  void go(Point place) {
    now_ = place;
    control_ = place;
  }

  void obey(char command) {
    const bool relative = command >= 'a';
    const char kind = relative ? static_cast<char>(command - 'a' + 'A') : command;
    if (kind == 'M') {
      const Point place = point(relative);
      if (path_.problem.empty()) begin(place);
      control_ = now_;
    } else if (path_.pieces.empty()) {
      path_.problem = "it does not begin with M";
    } else if (kind == 'Z') {
      path_.pieces.back().closed = true;
      go(begun_);
    } else {
      if (path_.pieces.back().closed) begin(begun_);  // a command behind Z goes on from the start
      draw(kind, relative);
    }
    last_ = kind;
  }

  void draw(char kind, bool relative) {
    switch (kind) {
      case 'L':
        return line_to(point(relative));
      case 'H':
        return line_to({number() + (relative ? now_.x : 0.0), now_.y});
      case 'V':
        return line_to({now_.x, number() + (relative ? now_.y : 0.0)});
      case 'C':
      case 'S': {
        const Point first = kind == 'C' ? point(relative) : mirrored("CS");
        const Point second = point(relative), end = point(relative);
        if (!path_.problem.empty()) return;
        outline().cubic_to(first, second, end);
        now_ = end;
        control_ = second;
        return;
      }
      case 'Q':
      case 'T': {
        const Point control = kind == 'Q' ? point(relative) : mirrored("QT"), end = point(relative);
        if (!path_.problem.empty()) return;
        outline().quadratic_to(control, end);
        now_ = end;
        control_ = control;
        return;
      }
      case 'A': {
        EndArc arc;
        arc.rx = number();
        arc.ry = number();
        arc.angle = number() * std::numbers::pi / 180.0;
        arc.large = flag();
        arc.sweep = flag();
        arc.end = point(relative);
        if (!path_.problem.empty()) return;
        add_arc(outline(), arc);
        return go(arc.end);
      }
      default:
        path_.problem = std::string("there is no command ") + kind;
    }
  }

  void line_to(Point place) {
    if (!path_.problem.empty()) return;
    outline().add(place);
    go(place);
  }
  /// The last control point on the other side of here, after a command of the same family; else here.
  Point mirrored(std::string_view family) const {
    if (family.find(last_) == std::string_view::npos) return now_;
    return {2.0 * now_.x - control_.x, 2.0 * now_.y - control_.y};
  }

  SvgScanner scanner_;
  Affine to_metres_;
  SvgPath path_;
  Point now_, begun_, control_;
  char last_ = '\0';
};

}  // namespace

SvgPath svg_path(std::string_view data, const Affine& to_metres) {
  return PathReader(data, to_metres).read();
}

}  // namespace perfora::geometry
