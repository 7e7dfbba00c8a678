// What is here: what a record of another shape makes JSON throw, turned into the sentence that names its file.
// What is not: the records (study_record.cpp, sweep_record.cpp, calibration_record.cpp).
#pragma once

#include <filesystem>
#include <nlohmann/json.hpp>
#include <stdexcept>
#include <string>

#include "io/error.h"

namespace perfora::results {

/// What `read` gives. Missing keys and values of a wrong type become an InputError that names the file, the line (0:
/// the whole file) and what to do.
template <class Read>
auto read_from(const std::filesystem::path& file, int line, const std::string& remedy, const Read& read) {
  const auto refuse = [&](const std::exception& error) {
    return io::InputError({file.string(), line, ""},
                          std::string("this is not what perfora writes there (") + error.what() + ")", "", remedy);
  };
  try {
    return read();
  } catch (const nlohmann::json::exception& error) {
    throw refuse(error);
  } catch (const std::invalid_argument& error) {
    throw refuse(error);
  }
}

}  // namespace perfora::results
