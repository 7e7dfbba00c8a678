// What is here: the keys of carrying out. What is not: their use (evaluation_queue.cpp, executor_children.cpp).
#include "optimize/campaign/execution.h"

#include "io/error.h"

namespace perfora::optimize {

void describe(io::Section section, ExecutionKeys& keys) {
  constexpr int most_attempts = 100;
  section.integer("workers", keys.workers, io::Range::non_negative(), "Evaluations at once; 0: one a processor")
      .choice(
          "on_trouble", keys.on_trouble,
          {{"retry", OnTrouble::retry}, {"stop", OnTrouble::stop}, {"skip", OnTrouble::skip}},
          "When a worker is killed, the disk full, ... (no result of a design): try again up to `attempts` times and "
          "then stop, stop at once, or go on without that evaluation (sweeps only); --resume tries it again")
      .integer("attempts", keys.attempts, io::Range::between(1, most_attempts),
               "How often an evaluation is tried in all when the surroundings fail")
      .real(
          "time_limit", keys.time_limit, io::Dimension::time, io::Range::non_negative(),
          "Wall time of an evaluation after which its worker is replaced; 0: a minute more than 20 times its estimate");
}

bool is_execution_key(const std::string& name) {
  ExecutionKeys keys;
  io::Schema schema;
  describe(schema.section("execution", ""), keys);
  return schema.find("execution." + name) != nullptr;
}

void refuse_skip(const ExecutionKeys& keys, const io::Origin& origin) {
  if (keys.on_trouble == OnTrouble::skip)
    throw io::InputError(origin, "\"skip\" leaves a point without a number, and a search needs one at each",
                         "\"retry\" or \"stop\" here, \"skip\" in sweeps", "");
}

}  // namespace perfora::optimize
