// What is here: what a design looks like to a model, in numbers that do not depend on the family it was made by. What
// is not: their scaling (features.h).
#pragma once

#include <string>
#include <vector>

#include "optimize/evaluate/design.h"

namespace perfora::model {

struct Descriptor {
  const char* name;
  const char* help;
};
/// In the order of Descriptors::values.
const std::vector<Descriptor>& descriptor_list();

struct Descriptors {
  int family = 0;  ///< geometry::LayoutFamily as a number, with the shape of the holes: what has a name only
  std::vector<double> values;
};

/// Measured on the layout of replicate 0; no disc is placed. Rows are the minima of the solid width over the height, so
/// a layout of any family has them. Throws io::InputError where it cannot be laid.
Descriptors describe_design(const optimize::Design& design);

}  // namespace perfora::model
