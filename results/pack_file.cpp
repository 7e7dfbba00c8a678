// What is here: P.h5 read, checked and written. What is not: how packings are made.
#include "results/pack_file.h"

#include "geometry/packing_file.h"
#include "results/file_parts.h"
#include "results/formats.h"

namespace perfora::results {

PackResult read_pack(const std::filesystem::path& path) {
  const io::Hdf5Reader file(path);
  require_format(file, pack_format, "a packing", "give the P.h5 of `perfora pack`");
  PackResult pack;
  pack.path = path;
  pack.provenance = read_provenance(file);
  pack.periodic = geometry::read_packing(file, "/packing");
  require_packing(file, "/packing", pack.periodic);
  pack.clipped = geometry::read_packing(file, "/clipped");
  require_packing(file, "/clipped", pack.clipped);
  pack.layout = geometry::read_layout(file, "/layout");
  pack.summary = read_summary(file);
  return pack;
}

void write_pack(const std::filesystem::path& path, const PackResult& pack) {
  io::Hdf5Writer file(path);
  write_head(file, pack_format, pack.provenance, pack.summary);
  geometry::write_packing(file, "/packing", pack.periodic);
  geometry::write_layout(file, "/layout", pack.layout);
  geometry::write_packing(file, "/clipped", pack.clipped);
  file.commit();
}

}  // namespace perfora::results
