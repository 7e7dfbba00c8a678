// What is here: all that is learnt from evaluated designs for one target: whether runs succeed, how a design fails, its
// curve, the measures that a target names; and whether the model deserves trust. What is not: what it says of the
// target (target_answers.h), searching.
#pragma once

#include <optional>
#include <span>
#include <string>
#include <vector>

#include "optimize/model/classifier.h"
#include "optimize/model/features.h"
#include "optimize/model/noise_model.h"
#include "optimize/model/response_curves.h"
#include "results/evaluation.h"
#include "results/target.h"

namespace perfora::model {

/// One design at one fidelity with what is known of it.
struct KnownDesign {
  Traits traits;
  int fidelity = 0;                                    ///< 0: the one that answers are for
  int design = 0;                                      ///< the same at every fidelity of one design
  std::vector<const results::Evaluation*> replicates;  ///< failed ones included; measured by the target's frame
};

/// What is modelled of a measure: its logarithm, or itself.
enum class Scale { logarithm, plain };

/// One response with its process and the scatter of single blocks.
struct Response {
  std::string name;                           ///< "curve 1", "roughness", or the key of a measure
  const results::Measure* measure = nullptr;  ///< nullptr: a component of the curve, or the roughness
  Scale scale = Scale::plain;
  GaussianProcess process;
  NoiseModel noise;
  /// Standard deviation of a single block about the mean of its design.
  double scatter(const Inputs& one) const;
};

/// Share of designs that, left out, lay within the 95 % interval that the others gave for them, over all responses.
struct Coverage {
  int inside = 0, count = 0;
  double share() const { return count > 0 ? static_cast<double>(inside) / count : 0.0; }
  /// From 85 to 98 %. More is held against it only where it is not by chance: where so few outside would be seen with a
  /// probability below 5 % were the coverage 98 %.
  bool trusted() const;
};

class ResponseModel {
 public:
  /// Fewer designs with a usable curve teach nothing.
  static constexpr int fewest_designs = 8;

  /// `known` in an order of its own (candidate_store.h); `frame`: what the evaluations were measured by.
  ResponseModel(std::span<const KnownDesign> known, const results::Target& target, const results::MeasuringFrame& frame,
                const Minimiser& minimiser);

  /// Whether there was enough to learn from; nothing below but success() may be asked otherwise.
  bool made() const { return !responses_.empty(); }
  /// made(), and left-out designs lie where it said: the search may go by it.
  bool trusted() const { return made() && coverage_.trusted(); }
  const Coverage& coverage() const { return coverage_; }
  /// "leave-one-design-out coverage of 95 % intervals: 94.1 % (64 of 68)", or what is missing.
  std::string in_words() const;

  Inputs inputs_of(const Traits& traits, int fidelity = 0) const;
  double success(const Inputs& one) const;  ///< probability that its runs end with a plateau
  /// Probability that it fails by a front and not throughout; nothing where too few designs do either.
  std::optional<double> front(const Inputs& one) const;

  const Features& features() const { return features_; }
  const CurveBasis& curves() const { return curves_; }
  const std::vector<Response>& responses() const { return responses_; }
  int components() const { return curves_.components(); }
  /// Place of the roughness among the responses; nothing without a wished stress in a window.
  std::optional<std::size_t> roughness() const { return roughness_; }
  const results::MeasuringFrame& frame() const { return frame_; }

  /// Mean and 95 % interval of the mean curve, Pa in each bin.
  struct Curve {
    std::vector<double> strain, stress, low, high;  ///< strain: middle of the bin
  };
  Curve curve(const Inputs& one) const;

  /// The model told that a design has the values it expects of it: its uncertainty there goes, its means stay, so that
  /// the next point of a batch lies elsewhere.
  ResponseModel told(const Inputs& one) const;

 private:
  struct Table;
  void learn_curves(Table& table);
  void learn_roughness(Table& table, const results::Target& target);
  void learn_measures(Table& table, const results::Target& target);
  void add_response(Table& table, const std::string& name, const results::Measure* measure, Scale scale,
                    const std::vector<std::vector<double>>& values);
  void find_classes(std::span<const KnownDesign> known);

  results::MeasuringFrame frame_;
  Features features_;
  std::optional<Classifier> success_, front_;
  CurveBasis curves_;
  std::vector<Response> responses_;
  std::optional<std::size_t> roughness_;
  Coverage coverage_;
  int learnt_ = 0;  ///< designs with a usable curve
};

/// Whether an evaluation can be learnt from: completed, with a plateau where one is measured within a window.
bool is_usable(const results::Evaluation& evaluation);

/// A block that keeps this share of its first peak right behind it fails row by row, by a front; one that keeps less
/// has cracked throughout. Between them: of the trials in docs/studies/patterns.md those with a front keep a fifth to
/// two fifths, lattices a fiftieth to a twentieth.
inline constexpr double front_drop_ratio = 0.1;

}  // namespace perfora::model
