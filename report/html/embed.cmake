# What is here: a C++ file that holds the texts of other files, written at build time:
# cmake -DOUTPUT=FILE "-DFILES=name=path;name=path" -P embed.cmake
# What is not: which files (report/CMakeLists.txt), who reads them (page.cpp).
set(text "// Written by report/html/embed.cmake. What is here: the texts of the files that a report is made of.\n#include \"report/html/page.h\"\n\nnamespace perfora::report {\n\nstd::string_view embedded(std::string_view name) {\n")
foreach(pair IN LISTS FILES)
  string(REGEX MATCH "^([^=]*)=(.*)$" all "${pair}")
  file(READ "${CMAKE_MATCH_2}" content)
  string(APPEND text "  if (name == \"${CMAKE_MATCH_1}\")\n    return R\"embedded(${content})embedded\";\n")
endforeach()
string(APPEND text "  return {};\n}\n\n}  // namespace perfora::report\n")
file(WRITE "${OUTPUT}" "${text}")
