// What is here: what the process that asks costs an evaluation, all stages of a study together: answers that take no
// time are written to journal and histories, and the next requests are made. Prints one JSON object a size. What is
// not: evaluations (run_all.py), the way between processes.
// Usage: bench_coordinator FOLDER [algorithm, "sobol"] [evaluations at once, 1000] [evaluations...]
// FOLDER must not exist and lies on the disk that is measured.
#include <fmt/format.h>

#include <chrono>
#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <fstream>

#include "io/progress.h"
#include "optimize/search/study_run.h"
#include "results/json.h"

namespace perfora::benchmarks {
namespace {

namespace fs = std::filesystem;
using Clock = std::chrono::steady_clock;

/// An evaluation as long as a real one to 60 % strain, of a curve that depends on the diameter.
optimize::Evaluation made_up(const optimize::Request& request) {
  optimize::Evaluation evaluation;
  evaluation.status = results::RunStatus::completed;
  evaluation.reason = "reached strain";
  evaluation.replicate = request.replicate;
  evaluation.summary.final_strain = request.strain();
  evaluation.summary.plateau_start = request.design->measures.plateau_start;
  evaluation.summary.plateau_end = request.design->measures.plateau_end;
  evaluation.summary.measured = request.design->measuring_frame().text();
  evaluation.summary.plateau_stress =
      1e5 * (1.0 + 50.0 * request.design->layout.diameter) * (1.0 + 0.01 * std::sin(1.0 + 2.0 * request.replicate));
  evaluation.summary.target_distance = std::abs(std::log(evaluation.summary.plateau_stress / 2e5));
  evaluation.summary.cap_ratio = 2.0;
  for (int k = 0; k <= 1200; ++k) {
    evaluation.curve.strain_yy.push_back(0.0005 * k);
    evaluation.curve.stress_yy.push_back(evaluation.summary.plateau_stress * (1.0 + 0.3 * std::sin(0.37 * k)));
  }
  return evaluation;
}

void measure(const fs::path& folder, const std::string& algorithm, int at_once, int evaluations) {
  fs::create_directories(folder);
  std::ofstream(folder / "design.toml")
      << "[cell]\nwidth = \"50 mm\"\nheight = \"50 mm\"\n[layout]\nfamily = \"square\"\ndiameter = \"16 mm\"\n"
         "rows = 2\ncolumns = 2\n";
  constexpr int replicates = 4;
  const int together = std::min(at_once, evaluations);
  std::ofstream(folder / "study.toml")
      << "[study]\ndesign = \"design.toml\"\nalgorithm = \"" << algorithm << "\"\nreplicates = " << replicates
      << "\nmaxeval = " << evaluations / replicates << "\nbatch = " << together / replicates
      << "\nfinal_replicates = 0\n[target]\nplateau_stress = \"0.2 MPa\"\n[variables]\n"
         "\"layout.diameter\" = [\"10 mm\", \"20 mm\"]\n\"layout.jitter\" = [0, \"1 mm\"]\n";
  std::int64_t sent = 0, given = 0, messages = 0;
  optimize::WorkOptions options;
  options.folder = folder / "work";
  options.line_an_answer = false;
  options.make_executor = [&] {
    return optimize::make_calling_executor([&](const optimize::Request& request) {
      const optimize::Evaluation made = made_up(request);
      sent += static_cast<std::int64_t>(to_json(request).dump().size());
      given += static_cast<std::int64_t>(results::to_json(made, true).dump().size());
      ++messages;
      return made;
    });
  };
  const auto start = Clock::now();
  optimize::StudyRun run(optimize::read_study(folder / "study.toml"), options);
  run.run();
  const double seconds = std::chrono::duration<double>(Clock::now() - start).count();
  std::int64_t stored = 0;
  for (const auto& entry : fs::recursive_directory_iterator(folder / "work"))
    if (entry.is_regular_file()) stored += static_cast<std::int64_t>(entry.file_size());
  fmt::print(R"({{"evaluations": {}, "together": {}, "seconds": {:.3f}, "ms_an_answer": {:.3f}, "request_bytes": {}, )"
             R"("answer_bytes": {}, "stored_bytes_an_answer": {}}})"
             "\n",
             messages, together, seconds, 1e3 * seconds / static_cast<double>(messages), sent / messages,
             given / messages, stored / messages);
  std::fflush(stdout);
}

}  // namespace
}  // namespace perfora::benchmarks

int main(int argc, char** argv) {
  namespace fs = std::filesystem;
  if (argc < 2 || fs::exists(argv[1])) {
    fmt::print(stderr, "usage: bench_coordinator NEW_FOLDER [algorithm] [evaluations at once] [evaluations...]\n");
    return 1;
  }
  perfora::io::set_verbosity(perfora::io::Verbosity::quiet);
  const std::string algorithm = argc > 2 ? argv[2] : "sobol";
  const int at_once = argc > 3 ? std::atoi(argv[3]) : 1000;
  std::vector<int> sizes;
  for (int k = 4; k < argc; ++k) sizes.push_back(std::atoi(argv[k]));
  if (sizes.empty()) sizes = {100, 1000, 4000};
  for (const int evaluations : sizes)
    perfora::benchmarks::measure(fs::path(argv[1]) / std::to_string(evaluations), algorithm, at_once, evaluations);
  return 0;
}
