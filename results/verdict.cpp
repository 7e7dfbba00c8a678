// What is here: outcomes and their words. What is not: the intervals (interval.cpp).
#include "results/verdict.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "io/text.h"
#include "results/assurance.h"
#include "results/json.h"
#include "results/statistic.h"
#include "results/wish_record.h"

namespace perfora::results {
namespace {

using nlohmann::json;

/// From here on a miss is told as a factor, below it in percent.
constexpr double told_as_factor = 2.0;

bool within(const Wish& wish, const Interval& interval) {
  return wish.low <= interval.low && interval.high <= wish.high;
}

bool outside(const Wish& wish, const Interval& interval) {
  return interval.high < wish.low || interval.low > wish.high;
}

/// "69 % too low", "7.1 times too high"; empty for a value that keeps the wish.
std::string miss_text(const Wish& wish, double value) {
  const bool low = value < wish.low;
  if (!low && !(value > wish.high)) return {};
  const double bound = low ? wish.low : wish.high;
  if (!(value > 0.0) || !(bound > 0.0)) return low ? "too low" : "too high";
  const double factor = low ? bound / value : value / bound;
  if (factor >= told_as_factor) return fmt::format("a factor of {} too {}", io::number(factor), low ? "low" : "high");
  return fmt::format("{} too {}", io::quantity(std::abs(value / bound - 1.0), io::Dimension::ratio),
                     low ? "low" : "high");
}

std::string wish_text(const WishVerdict& one) {
  const io::Dimension dimension = one.wish.measure->dimension;
  std::string text = name_of(*one.wish.measure) + " ";
  text += one.count > 0 ? io::quantity(one.mean, dimension) : std::string("not reached in any block");
  if (std::isfinite(one.interval.low) && !one.wish.measure->of_packing())
    text += fmt::format(" (95 %: {})", io::quantities({one.interval.low, one.interval.high}, dimension, " to "));
  text += ", wished " + range_text(one.wish);
  const std::string miss = one.count > 0 ? miss_text(one.wish, one.mean) : "";
  if (!miss.empty()) text += ": " + miss;
  if (one.missing > 0 && one.count > 0)
    text += fmt::format("; not reached in {} of {} blocks", one.missing, one.missing + one.count);
  return text;
}

Outcome outcome_of(const WishVerdict& one, const std::vector<double>& values, Statement statement, double fraction,
                   Interval& interval) {
  const auto [least, most] = std::minmax_element(values.begin(), values.end());
  if (one.wish.measure->of_packing()) {
    if (values.empty()) return Outcome::not_shown;
    interval = {*least, *most};
    return within(one.wish, interval) ? Outcome::met : Outcome::missed;
  }
  if (one.missing >= fewest_replicates && one.missing >= one.count) return Outcome::missed;
  if (values.size() < 2) return Outcome::not_shown;
  const Interval mean = mean_interval(values);
  interval = statement == Statement::mean ? mean : block_interval(values, fraction);
  if (one.count < fewest_replicates) return Outcome::not_shown;
  if (outside(one.wish, mean)) return Outcome::missed;
  return one.missing == 0 && within(one.wish, interval) ? Outcome::met : Outcome::not_shown;
}

WishVerdict judge(const Wish& wish, std::span<const Evaluation* const> replicates, const Target& target,
                  std::span<const Reach> reach) {
  WishVerdict one;
  one.wish = wish;
  std::vector<double> values;
  for (const Evaluation* evaluation : replicates) {
    if (evaluation->status != RunStatus::completed) continue;
    const double value = wished_value(*wish.measure, *evaluation);
    if (std::isnan(value))
      ++one.missing;
    else
      values.push_back(value);
  }
  one.count = static_cast<int>(values.size());
  one.mean = wish.measure->of_packing() && std::isinf(values.empty() ? 0.0 : values.front())
                 ? values.front()
                 : statistic_of({}, values).mean;
  one.outcome = outcome_of(one, values, target.statement, target.fraction, one.interval);
  one.text = wish_text(one);
  for (const Reach& tried : reach)
    if (tried.measure == wish.measure && one.outcome == Outcome::missed && tried.candidates >= fewest_tried &&
        outside(wish, {tried.low, tried.high})) {
      one.outcome = Outcome::out_of_reach;
      one.text += fmt::format("; the {} designs tried gave {}", tried.candidates,
                              io::quantities({tried.low, tried.high}, wish.measure->dimension, " to "));
    }
  return one;
}

bool any(const Verdict& verdict, Outcome outcome) {
  return std::any_of(verdict.wishes.begin(), verdict.wishes.end(),
                     [&](const WishVerdict& one) { return one.outcome == outcome; });
}

Outcome overall(const Verdict& verdict) {
  if (any(verdict, Outcome::out_of_reach)) return Outcome::out_of_reach;
  if (any(verdict, Outcome::missed)) return Outcome::missed;
  const bool counts = verdict.fresh && verdict.failed == 0 && verdict.replicates > 0;
  return counts && !any(verdict, Outcome::not_shown) ? Outcome::met : Outcome::not_shown;
}

/// Of single blocks each wish is shown by itself: blocks that keep one need not be those that keep another.
std::string subject_text(const Verdict& verdict) {
  if (verdict.statement == Statement::mean) return "for the mean of blocks";
  return fmt::format("{}for {} of single blocks", verdict.wishes.size() > 1 ? "each " : "",
                     io::quantity(verdict.fraction, io::Dimension::ratio));
}

std::string seeds_text(const Verdict& verdict) {
  return fmt::format("{} {}seed{}", verdict.replicates, verdict.fresh ? "" : "search ",
                     verdict.replicates == 1 ? "" : "s");
}

/// Whether inertia holds up more of the plateau than a claim allows.
bool lifted_by_rate(const Verdict& verdict) {
  return std::isfinite(verdict.impact_ratio) && verdict.impact_ratio > honest_impact_ratio;
}

std::string head_of(const Verdict& verdict) {
  switch (verdict.outcome) {
    case Outcome::met:
      return fmt::format("met{}: {}, {} with 95 % confidence ({})",
                         lifted_by_rate(verdict) ? fmt::format(" at this rate (impact stress is {} of the plateau)",
                                                               io::quantity(verdict.impact_ratio, io::Dimension::ratio))
                                                 : "",
                         verdict.wishes.size() == 1 ? "the wish" : fmt::format("all {} wishes", verdict.wishes.size()),
                         subject_text(verdict), seeds_text(verdict));
    case Outcome::missed:
      return "missed";
    case Outcome::out_of_reach:
      return "out of reach";
    case Outcome::not_shown:
      break;
  }
  std::string text = fmt::format("not shown with {}", seeds_text(verdict));
  if (verdict.failed > 0) text += fmt::format(" ({} failed)", verdict.failed);
  return text;
}

/// The outcome, then the wishes that decide it.
std::string text_of(const Verdict& verdict) {
  std::string text = head_of(verdict);
  std::string between = ": ";
  for (const WishVerdict& one : verdict.wishes) {
    const bool decides =
        one.outcome == verdict.outcome || (verdict.outcome == Outcome::out_of_reach && one.outcome == Outcome::missed);
    if (verdict.outcome != Outcome::met && !decides) continue;
    text += (verdict.outcome == Outcome::met ? "; " : between) + one.text;
    between = "; ";
  }
  if (verdict.outcome == Outcome::not_shown && !any(verdict, Outcome::not_shown) && !verdict.fresh)
    text += ": the wishes are kept on the seeds that chose the design, which flatter it";
  return text;
}

std::string note_of(const Verdict& verdict) {
  std::string text = "the model is plane and without creep";
  if (verdict.largest_overlap > small_overlap)
    text = fmt::format("discs overlap by up to {} of <d> ({} is small); {}",
                       io::quantity(verdict.largest_overlap, io::Dimension::ratio),
                       io::quantity(small_overlap, io::Dimension::ratio), text);
  if (!std::isfinite(verdict.impact_ratio)) return text;
  const std::string ratio = io::quantity(verdict.impact_ratio, io::Dimension::ratio);
  return lifted_by_rate(verdict)
             ? fmt::format("loaded fast: impact stress is {} of the plateau (10 % for claims), which lifts it; {}",
                           ratio, text)
             : fmt::format("impact stress is {} of the plateau; {}", ratio, text);
}

}  // namespace

const char* outcome_name(Outcome outcome) {
  switch (outcome) {
    case Outcome::met:
      return "met";
    case Outcome::missed:
      return "missed";
    case Outcome::not_shown:
      return "not shown";
    case Outcome::out_of_reach:
      break;
  }
  return "out of reach";
}

Verdict verdict_on(const Target& target, std::span<const Evaluation* const> replicates, bool fresh,
                   std::span<const Reach> reach) {
  Verdict verdict;
  verdict.statement = target.statement;
  verdict.fraction = target.fraction;
  verdict.fresh = fresh;
  verdict.replicates = static_cast<int>(replicates.size());
  std::vector<double> impact;
  double window_end = 0.0;
  for (const Evaluation* evaluation : replicates) {
    window_end = std::max(window_end, evaluation->summary.plateau_end);  // a NaN is passed over
    verdict.failed += evaluation->status != RunStatus::completed;
    impact.push_back(evaluation->summary.impact_ratio);
    verdict.largest_overlap = std::max(verdict.largest_overlap, evaluation->summary.max_overlap_in_run);
  }
  verdict.impact_ratio = statistic_of({}, impact).mean;
  for (const Wish& wish : wishes(target)) verdict.wishes.push_back(judge(wish, replicates, target, reach));
  verdict.caps = stress_caps(target, window_end);
  verdict.outcome = overall(verdict);
  verdict.text = text_of(verdict);
  verdict.note = note_of(verdict);
  return verdict;
}

json to_json(const Verdict& verdict) {
  json list = json::array();
  for (const WishVerdict& one : verdict.wishes) {
    json& added = list.emplace_back(to_json(one.wish));
    added.update({{"outcome", outcome_name(one.outcome)},
                  {"count", one.count},
                  {"missing", one.missing},
                  {"mean", number(one.mean)},
                  {"interval", {number(one.interval.low), number(one.interval.high)}},
                  {"text", one.text}});
  }
  return {{"outcome", outcome_name(verdict.outcome)},
          {"text", verdict.text},
          {"statement", verdict.statement == Statement::mean ? "mean" : "block"},
          {"fraction", verdict.statement == Statement::mean ? json(nullptr) : json(verdict.fraction)},
          {"confidence", confidence},
          {"replicates", verdict.replicates},
          {"failed", verdict.failed},
          {"fresh_seeds", verdict.fresh},
          {"impact_ratio", number(verdict.impact_ratio)},
          {"largest_overlap", number(verdict.largest_overlap)},
          {"note", verdict.note},
          {"caps", to_json(verdict.caps)},
          {"wishes", list}};
}

}  // namespace perfora::results
