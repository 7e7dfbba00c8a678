// What is here: the readable table of a sweep's record. What is not: the record (optimize/campaign/sweep_result.h),
// other summaries (summary_text.h).
#pragma once

#include <nlohmann/json.hpp>
#include <string>

namespace perfora::app {

/// A line a case: number, label, completed runs, the results that the sweep shows with half of their 95 % interval and,
/// where there is a case 0, their change to it. `record` is perfora.sweep/1.
std::string sweep_table_text(const nlohmann::json& record);

}  // namespace perfora::app
