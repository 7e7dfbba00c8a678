// What is here: the one readable form of the JSON objects that Perfora prints and stores in its files. What is not: the
// objects themselves, their labels and dimensions (summary_labels.h).
#pragma once

#include <functional>
#include <nlohmann/json.hpp>
#include <string>

#include "io/schema.h"

namespace perfora::results {

/// Dimension of a key of the design file ("layout.diameter"), none for an unknown one: the values of a study's best
/// design and the parameters that a calibration found are keys of designs, which this room does not know.
using KeyDimension = std::function<io::Dimension(const std::string& key)>;

/// Lines "label  value", grouped, of an object of one of the schemas perfora.pack/1, evaluate/1, elastic/1, ensemble/1,
/// sweep/1, optimize/1, calibrate/1, test/1 and check/1. What was not reached reads "not reached". Throws
/// io::InputError, which names `source`, for another schema and for an object that lacks what its schema has.
std::string summary_text(const nlohmann::json& object, const KeyDimension& key_dimension,
                         const std::string& source = "");

/// What one evaluation is expected to take, from perfora.check/1; `whose` says in words which of several it is.
std::string estimate_text(const nlohmann::json& object, const std::string& whose = "");

}  // namespace perfora::results
