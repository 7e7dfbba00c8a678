// What is here: where short texts stand beside points so that they hide neither points nor each other.
// What is not: drawing (canvas.h).
#pragma once

#include <vector>

#include "report/canvas.h"

namespace perfora::report {

/// Places boxes one after another beside their points, each where it covers least of what is already taken.
class LabelPlaces {
 public:
  /// What of a label sticks out of `area` counts as covered.
  explicit LabelPlaces(const Box& area) : area_(area) {}
  /// Takes the square around a point of this radius.
  void keep_clear(double x, double y, double radius);
  /// Takes and returns the best of 24 boxes of this size around a point of this radius: eight directions, upper right
  /// first, at three distances, near ones first. All of them cover something where points are too dense.
  Box place(double x, double y, double radius, double width, double height);

 private:
  double covered(const Box& box) const;
  Box area_;
  std::vector<Box> taken_;
};

}  // namespace perfora::report
