# What is here: `cmake --install`: the program, the rooms as Perfora::io ... Perfora::report, headers under include/perfora, the example designs,
# and the package files that find_package(Perfora) reads. What is not: the rooms themselves (PerforaTargets.cmake).
include(GNUInstallDirs)
include(CMakePackageConfigHelpers)

set(package_folder ${CMAKE_INSTALL_LIBDIR}/cmake/Perfora)
get_property(rooms GLOBAL PROPERTY PERFORA_ROOMS)
if(rooms)
  install(TARGETS ${rooms} EXPORT PerforaTargets ARCHIVE DESTINATION ${CMAKE_INSTALL_LIBDIR})
  install(EXPORT PerforaTargets NAMESPACE Perfora:: DESTINATION ${package_folder})
endif()
if(TARGET perfora)
  install(TARGETS perfora RUNTIME DESTINATION ${CMAKE_INSTALL_BINDIR})
endif()

foreach(room IN ITEMS io geometry results solver optimize report)
  install(DIRECTORY ${PROJECT_SOURCE_DIR}/${room} DESTINATION ${CMAKE_INSTALL_INCLUDEDIR}/perfora FILES_MATCHING PATTERN "*.h")
endforeach()
install(DIRECTORY ${PROJECT_SOURCE_DIR}/designs DESTINATION ${CMAKE_INSTALL_DATADIR}/perfora)
install(FILES ${PROJECT_SOURCE_DIR}/LICENSE ${PROJECT_SOURCE_DIR}/README.md ${PROJECT_SOURCE_DIR}/CITATION.cff DESTINATION ${CMAKE_INSTALL_DOCDIR})

configure_package_config_file(${PROJECT_SOURCE_DIR}/cmake/PerforaConfig.cmake.in ${PROJECT_BINARY_DIR}/PerforaConfig.cmake
  INSTALL_DESTINATION ${package_folder} NO_SET_AND_CHECK_MACRO)
write_basic_package_version_file(${PROJECT_BINARY_DIR}/PerforaConfigVersion.cmake COMPATIBILITY SameMinorVersion)
install(FILES ${PROJECT_BINARY_DIR}/PerforaConfig.cmake ${PROJECT_BINARY_DIR}/PerforaConfigVersion.cmake DESTINATION ${package_folder})
