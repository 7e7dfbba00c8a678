// What is here: the root k_t/k_n for a wanted Poisson's ratio, bracketed, each step one elastic solution per sample.
#include "optimize/evaluate/elastic_fit.h"

#include <boost/math/tools/toms748_solve.hpp>
#include <cmath>
#include <limits>

#include "io/error.h"
#include "solver/elastic/elastic.h"

namespace perfora::optimize {
namespace {

constexpr double not_reached = std::numeric_limits<double>::quiet_NaN();

}  // namespace

double voigt_stiffness_ratio(double poisson_ratio) {
  return (1.0 - 3.0 * poisson_ratio) / (1.0 + poisson_ratio);
}

ElasticFit::ElasticFit(const DesignFile& sample, int replicates, const EvaluateOptions& packing) {
  double lengths = 0.0;
  std::int64_t bonds = 0;
  for (int r = 0; r < replicates; ++r) {
    const PackedDesign packed = pack_design(sample, packing, r);
    if (!packed.periodic.quality.reached)
      throw io::InputError(sample.schema().origin("packing.solid_fraction"),
                           "the packing was not reached: " + packed.periodic.quality.reason, "",
                           "lower packing.solid_fraction");
    mean_diameter_ = mean_diameter_of(sample, packed.periodic);
    solver::BondNetwork network = solver::make_bond_network(packed.clipped, packed.layout,
                                                            sample.design().solver.material, {}, 1, mean_diameter_);
    for (const double l : network.reference_length) lengths += l;
    bonds += network.size();
    samples_.push_back({std::move(network), packed.clipped.size(), packed.clipped.width, packed.clipped.height});
  }
  if (bonds == 0)
    throw io::InputError(sample.schema().origin("material.horizon"), "no two discs are near enough to be bonded", "",
                         "raise the horizon or the solid fraction");
  mean_bond_length_ = lengths / static_cast<double>(bonds);
}

UnitElasticity ElasticFit::at(double stiffness_ratio) const {
  UnitElasticity mean;
  for (const Sample& s : samples_) {
    const solver::ElasticResponse e =
        solver::elastic_response(s.network, s.discs, s.width, s.height, 1.0, stiffness_ratio);
    if (e.status != solver::ElasticStatus::converged) return {not_reached, not_reached};
    mean.young += e.moduli.isotropic_young / static_cast<double>(samples_.size());
    mean.poisson += e.moduli.isotropic_poisson / static_cast<double>(samples_.size());
  }
  return mean;
}

double ElasticFit::stiffness_ratio_for(double poisson) const {
  const double low = least_ratio, high = largest_ratio;
  if (poisson >= at(low).poisson) return low;
  if (poisson <= at(high).poisson) return high;
  const auto excess = [&](double log_ratio) { return at(std::exp(log_ratio)).poisson - poisson; };
  constexpr int bits = 20;  // of log(k_t/k_n): nu to about 1e-6, far below the scatter of samples
  std::uintmax_t most_evaluations = 60;
  const auto [left, right] = boost::math::tools::toms748_solve(
      excess, std::log(low), std::log(high), boost::math::tools::eps_tolerance<double>(bits), most_evaluations);
  return std::exp(0.5 * (left + right));
}

}  // namespace perfora::optimize
