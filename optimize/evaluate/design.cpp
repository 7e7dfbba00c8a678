// What is here: the design's table of keys and how a design file is read. What is not: checks across keys
// (design_checks.cpp).
#include "optimize/evaluate/design.h"

#include <algorithm>
#include <utility>

#include "io/files.h"
#include "io/toml.h"
#include "optimize/evaluate/calibrated_material.h"
#include "results/curve_file.h"
#include "results/describe.h"

namespace perfora::optimize {

namespace {

void describe_seeds(io::Schema& schema, Seeds& seeds) {
  const io::Range range = io::Range::between(0.0, static_cast<double>(Seeds::largest));
  schema.section("seeds", "Random streams: all four follow from `seed` unless set apart. Never the clock.")
      .integer("seed", seeds.seed, range, "the number all streams are derived from")
      .integer("packing", seeds.packing, range, "seed of the disc packing; 0: from `seed`")
      .integer("noise", seeds.noise, range, "seed of the strength field; 0: from `seed`")
      .integer("layout", seeds.layout, range, "seed of random layouts and jitter; 0: from `seed`")
      .integer("search", seeds.search, range, "seed of the search; 0: from `seed`");
}

/// A mortar is known by what is measured on it, and [material] holds what discs need: the way from one to the other.
void refuse_measured_strengths(io::Schema& schema) {
  for (const char* measured : {"young_modulus", "poisson_ratio", "tensile_strength", "compressive_strength"})
    schema.no_key({std::string("material.") + measured, "unknown key in [material]: it is measured on specimens",
                   "`perfora calibrate` finds the keys that give it, and from = \"calibrated.toml\" takes them "
                   "(docs/user/tutorial-mortar.md)"});
}

/// A material is taken over first, wherever the line stands, so that what the design says itself comes after it.
std::vector<io::Entry> material_first(std::vector<io::Entry> entries) {
  std::stable_partition(entries.begin(), entries.end(),
                        [](const io::Entry& entry) { return entry.key == "material.from"; });
  return entries;
}

}  // namespace

void describe(io::Schema& schema, Design& design) {
  geometry::describe(schema, design.layout);
  geometry::describe(schema, design.packing);
  solver::describe(schema, design.solver);
  results::describe(schema, design.measures);
  results::describe(schema, design.target);
  schema.section("material", "")
      .source(
          "from",
          [&schema](const std::filesystem::path& path, const io::Origin& origin) {
            apply_calibrated_material(schema, path, origin);
          },
          "File of a calibrated material (calibrated.toml of perfora calibrate): its [material], [packing] and [noise] "
          "are taken over; what the design says of them itself, or what is set later, counts more.");
  refuse_measured_strengths(schema);
  describe_seeds(schema, design.seeds);
}

results::MeasuringFrame Design::measuring_frame() const {
  return results::measuring_frame(target, measures, layout.cell_width() * layout.cell_height());
}

DesignFile::DesignFile() : design_(std::make_unique<Design>()), schema_(std::make_unique<io::Schema>()) {
  describe(*schema_, *design_);
}

DesignFile::DesignFile(const Design& design) : DesignFile() {
  *design_ = design;
}

DesignFile::DesignFile(const std::filesystem::path& path, const std::vector<std::string>& overrides) : DesignFile() {
  path_ = path;
  const std::vector<io::Entry> entries = io::read_toml(path);
  results::require_kind(entries, path, "design");
  io::apply_entries(*schema_, material_first(entries), path.string());
  title_ = io::title_in(entries);
  if (title_.empty()) title_ = path.stem().string();
  for (const std::string& text : overrides) schema_->set_override(text);
  for (const io::Key& key : schema_->keys())
    if (key.type == io::KeyType::path)
      io::require_existing(std::get<std::string>(key.get().data), schema_->origin(key.full_name()));
  // What is wrong with a measured curve is said before a run, not when its picture is drawn.
  if (const std::filesystem::path& curve = design_->solver.output.curve; !curve.empty())
    static_cast<void>(results::read_curve(curve));
}

DesignFile DesignFile::of(const Design& design, const std::string& name) {
  const DesignFile source(design);
  DesignFile result;
  for (const io::Key& key : source.schema().keys())
    result.schema().set(key.full_name(), key.get(), {name, 0, key.full_name()});
  return result;
}

DesignFile DesignFile::from_toml(const std::string& text, const std::string& name) {
  DesignFile result;
  io::apply_entries(*result.schema_, material_first(io::parse_toml(text, name)), name);
  return result;
}

Design without_places(Design design) {
  geometry::LayoutOptions& layout = design.layout;
  if (!layout.outline_checksum.empty()) layout.outline.clear();
  if (!layout.file_checksum.empty()) layout.file.clear();
  if (!design.packing.file_checksum.empty()) design.packing.file.clear();
  return design;
}

std::string comparable_configuration(const std::string& stored) {
  try {
    const DesignFile file = DesignFile::from_toml(stored, "stored configuration");
    return DesignFile(without_places(file.design())).schema().to_toml();
  } catch (const io::InputError&) {
    return stored;
  }
}

bool same_configuration(const std::string& stored, const DesignFile& design) {
  return comparable_configuration(stored) == DesignFile(without_places(design.design())).schema().to_toml();
}

DesignFile DesignFile::clone() const {
  DesignFile copy(*design_);
  copy.schema_->take_origins(*schema_);
  copy.path_ = path_;
  copy.title_ = title_;
  return copy;
}

}  // namespace perfora::optimize
