// What is here: packings and layouts in HDF5 files as docs/user/formats.md says, and the comparison of keys.
// What is not: HDF5 itself (io/hdf5.h).
#include "geometry/packing_file.h"

#include "io/error.h"
#include "io/text.h"

namespace perfora::geometry {

namespace {

PackingKey read_key(const io::Hdf5Reader& file, const std::string& group) {
  PackingKey key;
  key.width = file.attribute_double(group, "width");
  key.height = file.attribute_double(group, "height");
  key.mean_diameter = file.attribute_double(group, "mean_diameter");
  key.maximum_diameter = file.attribute_double(group, "maximum_diameter");
  key.size_ratio = file.attribute_double(group, "size_ratio");
  key.solid_fraction = file.attribute_double(group, "solid_fraction");
  key.protocol = file.attribute_text(group, "protocol");
  key.seed = static_cast<std::uint64_t>(file.attribute_int(group, "seed"));
  key.algorithm_version = static_cast<int>(file.attribute_int(group, "algorithm_version"));
  key.source = file.attribute_text(group, "source");
  return key;
}

PackingQuality read_quality(const io::Hdf5Reader& file, const std::string& group) {
  PackingQuality quality;
  quality.solid_fraction = file.attribute_double(group, "quality_solid_fraction");
  quality.jamming_fraction = file.attribute_double(group, "jamming_fraction");
  quality.max_overlap_ratio = file.attribute_double(group, "max_overlap_ratio");
  quality.coordination_number = file.attribute_double(group, "coordination_number");
  quality.rattler_fraction = file.attribute_double(group, "rattler_fraction");
  quality.iterations = file.attribute_int(group, "iterations");
  quality.reached = file.attribute_int(group, "reached") != 0;
  quality.reason = file.attribute_text(group, "reason");
  return quality;
}

/// A file made or changed by someone else: arrays must be equally long, finite and within the cell.
void check_arrays(const io::Hdf5Reader& file, const std::string& group, const char* size_name, double width,
                  double height, const std::vector<double>& x, const std::vector<double>& y,
                  const std::vector<double>& size) {
  const io::Origin origin{file.path().string(), 0, group};
  if (x.size() != y.size() || x.size() != size.size())
    throw io::InputError(origin, std::string("x, y and ") + size_name + " are not equally long", "arrays of one length",
                         "make the file again");
  if (!(width > 0.0 && height > 0.0))
    throw io::InputError(origin, "the cell has no size", "positive width and height", "make the file again");
  for (std::size_t i = 0; i < x.size(); ++i)
    if (!(x[i] >= 0.0 && x[i] < width && y[i] >= 0.0 && y[i] < height && size[i] > 0.0 && size[i] < width + height))
      throw io::InputError(origin, "entry " + std::to_string(i) + " does not lie in the cell or has no size",
                           "centres in the cell and a positive " + std::string(size_name), "make the file again");
}

}  // namespace

void write_packing(io::Hdf5Writer& file, const std::string& group, const Packing& packing) {
  file.group(group);
  file.dataset(group + "/x", std::span<const double>(packing.x), 0, "m");
  file.dataset(group + "/y", std::span<const double>(packing.y), 0, "m");
  file.dataset(group + "/radius", std::span<const double>(packing.radius), 0, "m");
  const PackingKey& key = packing.key;
  file.attribute(group, "width", packing.width);
  file.attribute(group, "height", packing.height);
  file.attribute(group, "mean_diameter", key.mean_diameter);
  file.attribute(group, "maximum_diameter", key.maximum_diameter);
  file.attribute(group, "size_ratio", key.size_ratio);
  file.attribute(group, "solid_fraction", key.solid_fraction);
  file.attribute(group, "protocol", key.protocol);
  file.attribute(group, "seed", static_cast<std::int64_t>(key.seed));
  file.attribute(group, "algorithm_version", static_cast<std::int64_t>(key.algorithm_version));
  file.attribute(group, "source", key.source);
  const PackingQuality& quality = packing.quality;
  file.attribute(group, "quality_solid_fraction", quality.solid_fraction);
  file.attribute(group, "jamming_fraction", quality.jamming_fraction);
  file.attribute(group, "max_overlap_ratio", quality.max_overlap_ratio);
  file.attribute(group, "coordination_number", quality.coordination_number);
  file.attribute(group, "rattler_fraction", quality.rattler_fraction);
  file.attribute(group, "iterations", quality.iterations);
  file.attribute(group, "reached", static_cast<std::int64_t>(quality.reached));
  file.attribute(group, "reason", quality.reason);
}

namespace {

/// The cores of holes that are no circles, one after another.
struct Cores {
  std::vector<double> radius, corners;  ///< of circles radius 0; x, y of each corner relative to the centre
  std::vector<std::int64_t> first;      ///< of each hole its first corner, and their number at the end
};

void write_cores(io::Hdf5Writer& file, const std::string& group, const PerforationLayout& layout) {
  Cores cores;
  for (const Perforation& hole : layout.perforations) {
    const auto* polygon = std::get_if<RoundedPolygon>(&hole.shape);
    cores.first.push_back(static_cast<std::int64_t>(cores.corners.size() / 2));
    cores.radius.push_back(polygon ? polygon->radius : 0.0);
    if (!polygon) continue;
    for (const Point& corner : polygon->core->corners())
      cores.corners.insert(cores.corners.end(), {corner.x, corner.y});
  }
  cores.first.push_back(static_cast<std::int64_t>(cores.corners.size() / 2));
  if (cores.corners.empty()) return;
  file.dataset(group + "/radius", std::span<const double>(cores.radius), 0, "m");
  file.dataset(group + "/first_corner", std::span<const std::int64_t>(cores.first));
  file.dataset(group + "/corners", std::span<const double>(cores.corners), 2, "m");
}

/// The holes that have corners take the shape that these say.
void read_cores(const io::Hdf5Reader& file, const std::string& group, PerforationLayout& layout) {
  if (!file.has(group + "/corners")) return;
  const std::vector<double> radius = file.doubles(group + "/radius"), first = file.doubles(group + "/first_corner"),
                            corners = file.doubles(group + "/corners");
  const std::size_t holes = layout.perforations.size(), pairs = corners.size() / 2;
  bool good = radius.size() == holes && first.size() == holes + 1 && corners.size() % 2 == 0;
  for (std::size_t k = 0; good && k < holes; ++k) {
    good = first[k] >= 0.0 && first[k] <= first[k + 1] && first[k + 1] <= static_cast<double>(pairs);
    if (!good || first[k] == first[k + 1]) continue;
    std::vector<Point> core;
    for (auto c = static_cast<std::size_t>(first[k]); c < static_cast<std::size_t>(first[k + 1]); ++c)
      core.push_back({corners[2 * c], corners[2 * c + 1]});
    auto polygon = polygon_of(std::move(core), radius[k]);
    good = polygon.has_value();
    if (good) layout.perforations[k].shape = std::move(*polygon);
  }
  if (!good)
    throw io::InputError({file.path().string(), 0, group}, "the corners of the holes are no outlines",
                         "simple polygons, one after another", "make the file again");
}

}  // namespace

void write_layout(io::Hdf5Writer& file, const std::string& group, const PerforationLayout& layout) {
  std::vector<double> x, y, diameter;
  for (const Perforation& hole : layout.perforations) {
    x.push_back(hole.x);
    y.push_back(hole.y);
    diameter.push_back(hole.largest_extent());
  }
  file.group(group);
  file.dataset(group + "/x", std::span<const double>(x), 0, "m");
  file.dataset(group + "/y", std::span<const double>(y), 0, "m");
  file.dataset(group + "/diameter", std::span<const double>(diameter), 0, "m");
  write_cores(file, group, layout);
  file.attribute(group, "width", layout.width);
  file.attribute(group, "height", layout.height);
}

Packing read_packing(const io::Hdf5Reader& file, const std::string& group) {
  Packing packing;
  packing.key = read_key(file, group);
  packing.quality = read_quality(file, group);
  packing.width = packing.key.width;
  packing.height = packing.key.height;
  packing.x = file.doubles(group + "/x");
  packing.y = file.doubles(group + "/y");
  packing.radius = file.doubles(group + "/radius");
  check_arrays(file, group, "radius", packing.width, packing.height, packing.x, packing.y, packing.radius);
  return packing;
}

PerforationLayout read_layout(const io::Hdf5Reader& file, const std::string& group) {
  PerforationLayout layout{file.attribute_double(group, "width"), file.attribute_double(group, "height"), {}};
  const std::vector<double> x = file.doubles(group + "/x"), y = file.doubles(group + "/y"),
                            diameter = file.doubles(group + "/diameter");
  check_arrays(file, group, "diameter", layout.width, layout.height, x, y, diameter);
  for (std::size_t k = 0; k < x.size(); ++k) layout.perforations.push_back({x[k], y[k], Circle{diameter[k]}});
  read_cores(file, group, layout);
  return layout;
}

void require_same_key(const PackingKey& wanted, const PackingKey& found, const std::filesystem::path& file) {
  const auto compare = [&file](const char* key, const auto& design, const auto& stored, auto text) {
    if (design == stored) return;
    throw io::InputError({file.string(), 0, key},
                         "the packing in the file has " + text(stored) + ", the design asks for " + text(design),
                         "a packing made for this design",
                         "make the packing again with perfora pack, or change the design");
  };
  const auto quoted = [](const std::string& value) { return "\"" + value + "\""; };
  const auto whole = [](auto value) { return std::to_string(value); };
  const auto length = [](double value) { return io::shortest(io::rounded(1e3 * value)) + " mm"; };
  compare("packing.protocol", wanted.protocol, found.protocol, quoted);
  compare("packing.file", wanted.source, found.source, quoted);
  compare("cell.width", wanted.width, found.width, length);
  compare("cell.height", wanted.height, found.height, length);
  compare("packing.mean_diameter", wanted.mean_diameter, found.mean_diameter, length);
  compare("packing.maximum_diameter", wanted.maximum_diameter, found.maximum_diameter, length);
  compare("packing.size_ratio", wanted.size_ratio, found.size_ratio, io::shortest);
  compare("packing.solid_fraction", wanted.solid_fraction, found.solid_fraction, io::shortest);
  compare("seeds.packing", wanted.seed, found.seed, whole);
  compare("algorithm_version", wanted.algorithm_version, found.algorithm_version, whole);
}

}  // namespace perfora::geometry
