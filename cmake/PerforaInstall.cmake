# What is here: `cmake --install`: the program, the library Perfora::perfora with its public headers (include/perfora),
# the rooms behind it as libraries to link, the example designs, and the package files that find_package(Perfora) reads.
# What is not: the rooms themselves (PerforaTargets.cmake); their headers are not installed.
include(CMakePackageConfigHelpers)

set(package_folder ${CMAKE_INSTALL_LIBDIR}/cmake/Perfora)
foreach(room IN ITEMS io geometry results solver evaluate campaign model search perfora)
  list(APPEND libraries perfora_${room})
endforeach()
install(TARGETS ${libraries} EXPORT PerforaTargets ARCHIVE DESTINATION ${CMAKE_INSTALL_LIBDIR})
install(EXPORT PerforaTargets NAMESPACE Perfora:: DESTINATION ${package_folder})
if(TARGET perfora)
  install(TARGETS perfora RUNTIME DESTINATION ${CMAKE_INSTALL_BINDIR})
  # Completion and manual page are what the program says of itself.
  install(CODE "foreach(form IN ITEMS bash zsh man)
    execute_process(COMMAND \"$<TARGET_FILE:perfora>\" completion \${form} OUTPUT_FILE \"${PROJECT_BINARY_DIR}/perfora.\${form}\" COMMAND_ERROR_IS_FATAL ANY)
  endforeach()")
  install(FILES ${PROJECT_BINARY_DIR}/perfora.bash DESTINATION ${CMAKE_INSTALL_DATADIR}/bash-completion/completions RENAME perfora)
  install(FILES ${PROJECT_BINARY_DIR}/perfora.zsh DESTINATION ${CMAKE_INSTALL_DATADIR}/zsh/site-functions RENAME _perfora)
  install(FILES ${PROJECT_BINARY_DIR}/perfora.man DESTINATION ${CMAKE_INSTALL_MANDIR}/man1 RENAME perfora.1)
endif()

if(TARGET perfora-mpi)
  install(TARGETS perfora-mpi RUNTIME DESTINATION ${CMAKE_INSTALL_BINDIR})
endif()

install(FILES ${PERFORA_PUBLIC_HEADERS} DESTINATION ${CMAKE_INSTALL_INCLUDEDIR}/perfora)
install(DIRECTORY ${PROJECT_SOURCE_DIR}/designs DESTINATION ${CMAKE_INSTALL_DATADIR}/perfora)
install(FILES ${PROJECT_SOURCE_DIR}/LICENSE ${PROJECT_SOURCE_DIR}/README.md ${PROJECT_SOURCE_DIR}/CITATION.cff DESTINATION ${CMAKE_INSTALL_DOCDIR})

configure_package_config_file(${PROJECT_SOURCE_DIR}/cmake/PerforaConfig.cmake.in ${PROJECT_BINARY_DIR}/PerforaConfig.cmake
  INSTALL_DESTINATION ${package_folder} NO_SET_AND_CHECK_MACRO)
write_basic_package_version_file(${PROJECT_BINARY_DIR}/PerforaConfigVersion.cmake COMPATIBILITY SameMinorVersion)
install(FILES ${PROJECT_BINARY_DIR}/PerforaConfig.cmake ${PROJECT_BINARY_DIR}/PerforaConfigVersion.cmake DESTINATION ${package_folder})
