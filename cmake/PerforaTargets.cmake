# perfora_add_room(name SOURCES ... PUBLIC ... PRIVATE ...): one static library a room, alias Perfora::name.
# perfora_add_test(name SOURCES ... LIBRARIES ... LABELS ... [TIMEOUT s] [SUFFIX text]): one GoogleTest program, registered with CTest.
# SUFFIX goes behind the names of its tests: for a second program of the same sources.
function(perfora_options target)
  # -ffp-contract=off: the same bits with and without fused multiply-add hardware. No -ffast-math anywhere.
  target_compile_options(${target} PRIVATE -Wall -Wextra -Wshadow -Wconversion -ffp-contract=off -fno-math-errno)
  if(PERFORA_WERROR)
    target_compile_options(${target} PRIVATE -Werror)
  endif()
endfunction()

function(perfora_add_room name)
  cmake_parse_arguments(ARG "" "" "SOURCES;PUBLIC;PRIVATE" ${ARGN})
  set(target perfora_${name})
  add_library(${target} STATIC ${ARG_SOURCES})
  add_library(Perfora::${name} ALIAS ${target})
  set_target_properties(${target} PROPERTIES EXPORT_NAME ${name})
  target_include_directories(${target} PUBLIC $<BUILD_INTERFACE:${PROJECT_SOURCE_DIR}>)  # rooms' headers stay here
  target_compile_features(${target} PUBLIC cxx_std_20)
  target_link_libraries(${target} PUBLIC ${ARG_PUBLIC})
  foreach(library IN LISTS ARG_PRIVATE)
    target_link_libraries(${target} PRIVATE ${library})
  endforeach()
  perfora_options(${target})
  perfora_unity(${target})
endfunction()

# perfora_unity(target): several files in one translation unit, for builds from nothing (./run, sanitizers): half of such a build is the
# reading of headers. File-local names are therefore unique within a room.
function(perfora_unity target)
  if(PERFORA_UNITY)
    set_target_properties(${target} PROPERTIES UNITY_BUILD ON UNITY_BUILD_BATCH_SIZE 12)
    # GCC 12 warns wrongly of overlapping text where "literal" + std::string is inlined (as in googletest issue 4108); joined files inline more.
    if(CMAKE_CXX_COMPILER_ID STREQUAL "GNU" AND CMAKE_CXX_COMPILER_VERSION VERSION_LESS 13)
      target_compile_options(${target} PRIVATE -Wno-restrict)
    endif()
  endif()
endfunction()

function(perfora_add_test name)
  cmake_parse_arguments(ARG "" "TIMEOUT;SUFFIX" "SOURCES;LIBRARIES;LABELS" ${ARGN})
  if(NOT ARG_TIMEOUT)
    set(ARG_TIMEOUT 300)
  endif()
  add_executable(${name} ${ARG_SOURCES})
  target_link_libraries(${name} PRIVATE ${ARG_LIBRARIES} GTest::gtest GTest::gmock GTest::gtest_main)
  target_compile_definitions(${name} PRIVATE PERFORA_SOURCE_DIR="${PROJECT_SOURCE_DIR}" PERFORA_BINARY_DIR="${PROJECT_BINARY_DIR}")
  perfora_options(${name})
  # Tests compile a third faster with -O1; what takes time while they run is in the libraries, built as users get them.
  target_compile_options(${name} PRIVATE $<$<CONFIG:Release>:-O1>)
  if(TARGET perfora_openmp_for_tsan)
    target_link_libraries(${name} PRIVATE perfora_openmp_for_tsan)
  endif()
  perfora_label_target(${name} ${ARG_LABELS})
  if(PERFORA_TEST_SHARDS)
    perfora_add_shards(${name} ${ARG_LABELS})
    return()
  endif()
  gtest_discover_tests(${name} DISCOVERY_TIMEOUT 60 TEST_SUFFIX "${ARG_SUFFIX}" TEST_LIST ${name}_tests PROPERTIES TIMEOUT ${ARG_TIMEOUT})
  # Waiting threads sleep: tests share their cores, and a spinning thread that waits for one that is not scheduled takes a hundred times as long.
  # CTest tries the same random designs each time (RC_PARAMS); the program by itself tries new ones.
  # Labels in a file of their own: gtest_discover_tests takes its PROPERTIES apart at every semicolon, so two labels would not arrive.
  file(WRITE ${CMAKE_CURRENT_BINARY_DIR}/${name}_labels.cmake "foreach(test IN LISTS ${name}_tests)\n"
    "  set_tests_properties(\"\${test}\" PROPERTIES LABELS \"${ARG_LABELS}\" ENVIRONMENT \"OMP_WAIT_POLICY=passive;RC_PARAMS=seed=2026\")\nendforeach()\n")
  set_property(DIRECTORY APPEND PROPERTY TEST_INCLUDE_FILES ${CMAKE_CURRENT_BINARY_DIR}/${name}_labels.cmake)
endfunction()

# perfora_add_shards(target labels...): the tests of a program in PERFORA_TEST_SHARDS processes instead of one each. For the sanitizers, where the start of a process
# takes longer than most tests.
function(perfora_add_shards target)
  math(EXPR last "${PERFORA_TEST_SHARDS} - 1")
  foreach(shard RANGE ${last})
    add_test(NAME ${target}.${shard} COMMAND ${target} WORKING_DIRECTORY ${CMAKE_CURRENT_BINARY_DIR})
    set_tests_properties(${target}.${shard} PROPERTIES LABELS "${ARGN}" TIMEOUT 1800
      ENVIRONMENT "OMP_WAIT_POLICY=passive;RC_PARAMS=seed=2026;GTEST_TOTAL_SHARDS=${PERFORA_TEST_SHARDS};GTEST_SHARD_INDEX=${shard}")
  endforeach()
endfunction()

# perfora_label_target(target labels...): building tests_<label> builds all that carry the label (the sanitizer builds need no more than that).
function(perfora_label_target target)
  foreach(label IN LISTS ARGN)
    if(NOT TARGET tests_${label})
      add_custom_target(tests_${label})
    endif()
    add_dependencies(tests_${label} ${target})
  endforeach()
endfunction()
