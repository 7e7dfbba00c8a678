// What is here: where the block sits in the periodic cell: the cell itself, or, with platens, walls or free sides, the
// middle of a larger cell with vacuum around it. What is not: forces of walls (walls.h).
#pragma once

#include <utility>
#include <vector>

#include "geometry/packing.h"
#include "geometry/perforation.h"
#include "solver/bond_network.h"
#include "solver/cell.h"
#include "solver/options.h"
#include "solver/state.h"

namespace perfora::solver {

/// The block in reduced coordinates of the cell; affine motion keeps it there. By default the block is the cell.
struct BlockFrame {
  double origin_x = 0.0, origin_y = 0.0;      ///< lower left corner
  double fraction_x = 1.0, fraction_y = 1.0;  ///< width and height over the cell's
  bool open_x = false, open_y = false;        ///< beyond the edges there is vacuum, no periodic image

  /// Edges of the block as it is now, m: the cell's, or the nominal rectangle between the platens and sides.
  CellMatrix edges(const CellMatrix& cell) const {
    return {cell.xx * fraction_x, cell.xy * fraction_y, cell.yy * fraction_y};
  }
  /// Place in m from the block's lower left corner; wrapped into the cell where the block is periodic, as near to the
  /// middle as an image can be where it is not.
  std::pair<double, double> position(std::uint64_t sx, std::uint64_t sy, const CellMatrix& cell) const;
};

enum class WallSide { bottom, top, left, right };

/// Residual face stiffness: a disc near a cut edge is held by the wall with the stiffness of the bonds it lost.
struct FaceStiffness {
  std::int32_t disc = 0;
  double normal_stiffness = 0.0;      ///< sum over its cut bonds of k_n n_a^2 + k_t n_b^2, a across the edge, N/m
  double tangential_stiffness = 0.0;  ///< of k_n n_b^2 + k_t n_a^2, N/m
};

/// A rigid wall at a fixed reduced coordinate: the affine motion carries it along.
struct WallPlace {
  WallSide side = WallSide::bottom;
  double reduced = 0.0;   ///< y of bottom and top, x of left and right
  double behind = 0.0;    ///< reduced depth behind it that still counts as its own: half the vacuum
  double friction = 0.0;  ///< mu
  bool edge = true;       ///< at an edge of the block; else it stands apart and only catches what flies off
  std::vector<FaceStiffness> face_stiffness;  ///< at an edge: by rising disc
};

/// What a compression starts from. Periodic edges: packing and layout as they were given.
struct Specimen {
  geometry::Packing packing;           ///< in the cell, m
  geometry::PerforationLayout layout;  ///< the holes and the parts of their images that cut into the block
  CellMatrix cell;                     ///< at the start
  BlockFrame block;
  std::vector<WallPlace> walls;  ///< in pairs: bottom and top, left and right
  FieldFrame field;              ///< what finds the strength field of the periodic block again
};

/// Puts the clipped packing of a periodic rectangle into a cell with the edges that `boundary` asks for. Bonds across a
/// cut edge are gone by themselves: their ends are far apart.
Specimen make_specimen(const geometry::Packing& clipped, const geometry::PerforationLayout& layout,
                       const BoundaryOptions& boundary, const MaterialOptions& material, double mean_diameter);

/// Free sides: discs that fly off are caught by frictionless walls this many block widths apart.
inline constexpr double catch_widths = 4.0;

}  // namespace perfora::solver
