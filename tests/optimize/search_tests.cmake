# Tests of the search half of the room.
add_executable(perfora_fake_worker fake_worker.cpp)
target_link_libraries(perfora_fake_worker PRIVATE Perfora::optimize GTest::gtest)
perfora_options(perfora_fake_worker)

perfora_add_test(test_search
  SOURCES
    test_nlopt_search.cpp
    test_objective.cpp
    test_study.cpp
    test_driver.cpp
    test_executor.cpp
    test_study_run.cpp
    test_sweep.cpp
    test_rank_correlation.cpp
  LIBRARIES Perfora::optimize fmt::fmt PkgConfig::nlopt
  LABELS unit
  TIMEOUT 120)
target_compile_definitions(test_search PRIVATE PERFORA_FAKE_WORKER="$<TARGET_FILE:perfora_fake_worker>")
add_dependencies(test_search perfora_fake_worker)
