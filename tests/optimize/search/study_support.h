// What is here: small studies in a folder of their own, and evaluations that are formulas instead of simulations.
// What is not: tests.
#pragma once

#include <gtest/gtest.h>
#include <stdlib.h>

#include <cmath>
#include <filesystem>
#include <fstream>
#include <functional>
#include <string>

#include "io/error.h"
#include "io/schema.h"
#include "optimize/campaign/executor.h"
#include "optimize/search/driver.h"
#include "optimize/search/study.h"

namespace perfora::optimize {

class StudyFolder {
 public:
  StudyFolder() {
    std::string name = (std::filesystem::temp_directory_path() / "perfora-study-XXXXXX").string();
    path_ = ::mkdtemp(name.data());
    file("design.toml",
         "[cell]\nwidth = \"50 mm\"\nheight = \"50 mm\"\n[layout]\nfamily = \"square\"\ndiameter = \"16 mm\"\nrows = "
         "2\ncolumns = 2\n"
         "[packing]\nmean_diameter = \"0.5044 mm\"\n");
  }
  ~StudyFolder() { std::filesystem::remove_all(path_); }
  StudyFolder(const StudyFolder&) = delete;
  StudyFolder& operator=(const StudyFolder&) = delete;

  std::filesystem::path operator/(const std::string& name) const { return path_ / name; }
  std::filesystem::path file(const std::string& name, const std::string& text) const {
    std::ofstream(path_ / name, std::ios::binary) << text;
    return path_ / name;
  }

 private:
  std::filesystem::path path_;
};

/// A study of two variables whose optimum under fake_evaluation() is known: diameter 17.5 mm, jitter 0.4 mm, in every
/// arm.
inline std::string study_text(const std::string& study_keys, const std::string& arms = "",
                              const std::string& constraints = "") {
  // One replicate a candidate and a search that thinks for no time, unless the study says otherwise: its numbers are
  // formulas.
  const auto says = [&](const std::string& key) {
    return study_keys.starts_with(key) || study_keys.find("\n" + key) != std::string::npos;
  };
  return "[study]\ndesign = \"design.toml\"\nuntil = 0.45\n" + study_keys +
         (says("replicates") ? "" : "\nreplicates = 1") + (says("algorithm") ? "" : "\nalgorithm = \"GN_DIRECT_L\"") +
         "\n[target]\nplateau_stress = \"0.2 MPa\"\n[variables]\n\"layout.diameter\" = [\"14 mm\", \"21 "
         "mm\"]\n\"layout.jitter\" = [0, \"1 mm\"]\n" +
         (arms.empty() ? "" : "[arms]\n" + arms + "\n") +
         (constraints.empty() ? "" : "[constraints]\n" + constraints + "\n");
}

/// A run that reached the strain a request asks for, measured over its window.
inline Evaluation completed(const Request& request) {
  Evaluation evaluation;
  evaluation.status = results::RunStatus::completed;
  evaluation.reason = "reached strain";
  evaluation.replicate = request.replicate;
  evaluation.summary.final_strain = request.strain();
  evaluation.summary.plateau_start = request.design->measures.plateau_start;
  evaluation.summary.plateau_end = request.design->measures.plateau_end;
  evaluation.summary.measured = request.design->measuring_frame().text();
  return evaluation;
}

inline constexpr double best_diameter = 0.0175, best_jitter = 0.0004, fake_target = 0.2e6;

/// Distance from the optimum in units of the bounds, squared.
inline double fake_distance(double diameter, double jitter) {
  return std::pow((diameter - best_diameter) / 0.007, 2) + std::pow((jitter - best_jitter) / 0.001, 2);
}

/// A plateau that misses the target by sqrt(fake_distance) + 0.3 x (number of holes other than 4), relative; replicates
/// scatter by 1 %.
inline Evaluation fake_evaluation(const Request& request) {
  const geometry::LayoutOptions& layout = request.design->layout;
  const double diameter = layout.diameter, jitter = layout.jitter, holes = layout.rows * layout.columns;
  Evaluation evaluation = completed(request);
  const double off = std::sqrt(fake_distance(diameter, jitter)) + 0.3 * std::abs(holes - 4.0);
  evaluation.summary.plateau_stress =
      fake_target * (1.0 + off) * (1.0 + 0.01 * std::sin(1.0 + 2.0 * request.replicate));
  evaluation.summary.target_distance = std::abs(std::log(evaluation.summary.plateau_stress / fake_target));
  evaluation.summary.cap_ratio = 1.0;
  evaluation.summary.undulation = 0.1;
  evaluation.summary.first_peak_stress = 5e5;
  for (int k = 0; k <= 900; ++k) {
    evaluation.curve.strain_yy.push_back(0.0005 * k);
    evaluation.curve.stress_yy.push_back(evaluation.summary.plateau_stress);
  }
  return evaluation;
}

/// The same with a region of diameters in which every run fails: NaN and a status, as a solver gives it.
inline Evaluation fake_with_failures(const Request& request) {
  const double diameter = request.design->layout.diameter;
  if (diameter > 0.0185 && diameter < 0.0200) return failed_evaluation("unstable step", request.replicate);
  return fake_evaluation(request);
}

/// The plan of a study that has ended, every open question answered in each round.
inline Plan search_to_end(Driver& driver, Answers& answers, const Evaluate& evaluate) {
  for (int round = 0; round < 2000; ++round) {
    Plan plan = driver.plan(answers);
    for (const Batch& batch : plan.new_batches) driver.take(batch);
    if (plan.finished) return plan;
    if (plan.wanted.empty() && plan.new_batches.empty()) break;
    for (const Wanted& one : plan.wanted) answers.add(one.key, evaluate(one.request));
  }
  ADD_FAILURE() << "the study did not end";
  return {};
}

inline std::string input_error(const std::function<void()>& code) {
  try {
    code();
  } catch (const io::InputError& error) {
    return error.what();
  }
  ADD_FAILURE() << "no InputError was thrown";
  return {};
}

}  // namespace perfora::optimize
