// What is here: the record and the file of material tests. What is not: the tests (material_tests.h), the format
// (results/material_file.h).
#pragma once

#include <filesystem>
#include <nlohmann/json.hpp>
#include <string>

#include "optimize/evaluate/material_tests.h"

namespace perfora::optimize {

/// schema "perfora.test/1".
nlohmann::json to_json(const MaterialTests& tests);

/// T.h5 (docs/user/formats.md, "T.h5 (material tests)"), whole or not at all.
void write_material_tests(const std::filesystem::path& path, const DesignFile& design, const MaterialTests& tests,
                          const std::string& command_line);

}  // namespace perfora::optimize
