// What is here: the way of one design to its elastic response: layout, packing, bonds, stiffness, first yield; its JSON
// form and its file. What is not: the solution itself (solver/elastic/elastic.h), pictures (report).
#pragma once

#include <filesystem>
#include <nlohmann/json.hpp>
#include <string>

#include "optimize/evaluate/evaluation.h"
#include "solver/bond_network.h"
#include "solver/elastic/elastic.h"
#include "solver/elastic/first_yield.h"

namespace perfora::optimize {

/// The elastic response of one design and replicate. A packing or a solution that was not reached is status `failed`
/// with its reason; all numbers of the answer are then not reached.
struct ElasticResponse {
  results::RunStatus status = results::RunStatus::completed;
  std::string reason;
  Seeds::Effective seeds;
  int replicate = 0;
  PackedDesign packed;
  solver::BondNetwork network;
  solver::ElasticResponse response;
  solver::FirstYield first_yield;
  results::Performance performance;
  double packing_seconds = 0.0, solution_seconds = 0.0;  ///< shares of performance.seconds
};

/// Packs as evaluate_design does (options.packing_file, threads and progress count), bonds and solves. Throws
/// io::InputError for bad input only. Cost: the packing, then one to two seconds for Table 1.
ElasticResponse elastic_response(const DesignFile& design, const EvaluateOptions& options, int replicate);

/// schema "perfora.elastic/1": what `perfora evaluate --elastic --json` prints.
nlohmann::json to_json(const ElasticResponse& answer);

/// The file of an answer that was reached (docs/user/formats.md), whole or not at all; `summary` is its JSON form.
void write_elastic_file(const std::filesystem::path& path, const DesignFile& design, const ElasticResponse& answer,
                        const nlohmann::json& summary, const std::string& command_line);

}  // namespace perfora::optimize
