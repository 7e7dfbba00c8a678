// What is here: the design's table of keys and how a design file is read. What is not: checks across keys
// (design_checks.cpp).
#include "optimize/evaluate/design.h"

#include "io/toml.h"

namespace perfora::optimize {

namespace {

/// Largest seed: 2^53 - 1, exact in JSON.
constexpr double largest_seed = 9007199254740991.0;

void describe_seeds(io::Schema& schema, Seeds& seeds) {
  const io::Range range = io::Range::between(0.0, largest_seed);
  schema.section("seeds", "Random streams: all four follow from `seed` unless set apart. Never the clock.")
      .integer("seed", seeds.seed, range, "the number all streams are derived from")
      .integer("packing", seeds.packing, range, "seed of the disc packing; 0: from `seed`")
      .integer("noise", seeds.noise, range, "seed of the strength field; 0: from `seed`")
      .integer("layout", seeds.layout, range, "seed of random layouts and jitter; 0: from `seed`")
      .integer("search", seeds.search, range, "seed of the search; 0: from `seed`");
}

}  // namespace

void describe(io::Schema& schema, Design& design) {
  geometry::describe(schema, design.layout);
  geometry::describe(schema, design.packing);
  solver::describe(schema, design.solver);
  results::describe(schema, design.measures);
  results::describe(schema, design.target);
  describe_seeds(schema, design.seeds);
}

results::MeasuringFrame Design::measuring_frame() const {
  return results::measuring_frame(target, measures, layout.width * layout.height);
}

DesignFile::DesignFile() : design_(std::make_unique<Design>()), schema_(std::make_unique<io::Schema>()) {
  describe(*schema_, *design_);
}

DesignFile::DesignFile(const Design& design) : DesignFile() {
  *design_ = design;
}

DesignFile::DesignFile(const std::filesystem::path& path, const std::vector<std::string>& overrides) : DesignFile() {
  path_ = path;
  io::apply_toml(*schema_, path);
  for (const std::string& text : overrides) schema_->set_override(text);
  results::load_curve(design_->target);
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
  io::apply_entries(*result.schema_, io::parse_toml(text, name), name);
  return result;
}

std::string configuration_today(const std::string& stored) {
  try {
    return DesignFile::from_toml(stored, "stored configuration").schema().to_toml();
  } catch (const io::InputError&) {
    return stored;
  }
}

bool same_configuration(const std::string& stored, const DesignFile& design) {
  return configuration_today(stored) == design.schema().to_toml();
}

DesignFile DesignFile::clone() const {
  DesignFile copy(*design_);
  copy.schema_->take_origins(*schema_);
  copy.path_ = path_;
  return copy;
}

}  // namespace perfora::optimize
