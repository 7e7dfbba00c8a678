// What is here: both statements on replicates of one design: the verdict, and what is sure of single blocks. What is
// not: how each is found (verdict.h, assurance.h).
#pragma once

#include <nlohmann/json.hpp>
#include <optional>
#include <span>

#include "results/assurance.h"
#include "results/verdict.h"

namespace perfora::results {

struct Judgement {
  Verdict verdict;
  Assurance single_blocks;
};

/// Of replicates on seeds that did not choose the design (no null pointers). Nothing where `target` has no wish or
/// there are no replicates.
std::optional<Judgement> judgement_on(const Target& target, std::span<const Evaluation* const> replicates);

/// {verdict, single_blocks}: what records of ensembles, sweeps and studies carry.
nlohmann::json to_json(const Judgement& judgement);

}  // namespace perfora::results
