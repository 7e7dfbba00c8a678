// What is here: the request of one evaluation: the design that is run, replicate and strain; its key, its JSON form,
// its evaluation. What is not: which requests there are (study, sweep), who carries them (executor.h).
#pragma once

#include <filesystem>
#include <map>
#include <memory>
#include <nlohmann/json.hpp>
#include <string>

#include "io/cancellation.h"
#include "optimize/evaluate/evaluation.h"
#include "optimize/evaluate/fidelity.h"

namespace perfora::optimize {

/// One request. The design is shared and never changed; it becomes text only where a request leaves the process
/// (message to a worker, line of a journal).
struct Request {
  std::shared_ptr<const Design> design;  ///< resolved: the fidelity's changes are made
  int replicate = 0;
  double until = 0.0;    ///< engineering strain; 0: as the design says
  std::string fidelity;  ///< its name; "" where there is one only. No part of the key
  /// Where the run is written, and resumed from when it is there (finished or not) with the same instruction set;
  /// empty: nowhere. No part of the key.
  std::filesystem::path run_file = {};
  bool frames = false;  ///< few frames in the run file; otherwise none. No part of the key
  /// "tension", ...: this test of the design's solid material instead of a compression (material_tests.h); "": none.
  std::string material_test = {};

  /// Engineering strain that the run is to reach.
  double strain() const { return until > 0.0 ? until : design->solver.loading.until; }
  /// Hash over what changes the path of the run: the design's keys that are not at their defaults (but those of
  /// changes_path()), replicate and results_version. A key that the program learns later leaves it as it is. How far
  /// the run goes, what is read from its curve and the grade of the material are no part of it (answers.h).
  std::string key() const;
  /// Hash over everything that is asked, strain, window and output included: names the run's file, since a run file
  /// holds all of it.
  std::string full_key() const;
};

/// Whether a key of the design ("measures.plateau_end") changes the path of a run: what happens up to a strain.
bool changes_path(const std::string& key);

/// The request for one replicate of a design; `until` = 0: as far as the design says.
Request make_request(const DesignFile& design, int replicate, double until = 0.0);

/// {"design": TOML text, "replicate", "until"}, with "fidelity" and "material_test" where they have a name, "run_file"
/// and "frames" where a run file is wanted.
nlohmann::json to_json(const Request& request);
/// Designs by their text.
using DesignTexts = std::map<std::string, std::shared_ptr<const Design>>;
/// Throws io::InputError when the text is no design of this program. With `known`, a text that stands there is not read
/// again, and one that does not is added.
Request request_from_json(const nlohmann::json& record, DesignTexts* known = nullptr);

/// Evaluates a request (used by in-process and child-process executors alike). A design that cannot be evaluated is an
/// Evaluation with status `failed` and the reason, so that a search goes on. One that would take more than `memory`
/// bytes (0: no limit) throws io::SurroundingsError: on a larger machine it is an evaluation like any other. `progress`
/// may be empty; of material tests nothing is told.
Evaluation evaluate_request(const Request& request, int threads, const io::Cancellation& cancellation = {},
                            double memory = 0.0, const results::ProgressCallback& progress = {});

}  // namespace perfora::optimize
