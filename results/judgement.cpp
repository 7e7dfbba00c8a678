// What is here: verdict and single blocks found together. What is not: the formulas (verdict.cpp, assurance.cpp).
#include "results/judgement.h"

namespace perfora::results {

std::optional<Judgement> judgement_on(const Target& target, std::span<const Evaluation* const> replicates) {
  if (replicates.empty() || wishes(target).empty()) return std::nullopt;
  return Judgement{verdict_on(target, replicates), assurance_of(target, replicates)};
}

nlohmann::json to_json(const Judgement& judgement) {
  return {{"verdict", to_json(judgement.verdict)}, {"single_blocks", to_json(judgement.single_blocks)}};
}

}  // namespace perfora::results
