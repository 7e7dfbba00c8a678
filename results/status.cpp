// What is here: the names of states. What is not: their meaning for exit codes (app/common.cpp).
#include "results/status.h"

namespace perfora::results {

const char* status_name(RunStatus status) {
  switch (status) {
    case RunStatus::completed:
      return "completed";
    case RunStatus::stopped:
      return "stopped";
    case RunStatus::failed:
      return "failed";
  }
  return "failed";
}

std::optional<RunStatus> status_called(std::string_view name) {
  for (const RunStatus status : {RunStatus::completed, RunStatus::stopped, RunStatus::failed})
    if (name == status_name(status)) return status;
  return std::nullopt;
}

}  // namespace perfora::results
