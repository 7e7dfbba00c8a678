// What is here: the record and the file of a packing. What is not: how it is packed.
#include "optimize/evaluate/pack_file.h"

#include <chrono>

#include "io/memory.h"
#include "results/formats.h"
#include "results/pack_file.h"

namespace perfora::optimize {

RecordedPacking pack_with_record(const DesignFile& design, const EvaluateOptions& options, int replicate) {
  const auto start = std::chrono::steady_clock::now();
  RecordedPacking made;
  made.packed = pack_design(design, options, replicate);
  made.performance.seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  made.performance.threads = options.threads;
  made.performance.peak_memory = io::peak_memory_bytes();
  made.record = pack_record(made.packed, design.design().seeds.effective(replicate), made.performance);
  return made;
}

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
                     const nlohmann::json& summary, const std::string& command_line, int replicate) {
  results::write_pack(path, {path, provenance_of(design, design.design().seeds.effective(replicate), command_line),
                             packed.periodic, packed.clipped, packed.layout, summary});
}

}  // namespace perfora::optimize
