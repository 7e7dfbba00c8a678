// What is here: all that result files hold beside the result itself: frames, bonds and broken bonds of a run, elastic
// responses, material tests. What is not: results alone (results.h), packings (pack.h), folders (campaign.h).
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include "perfora/pack.h"
#include "perfora/results.h"

namespace perfora {

/// n discs and the m bonds that are intact, at one strain.
struct Frame {
  double strain = 0.0;                 ///< engineering, compression positive
  double time = 0.0;                   ///< s
  double width = 0.0;                  ///< of the block at that strain, m
  double height = 0.0;                 ///< of the block at that strain, m
  double shear = 0.0;                  ///< by which the upper edge is displaced, m
  std::vector<double> position;        ///< (n,2), m, from the lower left corner; wrapped where the block is periodic
  std::vector<double> angle;           ///< (n) rad
  std::vector<std::int32_t> fragment;  ///< (n) number of the fragment that a disc is of; 0 is the largest
  std::vector<double> damage;          ///< (n) share of the original bonds lost, 0 to 1
  std::vector<std::int32_t> bonds;     ///< (m,2) discs
  std::vector<double> bond_damage;     ///< (m) damage of each bond, 0 to 1

  /// Only of runs with output.frame_data = "all", else empty; c pairs of discs touch. Forces per metre of depth.
  std::vector<double> velocity;              ///< (n,2) m/s, beyond the affine motion of the block
  std::vector<double> spin;                  ///< (n) rad/s
  std::vector<double> stress;                ///< (n,3) xx, yy, xy over the disc's area, Pa, compression positive
  std::vector<double> bond_normal_force;     ///< (m) N/m, tension positive
  std::vector<double> bond_shear_force;      ///< (m) N/m
  std::vector<std::int32_t> contacts;        ///< (c,2) discs that touch, the smaller number first
  std::vector<double> contact_normal_force;  ///< (c) N/m, compression positive
  std::vector<double> contact_shear_force;   ///< (c) N/m
};

/// All bonds that a run began with, m of them.
struct Bonds {
  std::vector<std::int32_t> discs;       ///< (m,2), the smaller number first
  std::vector<double> reference_length;  ///< (m) m
  std::vector<double> strength_factor;   ///< (m) of its strength over that of the material
};

/// A run file, all of it. Copies share what they hold.
class RunFile {
 public:
  /// Reads R.h5; the discs of its frames are read when they are wanted. Throws Error for a file that is missing,
  /// damaged or no run.
  explicit RunFile(const std::filesystem::path& file);

  /// Its result.
  const Run& run() const;
  /// The discs before the compression.
  const Discs& discs() const;
  /// Rims of the openings before the compression.
  const std::vector<Outline>& openings() const;
  /// The bonds before the compression.
  const Bonds& bonds() const;
  /// Broken bonds, a row each in their order: "time" (s), "strain", "bond" (row in bonds()), "i", "j" (discs), "x", "y"
  /// (m), "mode" (0 tension, 1 shear), "energy" (J/m).
  const Table& events() const;
  /// Number of frames.
  std::size_t frames() const;
  /// Reads frame `index` from the file. Throws Error where there is none of that number.
  Frame frame(std::size_t index) const;

 private:
  struct Content;
  std::shared_ptr<const Content> content_;
};

/// The linear response of a block (`perfora evaluate --elastic`), n discs.
struct ElasticResponse {
  std::array<double, 9> stiffness{};         ///< (3,3) of xx, yy, xy with engineering shear, Pa
  std::array<double, 9> affine_stiffness{};  ///< the same without relaxation, Pa
  Discs discs;                               ///< of the block
  std::vector<Outline> openings;             ///< of the block
  /// (n,3) each, for unit strain xx, yy and xy: displacements x and y in m, rotation in rad.
  std::array<std::vector<double>, 3> displacement;
  std::vector<double> disc_strain;  ///< (n) strain at which the first bond of a disc yields; infinite: none does
  Table first_bonds;                ///< that yield first: "x", "y" (m), "strain", "i", "j" (discs), "mode"
  std::string design;               ///< all keys, TOML
  std::string record;               ///< the JSON record of the file
};

/// Reads the file of an elastic response. Throws Error.
ElasticResponse read_elastic(const std::filesystem::path& file);

/// One test of a sample of the solid material.
struct MaterialTest {
  std::string name;   ///< "tension", "compression", "shear", "oedometric"
  int replicate = 0;  ///< 0, 1, ...
  /// "strain", "stress" (Pa; both positive as the test loads), "lateral_strain" (extension positive), "lateral_stress"
  /// (Pa, compression positive), "damage", "work", "cundall" (J/m), "broken_bonds".
  Table curve;
};

/// The tests of one material (`perfora test`).
struct MaterialTests {
  std::vector<MaterialTest> tests;  ///< by name, then by replicate
  Discs sample;                     ///< discs of the sample
  std::string design;               ///< all keys, TOML
  std::string record;               ///< the JSON record of the file
};

/// Reads the file of material tests. Throws Error.
MaterialTests read_material_tests(const std::filesystem::path& file);

}  // namespace perfora
