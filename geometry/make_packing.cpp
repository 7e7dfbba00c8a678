// What is here: the keys of [packing], how many discs there are, their start, and the two protocols.
// What is not: import of someone else's packing (import_packing.cpp), the minimisation (overlap_minimiser.cpp), the
// search for jamming (jam.cpp), clipping (clip.cpp).
#include "geometry/make_packing.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <numbers>
#include <string>

#include "geometry/clip.h"
#include "geometry/hilbert.h"
#include "geometry/jam.h"
#include "geometry/overlap_minimiser.h"
#include "geometry/packing.h"
#include "geometry/random.h"
#include "geometry/size_law.h"
#include "io/error.h"
#include "io/files.h"
#include "io/text.h"

namespace perfora::geometry {

namespace {

constexpr std::int64_t minimum_discs = 16;
/// The packing that estimates the jamming fraction: its standard deviation over seeds is about 0.001 at this size, and
/// the fraction does not depend on the seed of the packing requested, so that all replicates have equally many discs.
constexpr std::int64_t pilot_discs = 4000;
constexpr std::uint64_t pilot_seed = 1;
/// Neighbours at the start share their sizes out evenly: each block of this many along the Hilbert curve has one disc
/// of every size class.
constexpr std::size_t block_size = 64;
constexpr std::int64_t quench_iterations = 40000;

using Progress = std::function<void(double, const std::string&)>;

void refuse_unless(bool good, const char* key, const std::string& problem, const std::string& allowed,
                   const std::string& remedy) {
  if (!good) throw io::InputError({"", 0, std::string("packing.") + key}, problem, allowed, remedy);
}

std::string percent(double value) {
  return io::quantity(value, io::Dimension::ratio);
}

void check_options(const PackingOptions& options, double width, double height) {
  const auto positive = [](double value) { return std::isfinite(value) && value > 0.0; };
  refuse_unless(positive(width) && positive(height), "mean_diameter", "the cell has no size",
                "positive width and height", "set cell.width and cell.height");
  refuse_unless(positive(options.mean_diameter), "mean_diameter", "discs have no size", "a positive length",
                "give the mean diameter");
  refuse_unless(positive(options.maximum_diameter), "maximum_diameter", "discs have no size", "a positive length",
                "give the largest diameter");
  refuse_unless(std::isfinite(options.size_ratio) && options.size_ratio >= 1.0 && options.size_ratio <= 20.0,
                "size_ratio", "the largest diameter over the smallest is out of range", "1 to 20", "change size_ratio");
  refuse_unless(std::isfinite(options.solid_fraction) && options.solid_fraction >= 0.0 && options.solid_fraction < 1.0,
                "solid_fraction", "the solid fraction is out of range", "0 (what compaction reaches) to below 1",
                "change solid_fraction");
  refuse_unless(options.protocol == PackingProtocol::dilate || options.solid_fraction > 0.0, "solid_fraction",
                "a quench stops at a wanted solid fraction and there is none", "above 0 and below 1",
                "give solid_fraction or use protocol = \"dilate\"");
}

std::int64_t discs_for(double fraction, const SizeLaw& law, const PackingOptions& options, double width,
                       double height) {
  const double mean_area =
      0.25 * std::numbers::pi * law.mean_power(2) * options.maximum_diameter * options.maximum_diameter;
  const double count = std::round(fraction * width * height / mean_area);
  refuse_unless(count <= static_cast<double>(maximum_discs), "mean_diameter",
                "discs of this size fill the cell with more than " + std::to_string(maximum_discs) + " of them",
                "at most " + std::to_string(maximum_discs) + " discs",
                "raise mean_diameter and maximum_diameter or make the cell smaller");
  refuse_unless(count >= static_cast<double>(minimum_discs), "mean_diameter",
                "the cell holds fewer than " + std::to_string(minimum_discs) + " discs",
                "at least " + std::to_string(minimum_discs) + " discs",
                "lower mean_diameter and maximum_diameter or enlarge the cell");
  const double dense_fraction = std::sqrt(0.9 / fraction);  // at jamming the discs are this much larger
  const double side = largest_discs_along_a_side * dense_fraction * options.maximum_diameter;
  refuse_unless(std::min(width, height) >= side, "maximum_diameter", "the largest discs are too large for the cell",
                "at most 1/" +
                    std::to_string(static_cast<int>(std::ceil(largest_discs_along_a_side * dense_fraction))) +
                    " of its shorter side",
                "lower maximum_diameter or enlarge the cell");
  return static_cast<std::int64_t>(count);
}

/// One point in each of `count` equal parts of the rectangle, ordered along a Hilbert curve.
void scatter(SoftDiscs& discs, std::size_t count, std::uint64_t seed) {
  const std::size_t rows = std::max<std::size_t>(
      1, static_cast<std::size_t>(std::lround(std::sqrt(static_cast<double>(count) * discs.height / discs.width))));
  std::vector<double> x, y;
  for (std::size_t row = 0; row < std::min(rows, count); ++row) {
    const std::size_t used_rows = std::min(rows, count);
    const std::size_t first = row * count / used_rows, last = (row + 1) * count / used_rows;
    for (std::size_t k = first; k < last; ++k) {
      const auto u = uniform_pair(seed, RandomStream::disc_place, k);
      x.push_back((static_cast<double>(k - first) + u[0]) / static_cast<double>(last - first) * discs.width);
      y.push_back((static_cast<double>(row) + u[1]) / static_cast<double>(used_rows) * discs.height);
    }
  }
  for (std::size_t i : hilbert_order(x, y)) {
    discs.x.push_back(x[i]);
    discs.y.push_back(y[i]);
  }
}

/// Random order of 0..count-1 from stream positions first, first + 1, ...
std::vector<std::size_t> random_order(std::size_t count, std::uint64_t seed, std::uint64_t first) {
  std::vector<std::pair<double, std::size_t>> keyed(count);
  for (std::size_t k = 0; k < count; ++k) keyed[k] = {uniform_pair(seed, RandomStream::disc_order, first + k)[0], k};
  std::sort(keyed.begin(), keyed.end());
  std::vector<std::size_t> order(count);
  for (std::size_t k = 0; k < count; ++k) order[k] = keyed[k].second;
  return order;
}

/// Hands ascending sizes to consecutive places so that every block of block_size places gets one of each size class.
std::vector<double> deal_out(const std::vector<double>& ascending, std::uint64_t seed) {
  const std::size_t count = ascending.size(), blocks = (count + block_size - 1) / block_size;
  std::vector<std::vector<double>> block(blocks);
  for (std::size_t first = 0; first < count; first += blocks) {
    const std::vector<std::size_t> order = random_order(blocks, seed, first);
    for (std::size_t k = first; k < std::min(count, first + blocks); ++k)
      block[order[k - first]].push_back(ascending[k]);
  }
  std::vector<double> dealt;
  std::uint64_t stream = count + blocks;
  for (const std::vector<double>& members : block) {
    for (std::size_t k : random_order(members.size(), seed, stream)) dealt.push_back(members[k]);
    stream += members.size();
  }
  return dealt;
}

/// Sizes scaled to fill `fraction` of the cell exactly, at random places. Unit of length: the mean diameter.
SoftDiscs random_start(const SizeLaw& law, std::int64_t count, double fraction, double width, double height,
                       std::uint64_t seed) {
  SoftDiscs discs{width, height, {}, {}, {}};
  scatter(discs, static_cast<std::size_t>(count), seed);
  discs.radius = deal_out(sample_diameters(law, count, seed), seed);
  double area = 0.0;
  for (double r : discs.radius) area += std::numbers::pi * r * r;
  const double scale = std::sqrt(fraction * width * height / area);
  for (double& r : discs.radius) r *= scale;
  return discs;
}

double pilot_fraction(const SizeLaw& law, int threads) {
  const double assumed = 0.85;
  const double mean = law.mean_power(1);
  const double side = std::sqrt(pilot_discs * 0.25 * std::numbers::pi * law.mean_power(2) / (mean * mean) / assumed);
  OverlapMinimiser minimiser(random_start(law, pilot_discs, assumed, side, side, pilot_seed), threads);
  const JamResult jammed = jam(minimiser, 0.0, {});
  return assumed * jammed.scale * jammed.scale;
}

SizeLaw law_of(const PackingOptions& options) {
  return {size_law_exponent(options.mean_diameter, options.maximum_diameter, options.size_ratio), options.size_ratio};
}

Packing to_packing(const SoftDiscs& discs, double scale, double unit, double width, double height) {
  Packing packing;
  packing.width = width;
  packing.height = height;
  for (std::size_t i = 0; i < discs.x.size(); ++i) {
    const double x = discs.x[i] * unit, y = discs.y[i] * unit;
    packing.x.push_back(x < width ? x : 0.0);
    packing.y.push_back(y < height ? y : 0.0);
    packing.radius.push_back(discs.radius[i] * scale * unit);
  }
  return packing;
}

/// Measures the packing and says why it is not what was wanted.
void judge(Packing& packing, double wanted, double jamming_fraction, std::int64_t iterations, bool settled) {
  packing.quality = measure_packing(packing);
  packing.quality.jamming_fraction = jamming_fraction;
  packing.quality.iterations = iterations;
  packing.quality.reached = false;
  if (wanted > 0.0 && packing.quality.solid_fraction < wanted - 1e-9)
    packing.quality.reason = "wanted solid fraction " + percent(wanted) + ", compaction reached " +
                             percent(packing.quality.solid_fraction) +
                             ": lower packing.solid_fraction, or write 0 for what compaction reaches";
  else if (packing.quality.max_overlap_ratio > overlap_limit)
    packing.quality.reason = "largest overlap " + percent(packing.quality.max_overlap_ratio) +
                             " of the smaller diameter, limit " + percent(overlap_limit);
  else if (!settled)
    packing.quality.reason = "the minimiser stopped before the forces balanced";
  else
    packing.quality.reached = true;
}

Packing jam_and_dilate(SoftDiscs start, double wanted, double fraction, double unit, double width, double height,
                       int threads, const Progress& progress, const io::Cancellation& cancellation) {
  OverlapMinimiser minimiser(std::move(start), threads, cancellation);
  // Wanted radii are those of scale 1.
  const JamResult jammed = jam(minimiser, wanted > 0.0 ? 1.0 : 0.0, [&](double done) {
    if (progress) progress(done, "jamming " + std::to_string(minimiser.discs().x.size()) + " discs");
  });
  const double jamming_fraction = fraction * jammed.scale * jammed.scale;
  // Dilated below jamming; where more was wanted than was reached, the jammed state is given back.
  const bool dilated = wanted > 0.0 && wanted <= jamming_fraction;
  Packing packing = to_packing(minimiser.discs(), dilated ? 1.0 : jammed.scale, unit, width, height);
  judge(packing, wanted, jamming_fraction, jammed.iterations, jammed.reached || dilated);
  return packing;
}

Packing quench(SoftDiscs start, double wanted, double unit, double width, double height, int threads,
               const Progress& progress, const io::Cancellation& cancellation) {
  OverlapMinimiser minimiser(std::move(start), threads, cancellation);
  if (progress) progress(0.0, "quenching " + std::to_string(minimiser.discs().x.size()) + " discs");
  // Half the limit, so that rounding to metres cannot pass it; a force balance with larger overlaps will not get
  // better.
  const OverlapState state = minimiser.minimise(1.0, {1e-3, 0.5 * overlap_limit, quench_iterations});
  Packing packing = to_packing(minimiser.discs(), 1.0, unit, width, height);
  judge(packing, wanted, 0.0, state.iterations, true);
  return packing;
}

}  // namespace

void describe(io::Schema& schema, PackingOptions& options) {
  using io::Dimension;
  using io::Range;
  schema.section("packing", "The discs: periodic over the whole cell, before the holes are cut out.")
      .real("mean_diameter", options.mean_diameter, Dimension::length, Range::positive(),
            "Number mean of the diameters.")
      .real("maximum_diameter", options.maximum_diameter, Dimension::length, Range::positive(), "Largest diameter.")
      .real("size_ratio", options.size_ratio, Dimension::none, Range::between(1.0, 20.0),
            "Largest over smallest diameter; between them the number density is a power law.")
      .real("solid_fraction", options.solid_fraction, Dimension::ratio, {0.0, 1.0, false, true},
            "Area of the discs over area of the cell; 0: what compaction reaches (about 0.85).")
      .choice("protocol", options.protocol, {{"dilate", PackingProtocol::dilate}, {"quench", PackingProtocol::quench}},
              "How a wanted solid fraction is met: jam and then shrink all discs alike, or stop an overlap "
              "minimisation there.")
      .choice("clip", options.clip, {{"centre", ClipRule::centre}, {"whole", ClipRule::whole}},
              "A disc goes when its centre lies in a hole, or when any of it does.")
      .file("file", options.file, options.file_checksum,
            "Discs to import instead of making a packing: CSV (x, y, radius or diameter; metres, or units in the "
            "header), LAMMPS text dump (its last frame) or data file.")
      .choice("file_plane", options.file_plane,
              {{"xy", ImportPlane::xy}, {"xz", ImportPlane::xz}, {"yz", ImportPlane::yz}},
              "Plane of the file that is the block's: its first axis is the width, its second the height.")
      .text("file_unit", options.file_unit,
            "Unit of the file's lengths, such as \"mm\"; empty: as the file says, CSV without units in metres.");
}

PackingKey packing_key(const PackingOptions& options, double width, double height, std::uint64_t seed) {
  PackingKey key;
  key.width = width;
  key.height = height;
  if (!options.file.empty()) {
    key.protocol = "imported";
    key.source = io::content_checksum(options.file);
    if (options.file_plane != ImportPlane::xy) key.source += options.file_plane == ImportPlane::xz ? " xz" : " yz";
    if (!options.file_unit.empty()) key.source += " " + options.file_unit;
    return key;
  }
  key.mean_diameter = options.mean_diameter;
  key.maximum_diameter = options.maximum_diameter;
  key.size_ratio = options.size_ratio;
  key.solid_fraction = options.solid_fraction;
  key.protocol = options.protocol == PackingProtocol::quench ? "quench" : "dilate";
  key.seed = seed;
  key.algorithm_version = packing_algorithm_version;
  return key;
}

std::int64_t expected_discs(const PackingOptions& options, double width, double height) {
  check_options(options, width, height);
  const SizeLaw law = law_of(options);
  discs_for(options.solid_fraction > 0.0 ? options.solid_fraction : 0.85, law, options, width,
            height);  // before the pilot costs time
  return discs_for(options.solid_fraction > 0.0 ? options.solid_fraction : pilot_fraction(law, 1), law, options, width,
                   height);
}

Packing make_packing(const PackingOptions& options, double width, double height, std::uint64_t seed, int threads,
                     const Progress& progress, const io::Cancellation& cancellation) {
  if (!options.file.empty()) return import_packing(options, width, height);
  const std::int64_t count = expected_discs(options, width, height);
  const SizeLaw law = law_of(options);
  const double unit = options.mean_diameter;
  const double wanted = options.solid_fraction;
  // Sizes fill the wanted fraction exactly; without one they have exactly the wanted mean, and jamming scales them a
  // little.
  const double mean_square = law.mean_power(2) / (law.mean_power(1) * law.mean_power(1));
  const double natural =
      static_cast<double>(count) * 0.25 * std::numbers::pi * mean_square * unit * unit / (width * height);
  const double fraction = wanted > 0.0 ? wanted : natural;
  SoftDiscs start = random_start(law, count, fraction, width / unit, height / unit, seed);
  Packing packing =
      options.protocol == PackingProtocol::quench
          ? quench(std::move(start), wanted, unit, width, height, threads, progress, cancellation)
          : jam_and_dilate(std::move(start), wanted, fraction, unit, width, height, threads, progress, cancellation);
  packing.key = packing_key(options, width, height, seed);
  if (progress) progress(1.0, packing.quality.reached ? "packed" : packing.quality.reason);
  return packing;
}

}  // namespace perfora::geometry
