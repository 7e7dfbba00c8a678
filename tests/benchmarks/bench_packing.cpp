// What is here: time to pack Table 1's discs: quenched to 0.84, jammed, jammed and dilated to 0.719; items are discs,
// and the counters say what came out. What is not: a pass or a fail.
//   GOMP_SPINCOUNT=2000 build/release/tests/benchmarks/bench_packing --benchmark_out=packing.json
#include <benchmark/benchmark.h>

#include <algorithm>
#include <cmath>

#include "geometry/cell_grid.h"
#include "geometry/make_packing.h"

namespace {

using namespace perfora::geometry;

/// Difference of the eigenvalues of the fabric tensor <n n> over their mean, of all pairs whose gap is below a tenth of
/// the mean diameter. Directions without any order give 1.8/sqrt(pairs) on average.
double fabric_difference(const Packing& packing) {
  const double gap = 0.1 * packing.mean_diameter();
  const double largest = *std::max_element(packing.radius.begin(), packing.radius.end());
  struct Point {
    double x, y;
  };
  const CellGrid grid(packing.width, packing.height, 2.0 * largest + gap, packing.x.size(), [&](std::size_t i) {
    return Point{packing.x[i], packing.y[i]};
  });
  double cosine = 0.0, sine = 0.0, pairs = 0.0;
  for (std::size_t i = 0; i < packing.x.size(); ++i)
    grid.for_each_near(packing.x[i], packing.y[i], [&](std::int32_t other) {
      const std::size_t j = static_cast<std::size_t>(other);
      const double dx = std::remainder(packing.x[j] - packing.x[i], packing.width);
      const double dy = std::remainder(packing.y[j] - packing.y[i], packing.height);
      const double squared = dx * dx + dy * dy, reach = packing.radius[i] + packing.radius[j] + gap;
      if (j <= i || squared >= reach * reach) return;
      cosine += (dx * dx - dy * dy) / squared;
      sine += 2.0 * dx * dy / squared;
      pairs += 1.0;
    });
  return 2.0 * std::hypot(cosine, sine) / pairs;
}

void pack(benchmark::State& state, double fraction, PackingProtocol protocol) {
  PackingOptions options;
  options.solid_fraction = fraction;
  options.protocol = protocol;
  const double discs = static_cast<double>(state.range(0)), threads = static_cast<double>(state.range(1));
  constexpr double mean_area = 0.25 * 3.14159265358979 * 0.27979e-6;  // m2, of Table 1's size law
  const double side = std::sqrt(discs * mean_area / (fraction > 0.0 ? fraction : 0.85));
  Packing packing;
  for (auto _ : state) packing = make_packing(options, side, side, 1, static_cast<int>(threads));
  state.SetItemsProcessed(state.iterations() * packing.size());
  state.counters["discs"] = packing.size();
  state.counters["minimiser_iterations"] = static_cast<double>(packing.quality.iterations);
  state.counters["reached"] = packing.quality.reached ? 1.0 : 0.0;
  state.counters["max_overlap_ratio"] = packing.quality.max_overlap_ratio;
  state.counters["coordination_number"] = packing.quality.coordination_number;
  state.counters["fabric_difference"] = fabric_difference(packing);
}

void sizes(benchmark::internal::Benchmark* bench) {
  for (std::int64_t threads : {1, 2})
    for (std::int64_t discs : {10'000, 30'000, 90'000, 300'000, 1'000'000}) bench->Args({discs, threads});
  bench->ArgNames({"discs", "threads"})
      ->Unit(benchmark::kSecond)
      ->Iterations(1)
      ->MeasureProcessCPUTime()
      ->UseRealTime();
}

BENCHMARK_CAPTURE(pack, quench_to_84_percent, 0.84, PackingProtocol::quench)->Apply(sizes);
BENCHMARK_CAPTURE(pack, jammed, 0.0, PackingProtocol::dilate)->Apply(sizes);
BENCHMARK_CAPTURE(pack, dilated_to_719_permille, 0.719, PackingProtocol::dilate)->Apply(sizes);

}  // namespace

BENCHMARK_MAIN();
