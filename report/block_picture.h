// What is here: a block drawn disc by disc into a box of the page, and the colours of its discs by fragment or by size.
// What is not: charts, files.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "geometry/packing.h"
#include "geometry/perforation.h"
#include "report/canvas.h"
#include "results/frame.h"
#include "results/run_file.h"

namespace perfora::report {

/// Discs are drawn this much larger, so that the pores of a dense packing (three discs leave a gap of 0.15 radii) do
/// not show as noise.
inline constexpr double bonded_growth = 0.28;

/// Discs in a block with edges (h_xx, 0) and (h_xy, h_yy), m; equally long columns.
struct BlockPicture {
  double h_xx = 0.0, h_xy = 0.0, h_yy = 0.0;
  results::Edges edges;
  double beyond = 0.0;  ///< what is shown to either side of the block, m: where its sides are free
  std::vector<double> x, y, radius;
  std::vector<Colour> colour;
  /// Share by which a disc is drawn larger than it is, to close the pores of the packing (not the perforations); one
  /// number a disc.
  std::vector<double> growth;

  double extent_x() const;  ///< width of the bounding box, m
};

/// The colour of every disc by its fragment: concrete for fragment 0, a colour that no touching fragment has for others
/// of at least `dust` discs, one grey for what is smaller; lost bonds turn a disc dark red.
/// With free sides the picture is wider by what has bulged or flown off, up to half a width on either side.
BlockPicture picture_of_frame(const results::Frame& frame, const geometry::Packing& clipped,
                              const results::Edges& edges = {});
/// Discs by size, light (small) to dark (large).
BlockPicture picture_of_packing(const geometry::Packing& packing);
Colour size_colour(double fraction);  ///< share 0 (smallest) to 1

/// Colour numbers that are no hue.
inline constexpr int main_colour = -1;
inline constexpr int dust_colour = -2;

/// One colour number (0 to colours - 1) a fragment, so that fragments with discs closer than 1.3 times the sum of their
/// radii differ where that is possible; main_colour for fragment 0, dust_colour for crumbs. Cost: linear in the discs.
std::vector<int> colour_fragments(const results::Frame& frame, std::span<const double> radius, int colours);

/// The largest box of the block's shape inside `room`, centred in x and at the given share of the free height (0 top, 1
/// bottom).
Box fit_block(const BlockPicture& picture, const Box& room, double vertical_fraction);
/// Draws the discs (periodic images included, cut at the outline) and the edges: thin lines where the block is
/// periodic, bars for platens and walls, nothing at free sides.
void draw_block(Canvas& canvas, const Box& box, const BlockPicture& picture);
/// What the colours of picture_of_frame say, in one line of text from (x, y) on; some 540 points long.
void draw_fragment_key(Canvas& canvas, double x, double y);
/// A bar of a round length and its text, right aligned at (right, y).
void draw_scale_bar(Canvas& canvas, double right, double y, double pixels_per_metre);
/// Only holes in a slab of concrete: a design that was not packed.
void draw_layout(Canvas& canvas, const Box& box, const geometry::PerforationLayout& layout);
/// The rims of the holes over an undeformed block drawn in `box`.
void draw_perforation_rims(Canvas& canvas, const Box& box, const geometry::PerforationLayout& layout,
                           const Colour& colour);

}  // namespace perfora::report
