// What is here: one evaluation for users of the library. What is not: its way (optimize/evaluate/evaluation.cpp).
#include "perfora/evaluate.h"

#include "io/memory.h"
#include "optimize/evaluate/run_output.h"
#include "perfora/inside.h"

namespace perfora {

Evaluation evaluate(const Design& design, const EvaluateOptions& options) {
  return at_boundary([&] {
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

}  // namespace perfora
