// What is here: P.h5, the packing file. What is not: how packings are written into a group (geometry/packing_file.h).
#include "geometry/packing_file.h"
#include "io/provenance.h"
#include "optimize/evaluation.h"

namespace perfora::optimize {

void write_pack_file(const std::filesystem::path& path, const DesignFile& design, const PackedDesign& packed,
                     const nlohmann::json& summary, const std::string& command_line) {
  io::Hdf5Writer file(path);
  file.attribute("/", "format", "perfora.pack/1");
  file.attribute("/", "program_version", io::program_version());
  file.attribute("/", "git_revision", io::git_revision());
  file.attribute("/", "command_line", command_line);
  file.attribute("/", "seeds", summary.at("seeds").dump());
  geometry::write_packing(file, "/packing", packed.periodic);
  geometry::write_layout(file, "/layout", packed.layout);
  geometry::write_packing(file, "/clipped", packed.clipped);
  file.text("/config", design.schema().to_toml());
  file.text("/summary", summary.dump(2));
  file.commit();
}

}  // namespace perfora::optimize
