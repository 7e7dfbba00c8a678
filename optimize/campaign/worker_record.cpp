// What is here: the record of a worker. What is not: requests (request.h).
#include "optimize/campaign/worker_record.h"

#include <algorithm>
#include <cmath>
#include <exception>
#include <new>
#include <stdexcept>

#include "io/error.h"
#include "results/json.h"

namespace perfora::optimize {
namespace {

WorkerRecord worker_trouble(const std::string& text) {
  return {{{"trouble", text}}};
}

}  // namespace

WorkerRecord evaluate_record(const nlohmann::json& request, int threads, const io::Cancellation& cancellation,
                             double memory, const results::ProgressCallback& progress) {
  try {
    const Evaluation evaluation = evaluate_request(request_from_json(request), threads, cancellation, memory, progress);
    return {results::to_json(evaluation, true), evaluation.status == results::RunStatus::stopped};
  } catch (const io::InputError& error) {
    return {results::to_json(failed_evaluation(error.what(), request.at("replicate").get<int>()), true)};
  } catch (const io::Cancelled&) {
    return {worker_trouble("stopped").record, true};
  } catch (const std::bad_alloc&) {
    return worker_trouble("the worker ran out of memory");
  } catch (const std::exception& error) {
    return worker_trouble(error.what());
  }
}

nlohmann::json sign_of_life(const results::Progress& progress) {
  nlohmann::json sign = {{"alive", true}};
  if (!progress.text.empty()) {
    // The packing comes first and takes next to no time: the fraction is that of the compression.
    sign["fraction"] = std::isnan(progress.strain) ? 0.0 : progress.fraction;
    sign["text"] = progress.text;
  }
  return sign;
}

bool is_sign_of_life(const nlohmann::json& record) {
  return record.is_object() && record.contains("alive");
}

results::Progress told_by(const nlohmann::json& sign) {
  results::Progress progress;
  const auto fraction = sign.find("fraction"), text = sign.find("text");
  if (fraction == sign.end() || text == sign.end() || !fraction->is_number() || !text->is_string()) return progress;
  progress.fraction = std::clamp(fraction->get<double>(), 0.0, 1.0);
  progress.text = text->get<std::string>();
  return progress;
}

void take_record(const nlohmann::json& record, Answer& answer) {
  if (!record.is_object()) throw std::runtime_error("no JSON object");
  if (record.contains("trouble"))
    answer.trouble = record.at("trouble").get<std::string>();
  else
    answer.evaluation = results::evaluation_from_json(record);
}

}  // namespace perfora::optimize
