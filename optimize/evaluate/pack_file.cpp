// What is here: P.h5, the packing file, and what it shares with other result files. What is not: how packings are
// written into a group (geometry/packing_file.h).
#include "geometry/packing_file.h"
#include "io/provenance.h"
#include "optimize/evaluate/evaluation.h"

namespace perfora::optimize {

void write_record(io::Hdf5Writer& file, const std::string& format, const DesignFile& design,
                  const nlohmann::json& summary, const std::string& command_line) {
  file.attribute("/", "format", format);
  file.attribute("/", "program_version", io::program_version());
  file.attribute("/", "git_revision", io::git_revision());
  file.attribute("/", "command_line", command_line);
  file.attribute("/", "seeds", summary.at("seeds").dump());
  file.text("/config", design.schema().to_toml());
  file.text("/summary", summary.dump(2));
}

void write_pack_file(const std::filesystem::path& path, const DesignFile& design, const PackedDesign& packed,
                     const nlohmann::json& summary, const std::string& command_line) {
  io::Hdf5Writer file(path);
  write_record(file, "perfora.pack/1", design, summary, command_line);
  geometry::write_packing(file, "/packing", packed.periodic);
  geometry::write_layout(file, "/layout", packed.layout);
  geometry::write_packing(file, "/clipped", packed.clipped);
  file.commit();
}

}  // namespace perfora::optimize
