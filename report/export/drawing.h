// What is here: a drawing as plain lines, rims and texts in millimetres, and its two forms, SVG and DXF. What is not:
// what is drawn of a block (block_drawing.h).
#pragma once

#include <string>
#include <vector>

#include "geometry/plane.h"

namespace perfora::report {

using geometry::Point;

/// What a line or text belongs to: a layer in DXF, a group of that id in SVG. Their names are those that
/// geometry/drawn_holes.h looks for.
enum class Layer { block, holes, centres, dimensions, loading, text, frame };
inline constexpr Layer all_layers[] = {Layer::frame,      Layer::block,   Layer::holes, Layer::centres,
                                       Layer::dimensions, Layer::loading, Layer::text};
const char* layer_name(Layer layer);

/// A corner of a rim and the arc from it to the next one: tan of a quarter of its angle, anticlockwise positive; 0: a
/// straight line.
struct RimCorner {
  Point at;
  double bulge = 0.0;
};

/// mm on the sheet, y upwards, (0, 0) at the lower left of the sheet; text angles in degrees, anticlockwise.
struct Drawing {
  struct Line {
    Layer layer;
    Point from, to;
  };
  struct Circle {
    Layer layer;
    Point centre;
    double diameter;
  };
  struct Rim {  ///< closed
    Layer layer;
    std::vector<RimCorner> corners;
  };
  struct Arrow {  ///< a filled head
    Layer layer;
    Point tip, left, right;
  };
  enum class Align { left, middle, right };
  struct Text {
    Layer layer;
    Point at;  ///< on the base line
    double height;
    Align align;
    double angle;
    std::string text;  ///< UTF-8
  };

  std::string title;
  double width = 0.0, height = 0.0;  ///< of the sheet
  Point origin;                      ///< of the block, its lower left corner, on the sheet
  std::vector<Line> lines;
  std::vector<Circle> circles;
  std::vector<Rim> rims;
  std::vector<Arrow> arrows;
  std::vector<Text> texts;
};

/// SVG 1.1 whose user unit is 1 mm and which prints true to scale. Block and holes stand in groups in the block's own
/// coordinates: mm from its lower left corner, y upwards.
std::string as_svg(const Drawing& drawing);
/// ASCII DXF of AutoCAD R12, which every program reads: mm from the lower left corner of the block, y upwards.
std::string as_dxf(const Drawing& drawing);

/// "12.5": mm with at most `digits` places, without zeros at its end.
std::string mm_text(double value, int digits);

}  // namespace perfora::report
