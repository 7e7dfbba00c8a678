// What is here: the record and the file of a packing. What is not: how it is packed.
#include "optimize/evaluate/pack_file.h"

#include "results/formats.h"
#include "results/pack_file.h"

namespace perfora::optimize {

nlohmann::json pack_record(const PackedDesign& packed, const Seeds::Effective& seeds,
                           const results::Performance& performance) {
  const bool reached = packed.periodic.quality.reached;
  nlohmann::json record =
      results::record_head(results::pack_format, reached ? results::RunStatus::completed : results::RunStatus::failed,
                           reached ? "packing made" : packed.periodic.quality.reason, seeds);
  record.update(to_json(packed.summary));
  record["performance"] = to_json(performance);
  return record;
}

void write_pack_file(const std::filesystem::path& path, const DesignFile& design, const PackedDesign& packed,
                     const nlohmann::json& summary, const std::string& command_line) {
  results::write_pack(path, {path, provenance_of(design, design.design().seeds.effective(0), command_line),
                             packed.periodic, packed.clipped, packed.layout, summary});
}

}  // namespace perfora::optimize
