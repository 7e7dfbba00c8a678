// What is here: the request of one evaluation, its keys and its JSON form. What is not: who carries requests
// (executor.h).
#include "optimize/evaluate/request.h"

#include <algorithm>
#include <array>
#include <boost/uuid/name_generator_sha1.hpp>
#include <boost/uuid/uuid.hpp>
#include <boost/uuid/uuid_io.hpp>
#include <string_view>

#include "io/error.h"
#include "io/text.h"
#include "optimize/evaluate/estimate.h"
#include "optimize/evaluate/material_tests.h"
#include "solver/grade.h"
#include "solver/run_folder.h"

namespace perfora::optimize {

namespace {

using nlohmann::json;

/// Keys, and sections (with a dot behind), of a design that do not change the path of a run.
constexpr std::array<std::string_view, 10> beside_the_path = {
    "measures.",       // read from the finished curve
    "target.",         // wished of it
    "material_test.",  // tests of the solid material
    "loading.until",   // how far: the path up to there is the same
    "output.frames",   // frames and checkpoints have no side effect;
    "output.frame_strains",
    "output.checkpoint_interval",      // history_interval says what the curve holds, and measures are read from it
    "output.curve",                    // of pictures
    "material.characteristic_length",  // of what is printed
    "seeds.search",                    // of the search alone
};

/// SHA-1 of the JSON text, as a name-based identifier (RFC 4122, version 5).
std::string hash(json identity) {
  identity["results_version"] = results_version;
  const boost::uuids::name_generator_sha1 generator(boost::uuids::ns::oid());
  return boost::uuids::to_string(generator(identity.dump()));
}

}  // namespace

bool changes_path(const std::string& key) {
  return std::none_of(beside_the_path.begin(), beside_the_path.end(), [&](std::string_view other) {
    return other.back() == '.' ? key.starts_with(other) : key == other;
  });
}

std::string Request::key() const {
  if (!material_test.empty()) return full_key();
  Design similar = without_places(*design);
  similar.solver = solver::at_grade_one(similar.solver);  // it goes through the same states
  const DesignFile file(similar);
  json path = json::object();
  for (const io::Key& one : file.schema().keys())
    if (!one.at_default() && changes_path(one.full_name()))
      path[file.schema().first_name(one.full_name())] = io::value_text(one.get());
  return hash({{"path", path}, {"replicate", replicate}});
}

std::string Request::full_key() const {
  json all = {{"design", DesignFile(without_places(*design)).schema().changed_toml(io::Names::first)},
              {"replicate", replicate},
              {"until", until}};
  if (!material_test.empty()) all["material_test"] = material_test;
  return hash(std::move(all));
}

json to_json(const Request& request) {
  json record = {{"design", DesignFile(*request.design).schema().to_toml()},
                 {"replicate", request.replicate},
                 {"until", request.until}};
  if (!request.fidelity.empty()) record["fidelity"] = request.fidelity;
  if (!request.material_test.empty()) record["material_test"] = request.material_test;
  if (request.run_file.empty()) return record;
  record["run_file"] = request.run_file.string();
  record["frames"] = request.frames;
  return record;
}

Request request_from_json(const json& record, DesignTexts* known) {
  DesignTexts none;
  const auto text = record.at("design").get<std::string>();
  std::shared_ptr<const Design>& design = (known ? *known : none)[text];
  if (!design) design = std::make_shared<const Design>(DesignFile::from_toml(text, "request").design());
  Request request{design, record.at("replicate").get<int>(), record.at("until").get<double>(), {}};
  request.fidelity = record.value("fidelity", "");
  request.run_file = record.value("run_file", "");
  request.frames = record.value("frames", false);
  request.material_test = record.value("material_test", "");
  return request;
}

Request make_request(const DesignFile& design, int replicate, double until) {
  Request request;
  request.design = std::make_shared<const Design>(design.design());
  request.replicate = replicate;
  request.until = until;
  return request;
}

Evaluation evaluate_request(const Request& request, int threads, const io::Cancellation& cancellation, double memory,
                            const results::ProgressCallback& progress) {
  try {
    DesignFile design = DesignFile::of(*request.design, "request");
    if (!request.material_test.empty())
      return evaluate_material_test(design, material_test_called(request.material_test), request.replicate, threads,
                                    cancellation);
    // No fault of the design: it is tried again once the file is back.
    if (const std::string problem = changed_file(design.design()).problem; !problem.empty())
      throw io::SurroundingsError(problem + "; put the earlier file back");
    if (request.until > 0.0) design.schema().set_number("loading.until", request.until, {"request", 0, "until"});
    design.require_valid();
    if (const std::string problem = memory > 0.0 ? memory_problem(design, memory) : std::string(); !problem.empty())
      throw io::SurroundingsError(problem + "; fewer --workers leave each more, --memory SIZE allows more");
    EvaluateOptions options;
    options.threads = threads;
    options.cancellation = cancellation;
    options.progress = progress;
    options.run_file = request.run_file;
    options.resume = !request.run_file.empty();
    if (request.frames) design.design().solver.output.frames = solver::FrameChoice::few;
    if (request.run_file.empty()) return evaluate_design(design, options, request.replicate);
    try {
      return evaluate_design(design, options, request.replicate);
    } catch (const io::InputError&) {
      // Begun by another program or on another instruction set: begun again. What is wrong with the design is said
      // then.
      std::filesystem::remove(request.run_file);
      std::filesystem::remove_all(solver::RunFolder(request.run_file).path());
      options.resume = false;
      return evaluate_design(design, options, request.replicate);
    }
  } catch (const io::InputError& error) {
    return failed_evaluation(error.what(), request.replicate);
  }
}

}  // namespace perfora::optimize
