// What is here: the measured curves that a picture shows: those of --curve and those that designs name (output.curve).
// What is not: their files (results/curve_file.h), drawing (report/measured_curves.h).
#pragma once

#include <string>
#include <vector>

#include "results/curve.h"

namespace perfora::app {

/// Curves of `files`, then those that the resolved configurations of runs name, each file once. A file that a
/// configuration names and that is no longer there or no longer a curve is a warning; one of `files` throws
/// io::InputError.
std::vector<results::Curve> measured_curves(const std::vector<std::string>& files,
                                            const std::vector<std::string>& configurations);

}  // namespace perfora::app
