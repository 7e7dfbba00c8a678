// What is here: the questions asked of a perforation, handed to its shape, and what follows for a whole layout.
// What is not: plane geometry of a shape (shapes.cpp), the search over pairs (wall.cpp).
#include "geometry/perforation.h"

namespace perfora::geometry {

bool Perforation::contains(double px, double py, double margin) const {
  return std::visit([&](const auto& s) { return s.contains({x, y}, {px, py}, margin); }, shape);
}

double Perforation::segment_depth(double ax, double ay, double bx, double by) const {
  return std::visit([&](const auto& s) { return s.segment_depth({x, y}, {ax, ay}, {bx, by}); }, shape);
}

double Perforation::deepest_dip(double length) const {
  return std::visit([&](const auto& s) { return s.deepest_dip(length); }, shape);
}

Gap Perforation::gap_to(const Perforation& other, double shift_x, double shift_y) const {
  const Point here{x, y}, there{other.x + shift_x, other.y + shift_y};
  return std::visit([&](const auto& a, const auto& b) { return gap_between(a, here, b, there); }, shape, other.shape);
}

double Perforation::signed_gap(const Perforation& other, double shift_x, double shift_y) const {
  return gap_to(other, shift_x, shift_y).length;
}

double Perforation::gap_to_image(double shift_x, double shift_y) const {
  return std::visit([&](const auto& s) { return s.gap_to_image(shift_x, shift_y); }, shape);
}

Bounds Perforation::bounds() const {
  return std::visit([&](const auto& s) { return s.bounds({x, y}); }, shape);
}

double Perforation::area() const {
  return std::visit([](const auto& s) { return s.area(); }, shape);
}

double Perforation::reach() const {
  return std::visit([](const auto& s) { return s.reach(); }, shape);
}

double Perforation::largest_extent() const {
  return std::visit([](const auto& s) { return s.largest_extent(); }, shape);
}

double Perforation::smallest_extent() const {
  return std::visit([](const auto& s) { return s.smallest_extent(); }, shape);
}

double Perforation::level_chord(double offset) const {
  return std::visit([&](const auto& s) { return s.level_chord(offset); }, shape);
}

double Perforation::upright_chord(double offset) const {
  return std::visit([&](const auto& s) { return s.upright_chord(offset); }, shape);
}

double Perforation::shared_area(double distance) const {
  return std::visit([&](const auto& s) { return s.shared_area(distance); }, shape);
}

std::vector<Arc> Perforation::outline(double tolerance) const {
  return std::visit([&](const auto& s) { return s.outline({x, y}, tolerance); }, shape);
}

Perforation Perforation::moved_by(double dx, double dy) const {
  return {x + dx, y + dy, shape};
}

Perforation Perforation::clear_of(std::span<const NearDisc> discs, double reach) const {
  return {x, y, std::visit([&](const auto& s) { return Shape(s.clear_of(discs, reach)); }, shape)};
}

Perforation Perforation::scaled(double factor) const {
  return {factor * x, factor * y, std::visit([&](const auto& s) { return Shape(s.scaled(factor)); }, shape)};
}

PerforationLayout PerforationLayout::scaled(double factor) const {
  PerforationLayout larger{factor * width, factor * height, {}};
  for (const Perforation& hole : perforations) larger.perforations.push_back(hole.scaled(factor));
  return larger;
}

double PerforationLayout::solid_area_fraction() const {
  double area = 0.0;
  for (const Perforation& hole : perforations) area += hole.area();
  return 1.0 - area / (width * height);
}

std::vector<Perforation> PerforationLayout::cut_out(bool cut_x, bool cut_y) const {
  std::vector<Perforation> holes;
  const int images_x = cut_x ? 1 : 0, images_y = cut_y ? 1 : 0;
  for (const Perforation& hole : perforations)
    for (int a = -images_x; a <= images_x; ++a)
      for (int b = -images_y; b <= images_y; ++b) {
        const Perforation image = hole.moved_by(a * width, b * height);
        const Bounds box = image.bounds();
        const bool reaches_x = !cut_x || (box.right > 0.0 && box.left < width);
        const bool reaches_y = !cut_y || (box.top > 0.0 && box.bottom < height);
        if (reaches_x && reaches_y) holes.push_back(image);
      }
  return holes;
}

}  // namespace perfora::geometry
