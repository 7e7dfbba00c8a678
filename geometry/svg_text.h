// What is here: the small languages in attributes of SVG: numbers, lengths, transforms, path data. What is not: the
// elements (drawn_svg.cpp). Source: SVG 1.1, chapters 4, 7, 8.
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "geometry/drawn_outline.h"

namespace perfora::geometry {

/// Reads numbers and signs from the front of a text, with blanks and commas between them as SVG allows.
class SvgScanner {
 public:
  explicit SvgScanner(std::string_view text) : rest_(text) {}
  bool at_end();
  /// A finite number; nothing where there is none.
  std::optional<double> number();
  /// "0" or "1", which may stand without a blank behind it.
  std::optional<bool> flag();
  /// The next sign that is no blank or comma.
  char sign();
  /// Letters from here on.
  std::string_view word();
  char peek();

 private:
  void skip();
  std::string_view rest_;
};

/// A length: its number and unit ("mm", "px", "" ...). Nothing where the text is none.
struct SvgLength {
  double value = 0.0;
  std::string unit;
  /// In m; 0 where the unit has no size of its own (px, %, none).
  double metres() const;
};
std::optional<SvgLength> svg_length(std::string_view text);

/// "translate(10) rotate(30 5 5)". Nothing where the text is no list of transforms.
std::optional<Affine> svg_transform(std::string_view text);

/// One piece of a path, from a move to the next move or the end.
struct SvgSubpath {
  DrawnOutline outline;
  bool closed = false;  ///< by Z
};
/// What is wrong with path data is said in `problem`, empty where nothing is.
struct SvgPath {
  std::vector<SvgSubpath> pieces;
  std::string problem;
};
SvgPath svg_path(std::string_view data, const Affine& to_metres);

}  // namespace perfora::geometry
