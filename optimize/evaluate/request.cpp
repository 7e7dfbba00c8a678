// What is here: the request of one evaluation, its key and its JSON form. What is not: who carries requests
// (executor.h).
#include <boost/uuid/name_generator_sha1.hpp>
#include <boost/uuid/uuid.hpp>
#include <boost/uuid/uuid_io.hpp>

#include "optimize/evaluate/evaluation.h"

namespace perfora::optimize {

namespace {

/// What is asked of a design, whatever keys the program that wrote it down knew; text that is no design as it is.
std::string identity_of(const std::string& design_toml) {
  try {
    return DesignFile::from_toml(design_toml, "request").schema().changed_toml();
  } catch (const io::InputError&) {
    return design_toml;
  }
}

}  // namespace

std::string Request::key() const {
  // SHA-1 of the JSON text, as a name-based identifier (RFC 4122, version 5).
  nlohmann::json identity = to_json(Request{identity_of(design_toml), replicate, until});
  identity["results_version"] = results_version;
  const boost::uuids::name_generator_sha1 generator(boost::uuids::ns::oid());
  return boost::uuids::to_string(generator(identity.dump()));
}

nlohmann::json to_json(const Request& request) {
  nlohmann::json record = {{"design", request.design_toml}, {"replicate", request.replicate}, {"until", request.until}};
  if (request.run_file.empty()) return record;
  record["run_file"] = request.run_file.string();
  record["frames"] = request.frames;
  return record;
}

Request request_from_json(const nlohmann::json& record) {
  return {record.at("design").get<std::string>(), record.at("replicate").get<int>(), record.at("until").get<double>(),
          record.value("run_file", ""), record.value("frames", false)};
}

Request make_request(const DesignFile& design, int replicate, double until) {
  return {design.schema().to_toml(), replicate, until};
}

void drop_output(Design& design) {
  design.solver.output.frames = solver::FrameChoice::none;
  design.solver.output.frame_strains.clear();
  design.solver.output.checkpoint_interval = solver::OutputOptions{}.checkpoint_interval;
}

Evaluation evaluate_request(const Request& request, int threads, const io::Cancellation& cancellation) {
  try {
    DesignFile design = DesignFile::from_toml(request.design_toml, "request");
    if (request.until > 0.0) design.schema().set_number("loading.until", request.until, {"request", 0, "until"});
    static_cast<void>(design.validate());
    EvaluateOptions options;
    options.threads = threads;
    options.cancellation = cancellation;
    options.run_file = request.run_file;
    options.resume = !request.run_file.empty();
    if (request.frames) design.design().solver.output.frames = solver::FrameChoice::few;
    if (request.run_file.empty()) return evaluate_design(design, options, request.replicate);
    try {
      return evaluate_design(design, options, request.replicate);
    } catch (const io::InputError&) {
      // Begun by another program or on another instruction set: begun again. What is wrong with the design is said
      // then.
      std::filesystem::path unfinished = request.run_file;
      std::filesystem::remove(unfinished);
      std::filesystem::remove_all(unfinished.replace_extension(".part"));
      options.resume = false;
      return evaluate_design(design, options, request.replicate);
    }
  } catch (const io::InputError& error) {
    return failed_evaluation(error.what(), request.replicate);
  }
}

}  // namespace perfora::optimize
