// What is here: one fast crushing of the block of Table 1 (or of a cell with fewer of its holes), timed over a fixed
// number of steps at four stages: intact, at the first peak, half way, fully crushed. Prints one JSON object. What is
// not: parts of a step (bench_solver.cpp), runs as users make them (run_all.py).
// Usage: bench_stages [holes a side, 6] [threads, 2] [rate in 1/s, 6] [steps a stage, 2000] [horizon, 3]
#include <fmt/format.h>

#include <chrono>
#include <cstdlib>

#include "io/memory.h"
#include "io/provenance.h"
#include "tests/benchmarks/table1_block.h"

namespace perfora::benchmarks {
namespace {

using Clock = std::chrono::steady_clock;

double seconds_since(Clock::time_point start) {
  return std::chrono::duration<double>(Clock::now() - start).count();
}

solver::Simulation compression(const Block& b, double rate, int threads) {
  solver::SimulationInput input;
  input.clipped = &b.packing;
  input.network = b.network;
  input.options = b.options;
  input.masses = b.masses;
  input.cell.start = {b.packing.width, 0.0, b.packing.height};
  input.cell.control[2] = solver::CellControl::rate;
  input.cell.velocity.yy = -rate * b.packing.height;
  const double critical = solver::critical_step_by_power_iteration(b.network, b.masses, b.options.material,
                                                                   b.options.dynamics.cundall_damping);
  input.time_step =
      std::min(b.options.dynamics.step_factor * critical,
               solver::contact_critical_step(b.masses, b.packing.radius, b.options.material, b.options.dynamics.cundall_damping));
  input.mean_diameter = b.mean_diameter;
  input.threads = threads;
  return solver::Simulation(std::move(input));
}

std::string stage(solver::Simulation& s, const char* name, int steps) {
  const std::int64_t rebuilds = s.neighbour_list().rebuilds();
  const double bond_steps = s.bond_steps();
  const Clock::time_point start = Clock::now();
  for (int k = 0; k < steps; ++k) s.step();
  const double seconds = seconds_since(start);
  const auto contacts = static_cast<double>(s.contacts());
  const double pairs = s.bond_steps() - bond_steps + contacts * steps;
  return fmt::format(
      R"({{"stage": "{}", "strain": {:.4f}, "intact_bonds": {}, "contacts": {:.0f}, "steps_per_second": {:.1f}, )"
      R"("ns_per_bond_or_contact_step": {:.3f}, "list_rebuilds": {}}})",
      name, s.strain(), s.intact_bonds(), contacts, steps / seconds, 1e9 * seconds / pairs,
      s.neighbour_list().rebuilds() - rebuilds);
}

}  // namespace
}  // namespace perfora::benchmarks

int main(int argc, char** argv) {
  using namespace perfora::benchmarks;
  const auto number = [&](int k, double otherwise) { return argc > k ? std::atof(argv[k]) : otherwise; };
  const int holes = static_cast<int>(number(1, 6.0)), threads = static_cast<int>(number(2, 2.0));
  const double rate = number(3, 6.0);
  const int steps = static_cast<int>(number(4, 2000.0));
  const Block block = table1_block(number(5, 3.0), holes);
  perfora::solver::Simulation s = compression(block, rate, threads);
  const auto go_to = [&](double strain) {
    while (s.strain() < strain) s.step();
  };
  std::string stages;
  for (const auto& [name, strain] : {std::pair{"intact", 0.0}, std::pair{"first peak", 0.006},
                                     std::pair{"half way", 0.30}, std::pair{"crushed", 0.58}}) {
    go_to(strain);
    stages += (stages.empty() ? "\n  " : ",\n  ") + stage(s, name, steps);
  }
  fmt::print(R"({{"discs": {}, "bonds": {}, "threads": {}, "simd": "{}", "rate": {}, "peak_memory_bytes": {}, )"
             R"("git_revision": "{}", "stages": [{}]}})"
             "\n",
             block.packing.size(), block.network.size(), threads, s.simd(), rate, perfora::io::peak_memory_bytes(),
             perfora::io::git_revision(), stages);
}
