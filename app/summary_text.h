// What is here: the readable form of the JSON objects perfora prints and stores in its files: aligned, in kPa, mm, %.
// What is not: the objects themselves (optimize/evaluate/json.cpp).
#pragma once

#include <nlohmann/json.hpp>
#include <string>

namespace perfora::app {

/// Lines "label  value", grouped; `object` is one of the perfora.* schemas. What was not reached reads "not reached".
std::string summary_text(const nlohmann::json& object);

/// "1,234,567"
std::string with_thousands(double count);
/// Pa as "12.3 Pa", "45.6 kPa", "1.23 MPa", ...
std::string stress_text(double pascal);
/// m as "0.504 mm", "25 mm", "1.2 m", ...
std::string length_text(double metres);
/// "1 thread", "2 threads".
std::string threads_text(int threads);
/// Bytes as "12 MB", "1.3 GB".
std::string memory_text(double bytes);
/// "45 s", "3 min 20 s", "2 h 05 min", "14 d 3 h".
std::string duration_text(double seconds);

}  // namespace perfora::app
