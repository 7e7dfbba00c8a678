// What is here: discs in files of LAMMPS. What is not: whether they make a packing (import_packing.cpp), writing
// (report/export/).
#pragma once

#include <array>
#include <string>
#include <string_view>
#include <vector>

namespace perfora::geometry {

/// Spheres of a file, in the file's own unit of length.
struct LammpsSpheres {
  std::array<std::vector<double>, 3> place;  ///< x, y, z
  std::vector<double> radius;
  std::vector<int> lines;               ///< of the file, one a sphere
  std::array<double, 3> low{}, high{};  ///< of the box
  std::array<bool, 3> periodic = {true, true, true};
  std::string units;  ///< "si", "cgs", ...; empty: the file does not say
};

bool is_lammps_dump(std::string_view text);
bool is_lammps_data(std::string_view text);

/// The last frame of a text dump with columns x, y, z (or xu, ..., xs, ...) and radius or diameter. Throws
/// io::InputError with `name` and line for anything that is not whole, a tilted box, missing columns, more than `most`
/// spheres.
LammpsSpheres read_lammps_dump(std::string_view text, const std::string& name, std::size_t most);

/// A data file whose section Atoms is of style sphere, or of a hybrid with it. Throws io::InputError as above.
LammpsSpheres read_lammps_data(std::string_view text, const std::string& name, std::size_t most);

/// Metres of the unit of length that a style of LAMMPS has; 0 for "lj" and unknown ones.
double metres_of_lammps_units(std::string_view units);

}  // namespace perfora::geometry
