// What is here: sweeps in a folder of their own, with a formula for a simulation. What is not: tests.
#pragma once

#include <gtest/gtest.h>

#include <atomic>
#include <cmath>
#include <stdexcept>
#include <string>
#include <vector>

#include "io/progress.h"
#include "optimize/campaign/sweep_result.h"
#include "tests/optimize/search/study_support.h"

namespace perfora::optimize {

inline std::string sweep_text(const std::string& tables, const std::string& keys = "replicates = 3") {
  return "[sweep]\ndesign = \"design.toml\"\n" + keys + "\n" + tables;
}

/// Plateau = 1e5 (horizon + replicate) + 1e4 zeta_max; fails at a horizon of 2.25.
inline Evaluation formula(const Request& request) {
  const solver::MaterialOptions& material = request.design->solver.material;
  const double horizon = material.horizon;
  if (horizon == 2.25) return failed_evaluation("unstable step", request.replicate);
  Evaluation evaluation = completed(request);
  evaluation.summary.plateau_stress = 1e5 * (horizon + request.replicate) + 1e4 * material.rupture_delay;
  evaluation.summary.first_peak_stress = std::nan("");
  evaluation.curve.strain_yy = {0.001, 0.002};
  evaluation.curve.stress_yy = {1.0, 2.0};
  return evaluation;
}

class SweepTest : public testing::Test {
 protected:
  StudyFolder folder;
  std::atomic<int> asked = 0;
  void SetUp() override { io::set_verbosity(io::Verbosity::quiet); }
  void TearDown() override { io::set_verbosity(io::Verbosity::normal); }

  Sweep sweep(const std::string& text, const std::vector<std::string>& only = {}) {
    return read_sweep(folder.file("sweep.toml", text), {}, only);
  }
  std::string refused(const std::string& text) {
    return input_error([&] { sweep(text); });
  }

  WorkOptions options(const std::string& name, bool resume = false, int workers = 1) {
    WorkOptions made;
    made.folder = folder / name;
    made.resume = resume;
    made.make_executor = [this, workers] {
      return make_in_process_executor(
          [this](const Request& request) {
            ++asked;
            return formula(request);
          },
          workers);
    };
    return made;
  }

  static const results::Statistic& statistic(const std::vector<results::Statistic>& all, const std::string& name) {
    for (const results::Statistic& one : all)
      if (one.name == name) return one;
    throw std::logic_error("no result " + name);
  }
};

}  // namespace perfora::optimize
