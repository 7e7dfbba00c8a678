// What is here: one evaluation for users of the library. What is not: its way (optimize/evaluate/evaluation.cpp).
#include "perfora/evaluate.h"

#include <fmt/format.h>

#include "io/memory.h"
#include "io/text.h"
#include "optimize/evaluate/run_output.h"
#include "optimize/search/objective.h"
#include "perfora/inside.h"
#include "results/measured_anew.h"

namespace perfora {

Evaluation evaluate(const Design& design, const EvaluateOptions& options) {
  return at_boundary([&] {
    refuse_negative(options.replicate);
    refuse_resume_with_force(options.resume, options.force);
    const optimize::DesignFile file = Inside::file(design).clone();
    ProgressRelay relay(options.progress, options.stop);
    optimize::EvaluateOptions work;
    work.threads = thread_count(options.threads);
    work.run_file = options.run_file;
    work.packing_file = options.packing_file;
    work.resume = options.resume;
    work.wall_time_limit = options.wall_time;
    work.cancellation = relay.token();
    work.progress = relay.callback();
    optimize::PreparedEvaluation prepared =
        optimize::prepare_evaluation(file, work, options.replicate, options.force,
                                     options.memory > 0.0 ? options.memory : io::usable_memory_bytes());
    const results::Evaluation found = optimize::evaluate_design(file, work, options.replicate);
    relay.rethrow();
    Evaluation made = public_evaluation(found, optimize::evaluation_record(file, found));
    for (std::string& warning : optimize::validity_warnings(found, file.design().solver.loading))
      prepared.warnings.push_back(std::move(warning));
    made.warnings = std::move(prepared.warnings);
    return made;
  });
}

double score(const Design& design, const std::vector<Evaluation>& replicates) {
  return at_boundary([&] {
    const optimize::Design& wishing = Inside::file(design).design();
    if (!results::is_given(wishing.target))
      throw io::InputError({"score", 0, "target"}, "nothing is wished", "a plateau stress, a curve, limits or weights",
                           "set target.plateau_stress of the design");
    if (replicates.empty())
      throw io::InputError({"score", 0, "replicates"}, "there is no evaluation", "", "give one or more");
    std::vector<results::Evaluation> measured;
    const results::MeasuringFrame frame = wishing.measuring_frame();
    for (const Evaluation& replicate : replicates) {
      const results::Evaluation& all = Inside::evaluation(replicate);
      if (all.status == results::RunStatus::completed && frame.options.plateau == results::PlateauPlace::window &&
          all.summary.final_strain < frame.options.plateau_end - results::strain_rounding)
        throw io::InputError({"score", 0, "measures.plateau_end"},
                             fmt::format("the curve ends at {} strain, before the window does at {}",
                                         io::quantity(all.summary.final_strain, io::Dimension::ratio),
                                         io::quantity(frame.options.plateau_end, io::Dimension::ratio)),
                             "", "set target.window of the design, or evaluate further (loading.until)");
      measured.push_back(results::measured_anew(all, frame, all.summary.final_strain).value_or(all));
    }
    std::vector<const results::Evaluation*> pointers;
    for (const results::Evaluation& one : measured) pointers.push_back(&one);
    return optimize::score_of(wishing.target, pointers).value;
  });
}

}  // namespace perfora
