// What is here: the made-up runs. What is not: mechanics.
#include "tests/results/synthetic_run.h"

#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <random>

#include "results/formats.h"
#include "results/pack_file.h"

namespace perfora::results::testing {
namespace {

constexpr double peak_strain = 0.009;
constexpr double peak_stress = 0.55e6;
constexpr double plateau = 0.025e6;

double uniform(std::mt19937& engine) {
  return std::generate_canonical<double, 32>(engine);
}

geometry::Packing make_discs(double size, double mean_diameter, std::mt19937& engine) {
  geometry::Packing packing;
  packing.width = packing.height = size;
  packing.key.width = packing.key.height = size;
  packing.key.mean_diameter = mean_diameter;
  packing.key.maximum_diameter = 2.0 * mean_diameter;
  packing.key.size_ratio = 3.0;
  packing.key.protocol = "dilate";
  packing.key.seed = 1;
  packing.key.algorithm_version = 1;
  packing.quality.solid_fraction = 0.72;
  packing.quality.jamming_fraction = 0.85;
  packing.quality.max_overlap_ratio = 8e-4;
  packing.quality.iterations = 1234;
  const double step = size / std::round(size / (1.17 * mean_diameter));
  const double row = size / std::round(size / (step * 0.866));
  for (int j = 0; j * row < size - 0.5 * row; ++j)
    for (int i = 0; i * step < size - 0.5 * step; ++i) {
      const double x = (i + 0.5 * (j % 2) + 0.25 * (uniform(engine) - 0.5) + 1.0) * step;
      const double y = (j + 0.25 * (uniform(engine) - 0.5) + 0.5) * row;
      packing.x.push_back(std::fmod(x, size));
      packing.y.push_back(std::fmod(y + size, size));
      packing.radius.push_back(0.5 * mean_diameter * (0.66 + 0.7 * std::pow(uniform(engine), 2.0)));
    }
  return packing;
}

geometry::PerforationLayout make_layout(double size, int holes) {
  geometry::PerforationLayout layout{size, size, {}};
  const double pitch = size / std::max(holes, 1);
  for (int j = 0; j < holes; ++j)
    for (int i = 0; i < holes; ++i)
      layout.perforations.push_back({(i + 0.5) * pitch, (j + 0.5) * pitch, geometry::Circle{0.8 * pitch}});
  return layout;
}

geometry::Packing clip(const geometry::Packing& packing, const geometry::PerforationLayout& layout) {
  geometry::Packing clipped = packing;
  clipped.x.clear();
  clipped.y.clear();
  clipped.radius.clear();
  for (std::size_t k = 0; k < packing.x.size(); ++k) {
    const bool inside = std::any_of(layout.perforations.begin(), layout.perforations.end(),
                                    [&](const auto& hole) { return hole.contains(packing.x[k], packing.y[k]); });
    if (inside) continue;
    clipped.x.push_back(packing.x[k]);
    clipped.y.push_back(packing.y[k]);
    clipped.radius.push_back(packing.radius[k]);
  }
  return clipped;
}

double stress_at(double strain, std::mt19937& engine) {
  const double rising = peak_stress * strain / peak_strain;
  if (strain <= peak_strain) return rising;
  const double fall = peak_stress * std::exp(-(strain - peak_strain) / 0.004);
  const double spikes = plateau * (0.5 + 2.0 * std::pow(uniform(engine), 3.0)) * (0.6 + 0.4 * std::sin(90.0 * strain));
  const double densified = strain > 0.45 ? 1.2e6 * std::pow((strain - 0.45) / 0.1, 2.5) : 0.0;
  return fall + spikes + densified;
}

void fill_history(RunResult& run, double until, std::mt19937& engine) {
  History& h = run.history;
  double work = 0.0;
  for (int row = 0; row * 5e-4 <= until + 1e-12; ++row) {
    const double strain = row * 5e-4;
    const double stress = stress_at(strain, engine);
    work += stress * 5e-4 * run.width * run.height;
    const double broken = strain > peak_strain ? std::min(0.5, strain) * static_cast<double>(run.bonds.size()) : 0.0;
    h.strain_yy.push_back(strain);
    h.strain_yy_log.push_back(-std::log1p(-strain));
    h.stress_yy.push_back(stress);
    h.stress_xx.push_back(0.3 * stress);
    h.stress_xy.push_back(0.01 * stress);
    h.broken_bonds.push_back(std::floor(broken));
    h.fragments.push_back(1.0 + std::floor(400.0 * strain));
    h.contacts.push_back(std::floor(1000.0 * strain));
    h.time.push_back(strain / 2.0);
    h.external_work.push_back(work);
  }
}

void make_bonds(RunResult& run, std::mt19937& engine) {
  // Neighbours within 1.9 diameters, by brute force over a window of the list (rows of the lattice follow each other).
  const geometry::Packing& discs = run.clipped;
  const std::int32_t window = static_cast<std::int32_t>(2.2 * run.width / run.mean_diameter);
  for (std::int32_t i = 0; i < discs.size(); ++i)
    for (std::int32_t j = i + 1; j < std::min(discs.size(), i + window); ++j) {
      const auto a = static_cast<std::size_t>(i);
      const auto b = static_cast<std::size_t>(j);
      double dx = discs.x[b] - discs.x[a];
      double dy = discs.y[b] - discs.y[a];
      dx -= run.width * std::round(dx / run.width);
      dy -= run.height * std::round(dy / run.height);
      const double length = std::hypot(dx, dy);
      if (length > 1.9 * run.mean_diameter) continue;
      run.bonds.pairs.insert(run.bonds.pairs.end(), {i, j});
      run.bonds.reference_length.push_back(length);
      run.bonds.strength_factor.push_back(0.8 + 0.4 * uniform(engine));
    }
}

/// Fragment of each disc: the nearest of a few random seeds; numbered by falling size.
std::vector<std::int32_t> break_up(const RunResult& run, int pieces, std::mt19937& engine, std::vector<double>& seeds) {
  seeds.clear();
  for (int p = 0; p < 2 * pieces; ++p) seeds.push_back(uniform(engine) * run.width);
  std::vector<std::int32_t> nearest;
  std::vector<int> size(static_cast<std::size_t>(pieces), 0);
  for (std::size_t k = 0; k < run.clipped.x.size(); ++k) {
    std::size_t best = 0;
    double best_distance = 1e9;
    for (std::size_t p = 0; p < static_cast<std::size_t>(pieces); ++p) {
      const double distance = std::hypot(run.clipped.x[k] - seeds[2 * p], run.clipped.y[k] - seeds[2 * p + 1]);
      if (distance < best_distance) {
        best_distance = distance;
        best = p;
      }
    }
    nearest.push_back(static_cast<std::int32_t>(best));
    ++size[best];
  }
  std::vector<std::int32_t> order(static_cast<std::size_t>(pieces));
  for (std::size_t p = 0; p < order.size(); ++p) order[p] = static_cast<std::int32_t>(p);
  std::stable_sort(order.begin(), order.end(), [&](auto a, auto b) {
    return size[static_cast<std::size_t>(a)] > size[static_cast<std::size_t>(b)];
  });
  std::vector<std::int32_t> rank(order.size());
  std::vector<double> sorted_seeds;
  for (std::size_t p = 0; p < order.size(); ++p) {
    const auto old = static_cast<std::size_t>(order[p]);
    rank[old] = static_cast<std::int32_t>(p);
    sorted_seeds.insert(sorted_seeds.end(), {seeds[2 * old], seeds[2 * old + 1]});
  }
  seeds = sorted_seeds;
  for (std::int32_t& fragment : nearest) fragment = rank[static_cast<std::size_t>(fragment)];
  return nearest;
}

Frame make_frame(const RunResult& run, int number, double strain, std::mt19937& engine) {
  Frame frame;
  frame.info = {fmt::format("{:05d}", number), strain, strain / 2.0, run.width, 0.0, run.height * (1.0 - strain)};
  const int pieces = strain <= peak_strain ? 1 : 1 + static_cast<int>(strain * 160.0);
  std::vector<double> seeds;
  frame.fragment = break_up(run, pieces, engine, seeds);
  std::vector<double> turn;
  for (int p = 0; p < pieces; ++p) turn.push_back(pieces == 1 ? 0.0 : 0.8 * strain * (uniform(engine) - 0.5));
  for (std::size_t k = 0; k < run.clipped.x.size(); ++k) {
    const auto p = static_cast<std::size_t>(frame.fragment[k]);
    const double dx = run.clipped.x[k] - seeds[2 * p];
    const double dy = (run.clipped.y[k] - seeds[2 * p + 1]) * (1.0 - 0.75 * strain);
    const double x = seeds[2 * p] + std::cos(turn[p]) * dx - std::sin(turn[p]) * dy;
    const double y = (1.0 - strain) * seeds[2 * p + 1] + std::sin(turn[p]) * dx + std::cos(turn[p]) * dy;
    frame.position.push_back(x - frame.info.h_xx * std::floor(x / frame.info.h_xx));
    frame.position.push_back(y - frame.info.h_yy * std::floor(y / frame.info.h_yy));
    frame.angle.push_back(turn[p]);
  }
  std::vector<int> all(run.clipped.x.size(), 0), lost(run.clipped.x.size(), 0);
  for (std::size_t b = 0; b < run.bonds.size(); ++b) {
    const auto i = static_cast<std::size_t>(run.bonds.pairs[2 * b]);
    const auto j = static_cast<std::size_t>(run.bonds.pairs[2 * b + 1]);
    ++all[i];
    ++all[j];
    if (frame.fragment[i] != frame.fragment[j] || uniform(engine) < 0.1 * strain) {
      ++lost[i];
      ++lost[j];
      continue;
    }
    frame.bond_pairs.insert(frame.bond_pairs.end(), {run.bonds.pairs[2 * b], run.bonds.pairs[2 * b + 1]});
    frame.bond_damage.push_back(strain == 0.0 ? 0.0 : 0.2 * uniform(engine));
  }
  for (std::size_t k = 0; k < all.size(); ++k)
    frame.damage.push_back(all[k] == 0 ? 0.0 : static_cast<double>(lost[k]) / all[k]);
  return frame;
}

void fill_events(RunResult& run, double until, std::mt19937& engine) {
  std::vector<double> strains;
  for (std::size_t b = 0; b < run.bonds.size(); b += 17)
    strains.push_back(peak_strain + (until - peak_strain) * uniform(engine));
  std::sort(strains.begin(), strains.end());
  for (std::size_t k = 0; k < strains.size(); ++k) {
    const std::size_t b = 17 * k;
    const std::int32_t i = run.bonds.pairs[2 * b], j = run.bonds.pairs[2 * b + 1];
    run.events.push_back({strains[k] / 2.0, strains[k], static_cast<std::int32_t>(b), i, j,
                          run.clipped.x[static_cast<std::size_t>(i)], run.clipped.y[static_cast<std::size_t>(i)],
                          b % 3 == 0 ? BreakMode::shear : BreakMode::tension, 1e-6});
  }
}

void fill_summary(RunResult& run, double until) {
  run.summary = {{"schema", "perfora.evaluate/1"},
                 {"status", "completed"},
                 {"reason", "reached the wanted strain"},
                 {"first_peak_stress", peak_stress},
                 {"first_peak_strain", peak_strain},
                 {"energy_residual", 1e-4},
                 {"fragments", 95},
                 {"broken_bonds", 61234},
                 {"broken_in_tension", 50000},
                 {"broken_in_shear", 11234},
                 {"plateau_window", {0.2, 0.4}},
                 {"plateau_stress", nullptr},
                 {"densification_strain", nullptr},
                 {"largest_fragment_fraction", 0.08},
                 {"minimum_stress_in_window", 0.004e6},
                 {"undulation", 0.4}};
  if (until >= 0.4) run.summary["plateau_stress"] = plateau;
  if (until >= 0.5) run.summary["densification_strain"] = 0.463;
}

}  // namespace

SyntheticRun make_run(double size, int holes, double mean_diameter, double until, unsigned seed) {
  std::mt19937 engine(seed);
  SyntheticRun synthetic;
  RunResult& run = synthetic.run;
  run.path = "synthetic.h5";
  run.status = "completed";
  run.reason = "reached the wanted strain";
  run.provenance.program_version = "0.1.0";
  run.provenance.git_revision = "0000000";
  run.provenance.compiler = "g++";
  run.provenance.simd = "none";
  run.provenance.command_line = "perfora evaluate";
  run.provenance.threads = 2;
  run.provenance.results_version = 1;
  run.provenance.seconds = 12.5;
  run.provenance.seeds = R"({"packing": 11, "noise": 12, "layout": 13, "search": 14})";
  run.width = run.height = size;
  run.mean_diameter = mean_diameter;
  run.layout = make_layout(size, holes);
  run.clipped = clip(make_discs(size, mean_diameter, engine), run.layout);
  make_bonds(run, engine);
  fill_history(run, until, engine);
  fill_events(run, until, engine);
  fill_summary(run, until);
  run.provenance.config = "[cell]\nwidth = " + std::to_string(size) + "\n";
  int number = 0;
  for (double strain : {0.0, peak_strain, 0.1, 0.2, 0.3, 0.4, 0.5, 0.6}) {
    if (strain > until + 1e-9) break;
    synthetic.frames.push_back(make_frame(run, number++, strain, engine));
    run.frames.push_back(synthetic.frames.back().info);
  }
  return synthetic;
}

std::filesystem::path fresh_folder(const std::string& name) {
  const std::filesystem::path folder =
      std::filesystem::temp_directory_path() / ("perfora-report-" + name + "-" + std::to_string(::getpid()));
  // Gone with the program; each process has its own, as tests run side by side.
  static struct Made {
    std::vector<std::filesystem::path> folders;
    ~Made() {
      std::error_code ignored;
      for (const auto& one : folders) std::filesystem::remove_all(one, ignored);
    }
  } made;
  made.folders.push_back(folder);
  std::filesystem::remove_all(folder);
  std::filesystem::create_directories(folder);
  return folder;
}

void write_run(const SyntheticRun& synthetic, const std::filesystem::path& path) {
  std::vector<std::filesystem::path> frames;
  for (const Frame& frame : synthetic.frames) {
    frames.push_back(path.parent_path() / ("frame-" + frame.info.name + ".h5"));
    results::write_frame(frames.back(), frame);
  }
  results::write_run(path, synthetic.run, frames, &synthetic.run.clipped);
  for (const std::filesystem::path& frame : frames) std::filesystem::remove(frame);
}

void write_pack(const SyntheticRun& synthetic, const std::filesystem::path& path) {
  const RunResult& run = synthetic.run;
  results::write_pack(
      path, {path,
             run.provenance,
             run.clipped,
             run.clipped,
             run.layout,
             {{"schema", pack_format}, {"discs", 36607}, {"bonds_per_disc", 21.3}, {"thinnest_wall", 0.005}}});
}

}  // namespace perfora::results::testing
