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

  /// Only in frames of output.frame_data = "all", else empty. Forces per metre of depth.
  std::vector<double> velocity;              ///< (n,2), m/s, beyond the affine motion of the block
  std::vector<double> spin;                  ///< rad/s
  std::vector<double> stress;                ///< (n,3) xx, yy, xy over the disc's area, Pa, compression positive
  std::vector<double> bond_normal_force;     ///< (m), N/m, tension positive
  std::vector<double> bond_shear_force;      ///< (m), N/m
  std::vector<std::int32_t> contact_pairs;   ///< (c,2), i < j: pairs that touch
  std::vector<double> contact_normal_force;  ///< (c), N/m, compression positive
  std::vector<double> contact_shear_force;   ///< (c), N/m
  bool has_forces() const { return !stress.empty(); }
};

}  // namespace perfora::results
