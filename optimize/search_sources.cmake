# The search half of this room.
set(search_sources
  constraints.cpp
  objective.cpp
  study.cpp
  study_arms.cpp
  candidate.cpp
  nlopt_search.cpp
  driver.cpp
  executor_in_process.cpp
  executor_children.cpp
  evaluation_queue.cpp
  study_run.cpp
  study_result.cpp
  sweep.cpp
  sweep_run.cpp
  sweep_result.cpp)
