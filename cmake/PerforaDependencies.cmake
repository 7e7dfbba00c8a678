# What is here: the libraries Perfora stands on; each is a Debian 12 package (setup.sh names them).
# What is not: compiler flags and room targets (PerforaTargets.cmake). PerforaConfig.cmake.in repeats those that a user of the installed library links.
find_package(Threads REQUIRED)
find_package(OpenMP REQUIRED COMPONENTS CXX)
find_package(CGAL REQUIRED)
find_package(Eigen3 REQUIRED NO_MODULE)
find_package(HDF5 REQUIRED COMPONENTS C)
find_package(ZLIB REQUIRED)
find_package(spdlog REQUIRED)
find_package(fmt REQUIRED)
find_package(nlohmann_json REQUIRED)
find_package(CLI11 REQUIRED)
find_package(pugixml REQUIRED)
find_package(PkgConfig REQUIRED)
option(PERFORA_MPI "Build perfora-mpi where MPI is" ON)
if(PERFORA_MPI)
  set(MPI_CXX_SKIP_MPICXX ON)  # the interface of C alone
  find_package(MPI QUIET COMPONENTS CXX)
endif()
pkg_check_modules(cairo REQUIRED IMPORTED_TARGET cairo)
# nlopt_cxx holds GN_AGS as well, which the plain library leaves out.
pkg_search_module(nlopt REQUIRED IMPORTED_TARGET nlopt_cxx nlopt)

# Headers alone, on the compiler's own path: found here so that a missing package is said by name, not by a failed include.
foreach(pair IN ITEMS "toml++/toml.h;libtomlplusplus-dev" "Random123/philox.h;librandom123-dev" "nlopt.hpp;libnlopt-cxx-dev")
  list(GET pair 0 header)
  list(GET pair 1 package)
  string(MAKE_C_IDENTIFIER "PERFORA_HAS_${header}" found)
  find_file(${found} ${header})
  mark_as_advanced(${found})
  if(NOT ${found})
    message(FATAL_ERROR "${header} is missing: install the Debian package ${package} (./setup.sh installs all of them)")
  endif()
endforeach()

# Libraries of the report's page, put into the program as they are.
foreach(triple IN ITEMS "PERFORA_CHART_JS;/usr/share/javascript/chart.js/chart.min.js;libjs-chart.js"
                        "PERFORA_INFLATE_JS;/usr/share/nodejs/pako/dist/pako_inflate.es5.min.js;node-pako")
  list(GET triple 0 variable)
  list(GET triple 1 path)
  list(GET triple 2 package)
  set(${variable} ${path} CACHE FILEPATH "JavaScript file of the package ${package}")
  mark_as_advanced(${variable})
  if(NOT EXISTS ${${variable}})
    message(FATAL_ERROR "${${variable}} is missing: install the Debian package ${package} (./setup.sh installs all of them)")
  endif()
endforeach()
