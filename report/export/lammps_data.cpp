// What is here: discs and bonds of one moment as a LAMMPS data file: every bond a type of its own with K = k_n/2 and
// its reference length. What is not: the tangential springs of the bonds, which no bond style of LAMMPS has. Format:
// LAMMPS manual, "read_data"; use: docs/user/exports.md.
#include <fmt/format.h>

#include <algorithm>
#include <iterator>
#include <map>

#include "io/error.h"
#include "io/files.h"
#include "report/export/lammps_box.h"
#include "report/export/registry.h"

namespace perfora::report {
namespace {

/// Reference length of every bond of the moment, in its order.
std::vector<double> reference_lengths(const Scene& scene, const Moment& moment) {
  std::map<std::pair<std::int32_t, std::int32_t>, double> known;
  const results::Bonds& bonds = scene.bonds();
  for (std::size_t b = 0; b < bonds.size(); ++b)
    known[{bonds.pairs[2 * b], bonds.pairs[2 * b + 1]}] = bonds.reference_length[b];
  std::vector<double> lengths;
  for (std::size_t b = 0; b < moment.pairs.size() / 2; ++b) {
    const auto found = known.find({moment.pairs[2 * b], moment.pairs[2 * b + 1]});
    if (found == known.end())
      throw io::InputError({scene.path().string(), 0, "/frames"}, "a frame has a bond that /bonds does not list",
                           "a bond of /bonds", "run the design again");
    lengths.push_back(found->second);
  }
  return lengths;
}

/// Fragment of every disc, from 1; all 1 where the moment does not tell.
std::vector<long long> molecules(const Scene& scene, const Moment& moment) {
  std::vector<long long> molecule(scene.discs(), 1);
  for (const Column& column : moment.columns)
    if (column.name == "fragment")
      for (std::size_t d = 0; d < molecule.size(); ++d) molecule[d] = static_cast<long long>(column.values[d]) + 1;
  return molecule;
}

}  // namespace

LammpsBox box_of(const Scene& scene, const Moment& moment) {
  LammpsBox box{
      0.0, moment.info.h_xx, 0.0, moment.info.h_yy, moment.info.h_xy, scene.edges().open_x(), scene.edges().platens};
  for (std::size_t d = 0; d < scene.discs(); ++d) {
    const double x = moment.position[2 * d], y = moment.position[2 * d + 1], r = scene.radius()[d];
    if (box.open_x) {
      box.x_low = std::min(box.x_low, x - r);
      box.x_high = std::max(box.x_high, x + r);
    }
    if (box.open_y) {
      box.y_low = std::min(box.y_low, y - r);
      box.y_high = std::max(box.y_high, y + r);
    }
  }
  return box;
}

void write_lammps_data(const Scene& scene, const std::filesystem::path& base) {
  const Moment moment = scene.chose_a_moment() ? scene.moment(0) : scene.start();
  const SceneMaterial material = scene.material();
  const std::vector<double> lengths = reference_lengths(scene, moment);
  const std::vector<long long> molecule = molecules(scene, moment);
  const LammpsBox box = box_of(scene, moment);
  fmt::memory_buffer out;
  const auto to = std::back_inserter(out);
  fmt::format_to(to, "{} at strain {}; units si, dimension 2, a metre of depth; bond_style harmonic, K = k_n/2\n\n",
                 scene.title(), moment.info.strain);
  fmt::format_to(to, "{} atoms\n1 atom types\n", scene.discs());
  if (!lengths.empty()) fmt::format_to(to, "{0} bonds\n{0} bond types\n", lengths.size());
  fmt::format_to(to, "\n{} {} xlo xhi\n{} {} ylo yhi\n-0.5 0.5 zlo zhi\n", box.x_low, box.x_high, box.y_low,
                 box.y_high);
  if (box.xy != 0.0) fmt::format_to(to, "{} 0 0 xy xz yz\n", box.xy);
  fmt::format_to(to, "\nAtoms # hybrid bond sphere\n\n");
  for (std::size_t d = 0; d < scene.discs(); ++d)
    fmt::format_to(to, "{} 1 {} {} 0 {} {} {}\n", d + 1, moment.position[2 * d], moment.position[2 * d + 1],
                   molecule[d], 2.0 * scene.radius()[d], material.density);
  if (!lengths.empty()) {
    fmt::format_to(to, "\nBond Coeffs # harmonic\n\n");
    for (std::size_t b = 0; b < lengths.size(); ++b)
      fmt::format_to(to, "{} {} {}\n", b + 1, 0.5 * material.normal_stiffness, lengths[b]);
    fmt::format_to(to, "\nBonds\n\n");
    for (std::size_t b = 0; b < lengths.size(); ++b)
      fmt::format_to(to, "{0} {0} {1} {2}\n", b + 1, moment.pairs[2 * b] + 1, moment.pairs[2 * b + 1] + 1);
  }
  io::write_file(with_extension(base, ".data"), {out.data(), out.size()});
}

}  // namespace perfora::report
