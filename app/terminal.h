// What is here: what `evaluate` prints where a person looks at it: the numbers that decide, and the curve. What is not:
// the whole summary (common.h), which files, pipes and `perfora show` have.
#pragma once

#include <nlohmann/json.hpp>
#include <string>

#include "results/history.h"

namespace perfora::app {

/// Whether standard output is a terminal.
bool on_terminal();

/// Verdict, the dozen numbers that decide, the curve in block characters: within one screen. `record` is
/// perfora.evaluate/1, `run_file` what `perfora show` may be given for the rest.
std::string screen_text(const nlohmann::json& record, const results::History& curve, const std::string& run_file);

}  // namespace perfora::app
