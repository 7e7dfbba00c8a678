// What is here: the record and the file of a packing. What is not: how it is packed (evaluation.h), the format
// (results/pack_file.h).
#pragma once

#include <filesystem>
#include <nlohmann/json.hpp>
#include <string>

#include "optimize/evaluate/evaluation.h"

namespace perfora::optimize {

/// A packing with its record.
struct RecordedPacking {
  PackedDesign packed;
  results::Performance performance;
  nlohmann::json record;  ///< pack_record()
};
/// pack_design(), timed: what `perfora pack` does before it writes.
RecordedPacking pack_with_record(const DesignFile& design, const EvaluateOptions& options, int replicate);

/// schema "perfora.pack/1": what `perfora pack --json` prints; status "failed" when the packing was not reached.
nlohmann::json pack_record(const PackedDesign& packed, const Seeds::Effective& seeds,
                           const results::Performance& performance);

/// P.h5 of a packed design (docs/user/formats.md), whole or not at all; `summary` is the object that `perfora pack
/// --json` prints.
void write_pack_file(const std::filesystem::path& path, const DesignFile& design, const PackedDesign& packed,
                     const nlohmann::json& summary, const std::string& command_line, int replicate = 0);

}  // namespace perfora::optimize
