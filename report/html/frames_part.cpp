// What is here: a run's frames as the block viewer of a page takes them, and the sizes of the fragments in each. What
// is not: drawing them (viewer.js).
#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "io/text.h"
#include "report/block_picture.h"
#include "report/canvas.h"
#include "report/html/disc_pressure.h"
#include "report/html/packed.h"
#include "report/html/run_part.h"

namespace perfora::report {

using nlohmann::json;
using results::Frame;
using results::RunResult;

namespace {

constexpr std::uint8_t main_class = 0, crumb_class = 255;  ///< others: 1 + number of the fragment's colour
constexpr std::size_t sampled_bonds = 4000;
constexpr double byte_steps = 255.0;

struct Bounds {
  double x0 = 0.0, x1 = 0.0, y0 = 0.0, y1 = 0.0;
};

/// What all chosen frames hold, field by field.
struct Fields {
  std::vector<double> x, y, pressure;
  std::string fragment, damage;
};

std::uint8_t in_byte(double fraction) {
  return static_cast<std::uint8_t>(
      std::lround(byte_steps * std::clamp(std::isnan(fraction) ? 0.0 : fraction, 0.0, 1.0)));
}

/// The fraction of the area in fragments by the diameter of a disc of their area, in classes that double from the mean
/// disc diameter on; the last one holds the largest fragment alone.
json fragment_sizes(const RunResult& run, const Frame& frame, std::size_t classes) {
  std::int32_t last = 0;
  for (const std::int32_t fragment : frame.fragment) last = std::max(last, fragment);
  std::vector<double> area(static_cast<std::size_t>(last) + 1, 0.0);
  double total = 0.0;
  for (std::size_t d = 0; d < frame.fragment.size(); ++d) {
    const double disc = std::numbers::pi * run.clipped.radius[d] * run.clipped.radius[d];
    area[static_cast<std::size_t>(frame.fragment[d])] += disc;
    total += disc;
  }
  std::vector<double> fraction(classes + 1, 0.0);
  std::vector<int> count(classes + 1, 0);
  for (std::size_t fragment = 0; fragment < area.size(); ++fragment) {
    if (area[fragment] <= 0.0) continue;
    const double diameter = std::sqrt(4.0 * area[fragment] / std::numbers::pi);
    const double place = std::max(0.0, std::log2(diameter / run.mean_diameter) + 1.0);
    const std::size_t k = fragment == 0 ? classes : std::min(classes - 1, static_cast<std::size_t>(place));
    fraction[k] += area[fragment] / total;
    ++count[k];
  }
  return {{"fraction", numbers_or_null(fraction)}, {"count", count}};
}

/// Mean strength factor of each disc's bonds, and the range.
std::pair<std::vector<double>, std::pair<double, double>> disc_strengths(const RunResult& run) {
  std::vector<double> sum(run.clipped.radius.size(), 0.0), count(sum.size(), 0.0);
  for (std::size_t b = 0; b < run.bonds.size(); ++b)
    for (const std::size_t end : {2 * b, 2 * b + 1}) {
      sum[static_cast<std::size_t>(run.bonds.pairs[end])] += run.bonds.strength_factor[b];
      count[static_cast<std::size_t>(run.bonds.pairs[end])] += 1.0;
    }
  double low = 1e300, high = -1e300;
  for (std::size_t d = 0; d < sum.size(); ++d) {
    sum[d] = count[d] > 0.0 ? sum[d] / count[d] : 1.0;
    low = std::min(low, sum[d]);
    high = std::max(high, sum[d]);
  }
  return {sum, {low, high}};
}

/// Up to `most` of the run's frames: the first, the one at the first peak and the last stay, the others as evenly as
/// their number allows.
std::vector<std::size_t> chosen_frames(const RunResult& run, std::size_t most) {
  std::vector<std::size_t> chosen;
  const std::size_t count = run.frames.size();
  if (count <= most) {
    for (std::size_t k = 0; k < count; ++k) chosen.push_back(k);
    return chosen;
  }
  for (std::size_t k = 0; k < most; ++k) chosen.push_back(k * (count - 1) / std::max<std::size_t>(1, most - 1));
  return chosen;
}

Fields fields_of(const RunResult& run, const std::vector<std::size_t>& chosen, json& frames) {
  const NormalSprings springs = normal_springs(run);
  constexpr std::size_t size_classes = 8;
  Fields fields;
  json list = json::array();
  for (const std::size_t k : chosen) {
    const Frame frame = results::read_frame(run, k);
    const std::vector<int> colours =
        colour_fragments(frame, run.clipped.radius, static_cast<int>(palette::fragments().size()));
    for (std::size_t d = 0; d < run.clipped.radius.size(); ++d) {
      fields.x.push_back(frame.position[2 * d]);
      fields.y.push_back(frame.position[2 * d + 1]);
      const int colour = colours[static_cast<std::size_t>(frame.fragment[d])];
      fields.fragment += static_cast<char>(colour == main_colour   ? main_class
                                           : colour == dust_colour ? crumb_class
                                                                   : static_cast<std::uint8_t>(1 + colour));
      fields.damage += static_cast<char>(in_byte(frame.damage[d]));
    }
    const std::vector<double> pressure = disc_pressure(run, frame, springs);
    fields.pressure.insert(fields.pressure.end(), pressure.begin(), pressure.end());
    list.push_back({{"strain", frame.info.strain},
                    {"strain_text", io::quantity(frame.info.strain, io::Dimension::ratio)},
                    {"h", {frame.info.h_xx, frame.info.h_xy, frame.info.h_yy}},
                    {"fragments", fragment_sizes(run, frame, size_classes)}});
  }
  frames["list"] = list;
  frames["force_known"] = springs.stiffness > 0.0;
  std::vector<std::string> names;
  double from = run.mean_diameter;
  for (std::size_t k = 0; k < size_classes; ++k, from *= 2.0)
    names.push_back(k == 0                  ? "below " + io::quantity(from, io::Dimension::length)
                    : k + 1 == size_classes ? "from " + io::quantity(0.5 * from, io::Dimension::length)
                                            : io::quantities({0.5 * from, from}, io::Dimension::length, " to "));
  names.push_back("the largest");
  frames["size_classes"] = names;
  return fields;
}

/// A sample of the bonds, evenly over their list, with the strain at which each breaks (infinite: null).
void add_bonds(const RunResult& run, Part& part, json& frames) {
  const std::size_t all = run.bonds.size(), count = std::min(all, sampled_bonds);
  std::vector<double> broken(all, -1.0);
  for (const results::BreakEvent& event : run.events)
    if (event.bond >= 0 && static_cast<std::size_t>(event.bond) < all)
      broken[static_cast<std::size_t>(event.bond)] = event.strain;
  std::vector<std::vector<double>> columns(3);
  for (std::size_t k = 0; k < count; ++k) {
    const std::size_t b = k * all / count;
    columns[0].push_back(run.bonds.pairs[2 * b]);
    columns[1].push_back(run.bonds.pairs[2 * b + 1]);
    columns[2].push_back(broken[b]);
  }
  frames["bonds"] = {{"count", count}, {"of", all}, {"count_text", io::count(count)}, {"of_text", io::count(all)}};
  part.numbers["bonds"] = packed(floats(columns));
}

/// Pressures as bytes by the root of their size, so that weak chains show beside strong ones: 0 the largest tension,
/// 255 the largest compression; one in a hundred may lie beyond.
std::string pressure_bytes(const std::vector<double>& pressure, json& frames) {
  std::vector<double> sizes;
  sizes.reserve(pressure.size());
  for (const double value : pressure) sizes.push_back(std::abs(value));
  double largest = 0.0;
  if (!sizes.empty()) {
    const auto at = sizes.begin() + static_cast<std::ptrdiff_t>(sizes.size() * 99 / 100);
    std::nth_element(sizes.begin(), at, sizes.end());
    largest = *at;
  }
  frames["pressure_most"] = largest;
  frames["pressure_most_text"] = io::quantity(largest, io::Dimension::stress);
  std::string bytes;
  for (const double value : pressure) {
    const double root = largest > 0.0 ? std::sqrt(std::min(1.0, std::abs(value) / largest)) : 0.0;
    bytes += static_cast<char>(in_byte(0.5 + 0.5 * std::copysign(root, value)));
  }
  return bytes;
}

/// The frames of `chosen`, packed into part.numbers; returns how many characters they take.
std::size_t pack_frames(const RunResult& run, const std::vector<std::size_t>& chosen, Part& part, json& frames) {
  const std::size_t discs = run.clipped.radius.size();
  const Fields fields = fields_of(run, chosen, frames);
  const auto [left, right] = std::minmax_element(fields.x.begin(), fields.x.end());
  const auto [low, high] = std::minmax_element(fields.y.begin(), fields.y.end());
  const Bounds bounds{*left, *right, *low, *high};
  const Steps x = in_steps(fields.x, bounds.x0, bounds.x1), y = in_steps(fields.y, bounds.y0, bounds.y1);
  frames["x"] = {x.offset, x.step};
  frames["y"] = {y.offset, y.step};
  part.numbers["x"] = packed(differences(x.codes, discs));
  part.numbers["y"] = packed(differences(y.codes, discs));
  part.numbers["fragment"] = packed(fields.fragment);
  part.numbers["damage"] = packed(fields.damage);
  part.numbers["pressure"] = packed(pressure_bytes(fields.pressure, frames));
  std::size_t size = 0;
  for (const char* name : {"x", "y", "fragment", "damage", "pressure"}) size += part.numbers[name].size();
  return size;
}

}  // namespace

void add_frames(const RunResult& run, std::size_t most_bytes, Part& part) {
  constexpr std::size_t most_frames = 31, fewest_frames = 2;
  const std::size_t discs = run.clipped.radius.size();
  if (run.frames.empty() || discs == 0) return;
  json frames = {{"discs", discs}, {"of", run.frames.size()}, {"width", run.width}, {"height", run.height}};
  std::vector<std::size_t> chosen = chosen_frames(run, most_frames);
  for (std::size_t size = pack_frames(run, chosen, part, frames); size > most_bytes && chosen.size() > fewest_frames;
       size = pack_frames(run, chosen, part, frames))
    chosen =
        chosen_frames(run, std::max(fewest_frames, std::min(chosen.size() - 1, chosen.size() * most_bytes / size)));
  const auto largest = std::max_element(run.clipped.radius.begin(), run.clipped.radius.end());
  const Steps radius = in_steps(run.clipped.radius, 0.0, *largest);
  frames["radius"] = {radius.offset, radius.step};
  part.numbers["radius"] = packed(differences(radius.codes, discs));
  const auto [strengths, range] = disc_strengths(run);
  std::string bytes;
  for (const double value : strengths)
    bytes += static_cast<char>(
        in_byte(range.second > range.first ? (value - range.first) / (range.second - range.first) : 0.5));
  part.numbers["strength"] = packed(bytes);
  frames["strength"] = {io::number(range.first), io::number(range.second)};
  frames["edges"] = {{"platens", run.edges.platens}, {"walls", run.edges.walls}, {"free", run.edges.free}};
  json colours = json::array();
  for (const Colour& colour : palette::fragments())
    colours.push_back({std::lround(byte_steps * colour.red), std::lround(byte_steps * colour.green),
                       std::lround(byte_steps * colour.blue)});
  frames["fragment_colours"] = colours;
  add_bonds(run, part, frames);
  part.facts["frames"] = frames;
}

}  // namespace perfora::report
