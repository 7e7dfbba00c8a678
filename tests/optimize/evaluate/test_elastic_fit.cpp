// Tests of the elastic half of calibration. Expected: Voigt's closed form, and that the answer gives back what was
// asked.
#include <gtest/gtest.h>

#include "optimize/evaluate/elastic_fit.h"
#include "optimize/evaluate/material_tests.h"
#include "optimize/evaluate/material_tests_file.h"
#include "solver/elastic/elastic.h"

namespace perfora::optimize {
namespace {

ElasticFit small_fit() {
  const DesignFile design =
      DesignFile::from_toml("[packing]\nsolid_fraction = 0.719\n[material_test]\nsize = 0.009\n", "text");
  return ElasticFit(material_sample(design), 1, {});
}

// Voigt: nu = (k_n - k_t)/(3 k_n + k_t), so k_t/k_n = (1 - 3 nu)/(1 + nu); Table 1's 0.3757 for 0.185.
TEST(ElasticFit, VoigtsRatio) {
  for (const double ratio : {0.1, 0.3757, 1.0, 3.0})
    EXPECT_NEAR(voigt_stiffness_ratio((1.0 - ratio) / (3.0 + ratio)), ratio, 1e-12);
}

// The ratio found gives the wanted nu to the tolerance of the root (1e-5); nu falls with the ratio; E grows.
TEST(ElasticFit, GivesTheWantedPoissonRatio) {
  const ElasticFit fit = small_fit();
  double previous = 1.0;
  for (const double ratio : {0.01, 0.1, 0.5, 2.0}) {
    EXPECT_LT(fit.at(ratio).poisson, previous);
    previous = fit.at(ratio).poisson;
  }
  for (const double nu : {0.1, 0.25}) EXPECT_NEAR(fit.at(fit.stiffness_ratio_for(nu)).poisson, nu, 1e-5);
  EXPECT_GT(fit.at(1.0).young, fit.at(0.3).young);
}

// nu = 0.49 lies beyond central springs (1/3 by Voigt, a little more in a relaxed packing): the end of the range.
TEST(ElasticFit, EndsOfTheRange) {
  const ElasticFit fit = small_fit();
  EXPECT_EQ(fit.stiffness_ratio_for(0.49), ElasticFit::least_ratio);
  EXPECT_EQ(fit.stiffness_ratio_for(-0.9), ElasticFit::largest_ratio);
  EXPECT_GT(fit.at(ElasticFit::least_ratio).poisson, 1.0 / 3.0);
}

// A mortar of E = 30 GPa and nu = 0.2 in space is read in plane strain as E2 = E/(1 - nu^2), nu2 = nu/(1 - nu); read
// back it is itself (plane elasticity).
TEST(PlaneStrain, ReadsBackToItself) {
  const double young = 30e9, nu = 0.2;
  const double young_2 = young / (1.0 - nu * nu), nu_2 = nu / (1.0 - nu);
  EXPECT_NEAR(solver::plane_strain_poisson_ratio(nu_2), nu, 1e-15);
  EXPECT_NEAR(solver::plane_strain_young_modulus(young_2, nu_2), young, 1e-4);
}

}  // namespace
}  // namespace perfora::optimize
