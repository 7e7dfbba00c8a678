// What is here: the parts of a step on the block of Table 1, each alone: bonds, contacts, near pairs, kick and drift.
// Counters: ns per item (bond, touching pair, pair listed, disc) and bytes read and written per second as counted from
// the layout. What is not: whole runs (run_all.py), packings (bench_packing.cpp).
#include <benchmark/benchmark.h>

#include <string>

#include "solver/integrator.h"
#include "solver/kernels/bond_rows.h"
#include "tests/benchmarks/table1_block.h"

namespace perfora::benchmarks {
namespace {

using namespace solver;

/// Everything a force evaluation needs, at rest.
struct State {
  BondLaw bond;
  ContactLaw contact;
  DiscState discs;
  BondNetwork network;
  NeighbourList neighbour_list;
  CellMatrix cell;
  std::vector<double> inverse_mass, inverse_inertia;
  std::vector<std::int32_t> broken;
  static constexpr double dt = 7e-7;

  explicit State(const Block& block, bool bonded = true) : network(block.network) {
    bond = make_bond_law(block.options.material, block.mean_diameter);
    contact = make_contact_law(block.options.material);
    const std::size_t n = block.packing.x.size();
    cell = {block.packing.width, 0.0, block.packing.height};
    discs.resize(n);
    discs.radius = block.packing.radius;
    discs.mass = block.masses.mass;
    discs.inertia = block.masses.inertia;
    discs.position_shift = 3;
    double largest = 0.0;
    for (std::size_t d = 0; d < n; ++d) {
      discs.sx[d] = fixed_point(block.packing.x[d] / cell.xx);
      discs.sy[d] = fixed_point(block.packing.y[d] / cell.yy);
      discs.refresh_record(d);
      inverse_mass.push_back(1.0 / discs.mass[d]);
      inverse_inertia.push_back(1.0 / discs.inertia[d]);
      largest = std::max(largest, discs.radius[d]);
    }
    discs.sx_before = discs.sx;
    discs.sy_before = discs.sy;
    discs.half_angle_before = discs.half_angle;
    if (!bonded) std::fill(network.state.begin(), network.state.end(), BondState::compacted);
    neighbour_list.configure(discs.size(), largest, 0.35 * block.mean_diameter);
    neighbour_list.rebuild(discs, cell, network);
    broken.reserve(network.i.size());
  }

  StepSums forces(ForceBackend& backend) {
    broken.clear();
    ForceStep step{discs, network, neighbour_list, cell, cell, {}, dt, broken};
    return backend.forces(step);
  }
};

const Block& table1() {
  static const Block block = table1_block();
  return block;
}

/// The solid of the block pressed together until every disc touches two to three others: the end of a run.
const Block& rubble() {
  static const Block block = [] {
    Block b = table1();
    constexpr double grown = 1.13;  // 0.719 x 1.13^2 = 0.92, beyond jamming
    for (double& r : b.packing.radius) r *= grown;
    return b;
  }();
  return block;
}

void per_item(benchmark::State& run, double items, double bytes) {
  run.counters["ns_per_item"] =
      benchmark::Counter(items * 1e-9, benchmark::Counter::kIsIterationInvariantRate | benchmark::Counter::kInvert);
  run.counters["items"] = items;
  run.SetItemsProcessed(static_cast<std::int64_t>(items) * run.iterations());
  run.SetBytesProcessed(static_cast<std::int64_t>(bytes) * run.iterations());
}

/// Bytes a bond end takes in the rows: direction, length, neighbour, threshold, rest of the length. Records come on
/// top.
constexpr double bytes_per_bond_end = 4 * 4 + 2 + 1;

void bonds(benchmark::State& run, SimdChoice simd, int threads) {
  State s(table1());
  const auto backend = make_openmp_backend(s.bond, s.contact, threads, simd);
  backend->load(s.network, s.discs, s.cell);
  backend->set_neighbours(s.neighbour_list, s.discs);
  for (auto _ : run) benchmark::DoNotOptimize(s.forces(*backend));
  const auto count = static_cast<double>(s.network.size());
  per_item(run, count, 2.0 * count * bytes_per_bond_end);
  BondRows rows(simd == SimdChoice::avx512 ? 16 : 8);
  rows.build(s.network, s.discs.size(), s.bond, 1.0);
  run.counters["places_per_end"] = rows.padding();
}

void bonds_reference(benchmark::State& run) {
  State s(table1());
  const auto backend = make_reference_backend(s.bond, s.contact);
  for (auto _ : run) benchmark::DoNotOptimize(s.forces(*backend));
  per_item(run, static_cast<double>(s.network.size()), 0.0);
}

void contacts(benchmark::State& run, int threads) {
  State s(rubble(), false);
  const auto backend = make_openmp_backend(s.bond, s.contact, threads);
  backend->load(s.network, s.discs, s.cell);
  backend->set_neighbours(s.neighbour_list, s.discs);
  for (auto _ : run) benchmark::DoNotOptimize(s.forces(*backend));
  double touching = 0.0;
  for (std::int32_t i = 0; i < s.discs.size(); ++i)
    for (std::int32_t k = s.neighbour_list.row_begin(i); k < s.neighbour_list.row_end(i); ++k) {
      const NeighbourSlot& slot = s.neighbour_list.slots()[static_cast<std::size_t>(k)];
      if (slot.neighbour > i &&
          kinematics_of(s.discs, i, slot.neighbour, s.cell, 1.0, 0.0, 0.0).length < slot.contact_distance)
        touching += 1.0;
    }
  per_item(run, touching, 36.0 * static_cast<double>(s.neighbour_list.slots().size()));  // 28 read, 8 written and more
}

void neighbour_list(benchmark::State& run) {
  State s(rubble(), false);
  for (auto _ : run) s.neighbour_list.rebuild(s.discs, s.cell, s.network);
  per_item(run, 0.5 * static_cast<double>(s.neighbour_list.slots().size()), 0.0);
}

void kick_drift(benchmark::State& run, int threads) {
  State s(table1());
  const std::vector<double> damping(s.inverse_mass.size(), 0.7);
  const KickAndDrift task{s.discs, s.inverse_mass.data(), s.inverse_inertia.data(), State::dt, damping.data(), 1.0,
                          s.cell};
  const std::int32_t n = s.discs.size(), chunks = (n + chunk_discs - 1) / chunk_discs;
  for (auto _ : run) {
    std::swap(s.discs.sx, s.discs.sx_before);
    std::swap(s.discs.sy, s.discs.sy_before);
    std::swap(s.discs.half_angle, s.discs.half_angle_before);
#pragma omp parallel for schedule(static) num_threads(threads)
    for (std::int32_t c = 0; c < chunks; ++c)
      benchmark::DoNotOptimize(kick_and_drift(task, c * chunk_discs, std::min(n, (c + 1) * chunk_discs)));
  }
  constexpr double bytes_per_disc = 12 * 8 + 6 * 8 + 2 * 16;  // read, written, record and motion
  per_item(run, static_cast<double>(n), bytes_per_disc * n);
}

void register_all() {
  const auto named = [](SimdChoice simd) {
    return simd == SimdChoice::avx512 ? "avx512" : simd == SimdChoice::avx2 ? "avx2" : "portable";
  };
  for (const SimdChoice simd : usable_simd())
    for (const int threads : {1, 2})
      benchmark::RegisterBenchmark(
          (std::string("bonds/") + named(simd) + "/threads:" + std::to_string(threads)).c_str(),
          [=](benchmark::State& run) { bonds(run, simd, threads); });
  benchmark::RegisterBenchmark("bonds/reference", bonds_reference);
  for (const int threads : {1, 2}) {
    const std::string tail = "/threads:" + std::to_string(threads);
    benchmark::RegisterBenchmark(("contacts" + tail).c_str(), [=](benchmark::State& run) {
      contacts(run, threads);
    })->UseRealTime();
    benchmark::RegisterBenchmark(("kick_and_drift" + tail).c_str(), [=](benchmark::State& run) {
      kick_drift(run, threads);
    })->UseRealTime();
  }
  benchmark::RegisterBenchmark("near_pairs/rebuild", neighbour_list);
}

}  // namespace
}  // namespace perfora::benchmarks

int main(int argc, char** argv) {
  perfora::benchmarks::register_all();
  benchmark::Initialize(&argc, argv);
  if (benchmark::ReportUnrecognizedArguments(argc, argv)) return 1;
  benchmark::RunSpecifiedBenchmarks();
  return 0;
}
