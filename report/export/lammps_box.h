// What is here: the box that LAMMPS files state around a block. What is not: the files.
#pragma once

#include "report/export/scene.h"

namespace perfora::report {

/// m; `xy`: tilt. The block where it is periodic, else with room for every disc.
struct LammpsBox {
  double x_low = 0.0, x_high = 0.0, y_low = 0.0, y_high = 0.0, xy = 0.0;
  bool open_x = false, open_y = false;
};

LammpsBox box_of(const Scene& scene, const Moment& moment);

}  // namespace perfora::report
