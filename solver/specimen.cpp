// What is here: the block placed in a larger periodic cell when it has edges, with its walls and what the cut takes.
#include "solver/specimen.h"

#include <algorithm>
#include <cmath>

namespace perfora::solver {
namespace {

/// Vacuum beyond walls at the end of a run, in largest discs beside r_H: a pair across it is neither bonded nor listed
/// as near (listed up to 1.4 diameters), and half of it is more than a disc can sink into a wall.
constexpr double clear_discs = 4.0;

/// One direction of the cell.
struct Span {
  double cell = 0.0;    ///< length of the cell, m
  double offset = 0.0;  ///< of the block in it, m
};

Span embedded(double block, double between_walls, double vacuum) {
  const double cell = between_walls + vacuum;
  return {cell, 0.5 * (cell - block)};
}

void add_walls(std::vector<WallPlace>& walls, WallSide low, WallSide high, double vacuum_fraction, double friction,
               bool edge) {
  const double half = 0.5 * vacuum_fraction;
  walls.push_back({low, half, half, friction, edge, {}});
  walls.push_back({high, 1.0 - half, half, friction, edge, {}});
}

/// One residual face stiffness a disc for the bonds of the periodic block that cross the edge of the wall.
void add_face_stiffness(WallPlace& wall, const geometry::Packing& clipped, const BondNetwork& periodic,
                        const MaterialOptions& material) {
  const bool vertical = wall.side == WallSide::bottom || wall.side == WallSide::top;
  const bool low = wall.side == WallSide::bottom || wall.side == WallSide::left;
  const std::vector<double>& place = vertical ? clipped.y : clipped.x;
  const double length = vertical ? clipped.height : clipped.width;
  std::vector<double> normal(place.size(), 0.0), tangential(place.size(), 0.0);
  for (std::size_t b = 0; b < periodic.i.size(); ++b) {
    const double nx = periodic.direction_x[b], ny = periodic.direction_y[b];
    const double along = vertical ? ny : nx, beside = vertical ? nx : ny;
    const auto i = static_cast<std::size_t>(periodic.i[b]), j = static_cast<std::size_t>(periodic.j[b]);
    const double end = place[i] + along * periodic.reference_length[b];
    if (end >= 0.0 && end < length) continue;
    const std::size_t disc = (end < 0.0) == low ? i : j;  // the end on this wall's side of the block
    normal[disc] += material.normal_stiffness * along * along + material.tangential_stiffness * beside * beside;
    tangential[disc] += material.normal_stiffness * beside * beside + material.tangential_stiffness * along * along;
  }
  for (std::size_t d = 0; d < place.size(); ++d)
    if (normal[d] > 0.0) wall.face_stiffness.push_back({static_cast<std::int32_t>(d), normal[d], tangential[d]});
}

}  // namespace

std::pair<double, double> BlockFrame::position(std::uint64_t sx, std::uint64_t sy, const CellMatrix& cell) const {
  const auto whole = [](std::uint64_t s) { return static_cast<double>(s >> 11) * 0x1p-53; };
  const auto near_middle = [](std::uint64_t s, double origin, double fraction) {
    return reduced(s - fixed_point(origin + 0.5 * fraction)) + 0.5 * fraction;
  };
  const double y_fraction = open_y ? near_middle(sy, origin_y, fraction_y) : whole(sy);
  const double x_fraction = open_x ? near_middle(sx, origin_x, fraction_x) : whole(sx);
  double x = cell.xx * x_fraction + cell.xy * y_fraction;
  if (!open_x) x -= cell.xx * std::floor(x / cell.xx);
  return {x, cell.yy * y_fraction};
}

Specimen make_specimen(const geometry::Packing& clipped, const geometry::PerforationLayout& layout,
                       const BoundaryOptions& boundary, const MaterialOptions& material, double mean_diameter) {
  Specimen s;
  s.packing = clipped;
  s.layout = layout;
  s.cell = {layout.width, 0.0, layout.height};
  s.block.open_x = boundary.sides != Sides::periodic;
  s.block.open_y = boundary.top_bottom == TopBottom::platens;
  if (!s.block.open_x && !s.block.open_y) return s;

  double largest_radius = 0.0;
  for (const double radius : clipped.radius) largest_radius = std::max(largest_radius, radius);
  const double clear = clear_discs * 2.0 * largest_radius + material.horizon * mean_diameter;
  Span x{layout.width, 0.0}, y{layout.height, 0.0};
  if (s.block.open_y) {
    // The vacuum shrinks with the cell, and a resumed run may be asked to go farther: made for the largest strain.
    const double vacuum = clear / (1.0 - largest_run_strain);
    y = embedded(layout.height, layout.height, vacuum);
    add_walls(s.walls, WallSide::bottom, WallSide::top, vacuum / y.cell, boundary.platen_friction, true);
  }
  if (s.block.open_x) {
    const bool free = boundary.sides == Sides::free;
    x = embedded(layout.width, free ? catch_widths * layout.width : layout.width, clear);
    add_walls(s.walls, WallSide::left, WallSide::right, clear / x.cell, free ? 0.0 : boundary.wall_friction, !free);
  }
  const BondNetwork periodic = make_bond_network(clipped, layout, material, {}, 1, mean_diameter);
  for (WallPlace& wall : s.walls)
    if (wall.edge) add_face_stiffness(wall, clipped, periodic, material);
  s.cell = {x.cell, 0.0, y.cell};
  s.block.origin_x = x.offset / x.cell;
  s.block.origin_y = y.offset / y.cell;
  s.block.fraction_x = layout.width / x.cell;
  s.block.fraction_y = layout.height / y.cell;
  s.field = {layout.width, layout.height, x.offset, y.offset};
  s.layout = {x.cell, y.cell, layout.cut_out(s.block.open_x, s.block.open_y)};
  for (geometry::Perforation& hole : s.layout.perforations) hole = hole.moved_by(x.offset, y.offset);
  s.packing.width = x.cell;
  s.packing.height = y.cell;
  for (double& place : s.packing.x) place += x.offset;
  for (double& place : s.packing.y) place += y.offset;
  return s;
}

}  // namespace perfora::solver
