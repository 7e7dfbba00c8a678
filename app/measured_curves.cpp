// What is here: curves from flags and from stored configurations.
#include "app/measured_curves.h"

#include <algorithm>
#include <filesystem>

#include "io/error.h"
#include "io/progress.h"
#include "optimize/evaluate/design.h"
#include "results/curve_file.h"

namespace perfora::app {
namespace {

namespace fs = std::filesystem;

/// What a configuration names; empty where it names none, or comes from a program that knew other keys.
fs::path curve_in(const std::string& configuration) {
  if (configuration.empty()) return {};
  try {
    return optimize::DesignFile::from_toml(configuration, "configuration").design().solver.output.curve;
  } catch (const io::InputError&) {
    return {};
  }
}

}  // namespace

std::vector<results::Curve> measured_curves(const std::vector<std::string>& files,
                                            const std::vector<std::string>& configurations) {
  std::vector<results::Curve> curves;
  std::vector<fs::path> known;
  for (const std::string& file : files) {
    known.push_back(fs::absolute(file).lexically_normal());
    curves.push_back(results::read_curve(file));
  }
  for (const std::string& configuration : configurations) {
    const fs::path file = curve_in(configuration);
    if (file.empty() || std::find(known.begin(), known.end(), file) != known.end()) continue;
    known.push_back(file);
    try {
      curves.push_back(results::read_curve(file));
    } catch (const io::InputError& error) {
      io::log_warning(std::string("the measured curve of the design is not drawn: ") + error.what());
    }
  }
  return curves;
}

}  // namespace perfora::app
