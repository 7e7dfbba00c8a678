// What is here: the file of an elastic response read, checked and written. What is not: its picture (report/).
#include "results/elastic_file.h"

#include <fmt/format.h>

#include "geometry/packing_file.h"
#include "results/file_parts.h"
#include "results/formats.h"

namespace perfora::results {
namespace {

constexpr std::array displacement_names = {"/displacement/xx", "/displacement/yy", "/displacement/xy"};

}  // namespace

ElasticResult read_elastic(const std::filesystem::path& path) {
  const io::Hdf5Reader file(path);
  require_format(file, elastic_format, "an elastic response", "give the file of `perfora evaluate --elastic`");
  ElasticResult elastic;
  elastic.path = path;
  elastic.provenance = read_provenance(file);
  elastic.clipped = geometry::read_packing(file, "/clipped");
  require_packing(file, "/clipped", elastic.clipped);
  elastic.layout = geometry::read_layout(file, "/layout");
  elastic.disc_strain = file.doubles("/first_yield/disc_strain");
  require_size(file, "/first_yield/disc_strain", elastic.disc_strain, elastic.clipped.x.size());
  for (const double strain : elastic.disc_strain)
    if (!(strain > 0.0)) refuse(file, "/first_yield/disc_strain", fmt::format("holds {}", strain), "positive strains");
  elastic.stiffness = finite_doubles(file, "/stiffness");
  elastic.affine_stiffness = finite_doubles(file, "/affine_stiffness");
  constexpr std::size_t entries = 9;
  require_size(file, "/stiffness", elastic.stiffness, entries);
  require_size(file, "/affine_stiffness", elastic.affine_stiffness, entries);
  for (std::size_t e = 0; e < displacement_names.size(); ++e) {
    elastic.displacement[e] = finite_doubles(file, displacement_names[e]);
    require_size(file, displacement_names[e], elastic.displacement[e], 3 * elastic.clipped.x.size());
  }
  FirstBonds& bonds = elastic.first_bonds;
  bonds.x = finite_doubles(file, "/first_yield/bonds/x");
  bonds.y = finite_doubles(file, "/first_yield/bonds/y");
  bonds.strain = finite_doubles(file, "/first_yield/bonds/strain");
  bonds.mode = file.int32s("/first_yield/bonds/mode");
  bonds.pairs = file.int32s("/first_yield/bonds/pairs");
  require_size(file, "/first_yield/bonds/pairs", bonds.pairs, 2 * bonds.x.size());
  require_discs(file, "/first_yield/bonds/pairs", bonds.pairs, elastic.clipped.size());
  require_size(file, "/first_yield/bonds/y", bonds.y, bonds.x.size());
  require_size(file, "/first_yield/bonds/strain", bonds.strain, bonds.x.size());
  require_size(file, "/first_yield/bonds/mode", bonds.mode, bonds.x.size());
  require_modes(file, "/first_yield/bonds/mode", bonds.mode);
  elastic.summary = read_summary(file);
  return elastic;
}

void write_elastic(const std::filesystem::path& path, const ElasticResult& elastic) {
  io::Hdf5Writer file(path);
  write_head(file, elastic_format, elastic.provenance, elastic.summary);
  geometry::write_layout(file, "/layout", elastic.layout);
  geometry::write_packing(file, "/clipped", elastic.clipped);
  file.dataset("/stiffness", elastic.stiffness, 3, "Pa");
  file.dataset("/affine_stiffness", elastic.affine_stiffness, 3, "Pa");
  for (std::size_t e = 0; e < displacement_names.size(); ++e)
    file.dataset(displacement_names[e], elastic.displacement[e], 3, "m, m, rad per unit strain");
  file.dataset("/first_yield/disc_strain", elastic.disc_strain, 0, "1");
  const FirstBonds& bonds = elastic.first_bonds;
  file.dataset("/first_yield/bonds/x", bonds.x, 0, "m");
  file.dataset("/first_yield/bonds/y", bonds.y, 0, "m");
  file.dataset("/first_yield/bonds/strain", bonds.strain, 0, "1");
  file.dataset("/first_yield/bonds/pairs", bonds.pairs, 2);
  file.dataset("/first_yield/bonds/mode", std::vector<std::uint8_t>(bonds.mode.begin(), bonds.mode.end()));
  file.commit();
}

}  // namespace perfora::results
