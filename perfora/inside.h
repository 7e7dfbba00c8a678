// What is here: what the sources of this room share: the content of a design, results of the rooms turned into public
// ones, errors and progress at the boundary. Not installed. What is not: anything a user of the library sees.
#pragma once

#include <chrono>
#include <exception>
#include <filesystem>
#include <functional>
#include <memory>
#include <mutex>
#include <nlohmann/json.hpp>
#include <string>
#include <utility>
#include <vector>

#include "io/cancellation.h"
#include "io/error.h"
#include "io/progress.h"
#include "optimize/campaign/evaluation_queue.h"
#include "optimize/evaluate/design.h"
#include "perfora/design.h"
#include "perfora/evaluate.h"
#include "perfora/pack.h"
#include "perfora/results.h"
#include "results/evaluation.h"
#include "results/progress.h"
#include "results/run_file.h"

namespace perfora {

struct Design::Content {
  optimize::DesignFile file;
};

struct Stop::Content {
  io::CancellationSource source;
};

struct Evaluation::Content {
  results::Evaluation all;
};

/// Opens designs to the sources of this room.
struct Inside {
  static const optimize::DesignFile& file(const Design& design) { return design.content_->file; }
  static optimize::DesignFile& file(Design& design) { return design.content_->file; }
  static Design design(optimize::DesignFile file);
  static io::CancellationSource& source(Stop& stop);
  static const results::Evaluation& evaluation(const Evaluation& evaluation);
  static Evaluation with_content(Evaluation evaluation, const results::Evaluation& all);
};

/// Messages name what a user of the program types; a user of the library has options of the same names: "--resume" is
/// `resume`, and folders are not named "with -o".
std::string in_words_of_the_library(std::string message);

/// Does `work`; what the rooms throw about something given to them comes out as Error, what they throw about the
/// surroundings as SurroundingsError. The library prints nothing but warnings.
template <class Work>
auto at_boundary(Work&& work) {
  io::set_verbosity(io::Verbosity::quiet);
  try {
    return std::forward<Work>(work)();
  } catch (const io::InputError& error) {
    throw Error(in_words_of_the_library(error.what()));
  } catch (const io::SurroundingsError& error) {
    throw SurroundingsError(in_words_of_the_library(error.what()));
  } catch (const std::filesystem::filesystem_error& error) {
    throw SurroundingsError(error.what());
  } catch (const nlohmann::json::exception& error) {
    throw Error(std::string("damaged record: ") + error.what());
  }
}

/// A user's callback as the rooms take it; its answer becomes a request to stop.
class ProgressRelay {
 public:
  /// `stop` may be null; otherwise it is what a callback that answers false requests.
  ProgressRelay(ProgressCallback callback, std::shared_ptr<Stop> stop);

  /// Empty when the user gave none.
  results::ProgressCallback callback();
  std::function<void(const optimize::WorkProgress&)> work_callback(const std::string& kind);
  io::Cancellation token() const { return Inside::source(*stop_).token(); }
  /// Throws what the user's callback threw.
  void rethrow() const;

 private:
  using Clock = std::chrono::steady_clock;
  void tell(Progress progress);

  ProgressCallback callback_;
  std::shared_ptr<Stop> stop_;
  std::mutex mutex_;
  std::exception_ptr thrown_;
  Clock::time_point begun_, part_begun_;
  double first_ = 0.0, last_ = -1.0;  ///< fractions of the part of the work that is under way; last_ < 0: none
};

/// Throws io::InputError for a replicate below 0.
void refuse_negative(int replicate);
/// Throws io::InputError when both are wanted.
void refuse_resume_with_force(bool resume, bool force);
/// `threads`, or one a processor.
int thread_count(int threads);

Status status_of(results::RunStatus status);
Discs discs_of(const geometry::Packing& packing);
/// Rims of the openings as polygons.
std::vector<Outline> outlines_of(const geometry::PerforationLayout& layout);
/// The measures of the packing alone.
std::vector<Measure> measures_of(const results::PackSummary& pack);
/// The history's columns for people as a table.
Table table_of(const results::History& history);
Run public_run(const results::RunResult& found);
/// The verdict that a record holds; empty texts where it holds none.
Verdict verdict_in(const nlohmann::json& record);
/// `record`: perfora.evaluate/1 of the evaluation.
Evaluation public_evaluation(const results::Evaluation& evaluation, const nlohmann::json& record);

}  // namespace perfora
