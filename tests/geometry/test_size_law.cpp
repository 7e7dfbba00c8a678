// What is here: the power law of diameters against its closed forms and the numbers of docs/user/theory.md.
#include <gtest/gtest.h>

#include <cmath>
#include <numeric>

#include "geometry/make_packing.h"
#include "geometry/random.h"
#include "geometry/size_law.h"
#include "io/error.h"

namespace perfora::geometry {
namespace {

TEST(SizeLaw, Table1HasExponent290) {
  EXPECT_NEAR(size_law_exponent(0.5044e-3, 1.0e-3, 3.0), 2.90,
              0.005);  // docs/user/theory.md, "Block, holes, packing"
}

TEST(SizeLaw, ExponentThreeHasMeanOneHalf) {
  // Equal area in each logarithmic class; integral of t^-2 over integral of t^-3 on [1/3, 1] = 2/4.
  EXPECT_NEAR(size_law_exponent(0.5, 1.0, 3.0), 3.0, 1e-10);
  EXPECT_NEAR((SizeLaw{3.0, 3.0}.mean_power(1)), 0.5, 1e-14);
}

TEST(SizeLaw, ExponentOneIsContinuous) {
  // q = 1: integral of 1 over integral of 1/t = (1 - 1/3)/ln 3; q = 2: ln 3/(3 - 1).
  EXPECT_NEAR((SizeLaw{1.0, 3.0}.mean_power(1)), (2.0 / 3.0) / std::log(3.0), 1e-14);
  EXPECT_NEAR((SizeLaw{2.0, 3.0}.mean_power(1)), std::log(3.0) / 2.0, 1e-14);
  EXPECT_NEAR((SizeLaw{1.0 + 1e-7, 3.0}.mean_power(1)), (SizeLaw{1.0, 3.0}.mean_power(1)), 1e-7);
}

TEST(SizeLaw, QuantileInvertsTheDistribution) {
  for (double q : {-2.0, 0.0, 1.0, 2.9, 5.0}) {
    const SizeLaw law{q, 3.0};
    EXPECT_NEAR(law.quantile(0.0), 1.0 / 3.0, 1e-14);
    EXPECT_NEAR(law.quantile(1.0), 1.0, 1e-14);
    for (double u : {0.1, 0.5, 0.9}) {
      const double d = law.quantile(u);
      const double fraction = q == 1.0
                                  ? std::log(3.0 * d) / std::log(3.0)
                                  : (std::pow(d, 1.0 - q) - std::pow(3.0, q - 1.0)) / (1.0 - std::pow(3.0, q - 1.0));
      EXPECT_NEAR(fraction, u, 1e-12) << "q = " << q;
    }
  }
}

TEST(SizeLaw, SampleMeanIsThatOfTheLawWithin005Percent) {
  const SizeLaw law{size_law_exponent(0.5044, 1.0, 3.0), 3.0};
  for (std::uint64_t seed = 1; seed <= 20; ++seed) {
    const std::vector<double> sample = sample_diameters(law, 1000, seed);
    const double mean = std::accumulate(sample.begin(), sample.end(), 0.0) / 1000.0;
    EXPECT_NEAR(mean, 0.5044, 5e-4 * 0.5044) << "seed " << seed;
    EXPECT_TRUE(std::is_sorted(sample.begin(), sample.end()));
    EXPECT_GE(sample.front(), 1.0 / 3.0 - 1e-12);
    EXPECT_LE(sample.back(), 1.0 + 1e-12);
  }
}

TEST(SizeLaw, RefusesMeansItCannotReach) {
  EXPECT_THROW(size_law_exponent(0.30, 1.0, 3.0), io::InputError);
  EXPECT_THROW(size_law_exponent(1.01, 1.0, 3.0), io::InputError);
  EXPECT_THROW(size_law_exponent(0.5, 1.0, 1.0), io::InputError);
  EXPECT_EQ(size_law_exponent(1.0, 1.0, 1.0), 0.0);
}

TEST(UniformPair, IsUniformAndDependsOnEveryArgument) {
  double sum = 0.0, squares = 0.0;
  constexpr int count = 20000;
  for (std::uint64_t k = 0; k < count; ++k)
    for (double u : uniform_pair(7, RandomStream::disc_place, k)) {
      ASSERT_TRUE(u >= 0.0 && u < 1.0);
      sum += u;
      squares += u * u;
    }
  EXPECT_NEAR(sum / (2 * count), 0.5, 0.01);  // standard error 0.0014
  EXPECT_NEAR(squares / (2 * count), 1.0 / 3.0, 0.01);
  const auto reference = uniform_pair(7, RandomStream::disc_place, 5, 0);
  EXPECT_EQ(reference, uniform_pair(7, RandomStream::disc_place, 5, 0));
  EXPECT_NE(reference, uniform_pair(8, RandomStream::disc_place, 5, 0));
  EXPECT_NE(reference, uniform_pair(7, RandomStream::disc_size, 5, 0));
  EXPECT_NE(reference, uniform_pair(7, RandomStream::disc_place, 6, 0));
  EXPECT_NE(reference, uniform_pair(7, RandomStream::disc_place, 5, 1));
}

}  // namespace
}  // namespace perfora::geometry
