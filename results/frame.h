// What is here: discs and intact bonds of a run at one strain, as files and pictures take them. What is not: how a
// frame is taken (solver/frame.h), files (file_parts.h, run_file.h).
#pragma once

#include <cstdint>
#include <string>
#include <vector>

namespace perfora::results {

/// What is known of a frame before its discs are read.
struct FrameInfo {
  std::string name;                           ///< in its file, "00000"; empty before it is written
  double strain = 0.0;                        ///< engineering, compression positive
  double time = 0.0;                          ///< s
  double h_xx = 0.0, h_xy = 0.0, h_yy = 0.0;  ///< edges of the block, m
};

/// n discs, m intact bonds.
struct Frame {
  FrameInfo info;
  std::vector<double> position;          ///< (n,2), m from the block's lower left corner, wrapped where it is periodic
  std::vector<double> angle;             ///< rad
  std::vector<std::int32_t> fragment;    ///< 0 is the largest
  std::vector<double> damage;            ///< share of the original bonds lost, damage counted, 0 to 1
  std::vector<std::int32_t> bond_pairs;  ///< (m,2)
  std::vector<double> bond_damage;       ///< D
};

}  // namespace perfora::results
