// What is here: how a run, a packing or a campaign ended. What is not: why (a text beside it).
#pragma once

#include <optional>
#include <string_view>

namespace perfora::results {

enum class RunStatus { completed, stopped, failed };
/// As files and JSON name it: "completed", "stopped", "failed".
const char* status_name(RunStatus status);
/// The status of a name; nothing for any other text.
std::optional<RunStatus> status_called(std::string_view name);

}  // namespace perfora::results
