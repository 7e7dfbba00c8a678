// What is here: from a design to the blocks of its tolerance analysis. What is not: running them.
#include "optimize/campaign/tolerance.h"

#include <fmt/format.h>

#include <algorithm>
#include <optional>

#include "io/text.h"
#include "io/toml.h"
#include "optimize/campaign/table_file.h"
#include "results/target.h"

namespace perfora::optimize {
namespace {

namespace fs = std::filesystem;

/// Seeds of the blocks of a study's best design follow from its own at this replicate, which no study reaches.
constexpr int fresh_replicate = 2000000;
/// Of a design or of the folder of a study.
constexpr const char* best_design = "best.toml";

void describe(io::Schema& schema, ToleranceKeys& keys) {
  using io::Dimension;
  using io::Range;
  auto section = schema.section(
      "tolerance",
      "What a design is asked to bear: blocks with one deviation each beside blocks as it is. 0 leaves a "
      "deviation out.");
  section.path("design", keys.design, "Design file, or folder of a study, whose best design is taken");
  section.integer("replicates", keys.replicates, Range::at_least(1),
                  "Blocks of each kind; block r has the same seeds in all of them");
  section.real("until", keys.until, Dimension::ratio, Range{0.0, 1.0, false, true},
               "Strain to run to; 0: as the design says");
  section.real("hole_size", keys.hole_size, Dimension::length, Range::non_negative(),
               "Every hole is up to so much wider or narrower, each by itself");
  section.real("hole_position", keys.hole_position, Dimension::length, Range::non_negative(),
               "Every hole lies up to so far from its place, each by itself");
  section.real("grade", keys.grade, Dimension::ratio, Range{0.0, 1.0, false, true},
               "The material is so much stiffer and stronger, and as much weaker; no simulation is needed");
  section.real("tilt", keys.tilt, Dimension::angle, Range{0.0, 0.7, false, false},
               "The pattern is turned against the load, to either side in turn; of blocks between platens, with sides "
               "that are not periodic");
  section.real(
      "shear", keys.shear, Dimension::ratio, Range{0.0, 0.5, false, false},
      "The pattern leans sideways by so much of its height, to either side in turn; of blocks between platens");
  describe(section, keys.execution);
}

bool is_of_tolerance(const std::string& text) {
  return text.starts_with("tolerance.");
}

fs::path design_in(const fs::path& path) {
  std::error_code ignored;
  if (!fs::is_directory(path, ignored)) return path;
  if (!fs::exists(path / best_design))
    throw io::InputError({path.string(), 0, ""}, fmt::format("this folder holds no {}", best_design),
                         "a design file, or the folder of a study that has a best design",
                         "let the study go on with `perfora optimize ... --resume`");
  return path / best_design;
}

/// Seeds that a search has not used, with the holes where they are.
void take_fresh_seeds(Seeds& seeds) {
  const Seeds::Effective fresh = seeds.effective(fresh_replicate);
  seeds.packing = static_cast<std::int64_t>(fresh.packing);
  seeds.noise = static_cast<std::int64_t>(fresh.noise);
  seeds.layout = static_cast<std::int64_t>(fresh.layout);
}

struct ToleranceReader {
  fs::path path;
  Tolerance all;
  io::Schema schema;

  void read(const std::vector<std::string>& overrides) {
    describe(schema, all.keys);
    all.file = path;
    std::shared_ptr<DesignFile> start;
    bool fresh = fs::is_directory(path);
    const bool has_section = !fresh && [&] {
      for (const io::Entry& entry : io::read_toml(path))
        if (is_of_tolerance(entry.key)) return true;
      return false;
    }();
    if (has_section) {
      const TableFile file(path, {"tolerance", {"tolerance"}, {}}, schema, overrides);
      fresh = fs::is_directory(all.keys.design);
      start = file.start(all.keys.design.empty() ? all.keys.design : design_in(all.keys.design));
    } else {
      std::vector<std::string> of_design;
      for (const std::string& text : overrides) {
        if (is_of_tolerance(text))
          schema.set_override(text);
        else
          of_design.push_back(text);
      }
      start = std::make_shared<DesignFile>(design_in(path), of_design);
    }
    if (results::wishes(start->design().target).empty())
      throw io::InputError({path.string(), 0, "target.plateau_stress"}, "the design wishes nothing",
                           "a plateau stress, a curve or limits under [target]",
                           "add them, or give --set target.plateau_stress=VALUE");
    const Fidelity fidelity{"", changes_without_output(), all.keys.until};
    apply(fidelity, *start, {path.string(), 0, "tolerance.until"});
    if (fresh) take_fresh_seeds(start->design().seeds);
    all.sweep.start = start;
  }

  void add_block(SweepCase made) {
    made.number = static_cast<int>(all.sweep.cases.size());
    all.sweep.cases.push_back(std::move(made));
  }

  /// Grade, and everything where the holes are all that changes.
  void add(Deviation deviation, const std::string& label, double amount) {
    if (amount == 0.0) return;
    ToleranceCase one{deviation, label, amount, 0, why_not(deviation, *all.sweep.start)};
    if (one.left_out.empty()) one.number = static_cast<int>(all.sweep.cases.size());
    all.cases.push_back(one);
    if (!one.left_out.empty()) return;
    SweepCase made;
    made.label = label;
    const Seeds& seeds = all.sweep.start->design().seeds;
    Seeds draws;
    draws.seed = static_cast<std::int64_t>(seeds.effective(0).layout);
    const bool in_turn = deviation == Deviation::tilt || deviation == Deviation::shear;
    for (int replicate = 0; replicate < all.keys.replicates; ++replicate) {
      const double signed_amount = in_turn && replicate % 2 == 1 ? -amount : amount;
      // The noise stream of another seed is a seed like any other.
      const Design changed = deviated(*all.sweep.start, deviation, signed_amount, draws.effective(replicate).noise);
      made.of_replicate.push_back(std::make_shared<const Design>(changed));
      check(made, changed, replicate);
    }
    made.design = made.of_replicate.front();
    add_block(std::move(made));
  }

  void check(SweepCase& made, const Design& changed, int replicate) {
    try {
      DesignFile::of(changed, "tolerance").require_valid();
    } catch (const io::InputError& error) {
      if (!made.problem.empty()) return;
      made.problem = fmt::format("replicate {}: {}", replicate, error.problem());
      all.sweep.warnings.push_back(fmt::format("{} cannot be run: {}", made.label, made.problem));
    }
  }

  /// What is wished is what is looked at, as far as the picture has room.
  std::vector<std::string> drawn_measures(std::vector<std::string> usual) const {
    constexpr std::size_t most = 4;
    std::vector<std::string> wished;
    for (const results::Wish& wish : results::wishes(all.sweep.start->design().target))
      if (!wish.measure->of_packing() && wished.size() < most &&
          std::find(wished.begin(), wished.end(), wish.measure->key) == wished.end())
        wished.emplace_back(wish.measure->key);
    return wished.empty() ? std::move(usual) : wished;
  }

  void make_cases() {
    const ToleranceKeys& keys = all.keys;
    Sweep& sweep = all.sweep;
    sweep.file = path;
    sweep.keys.replicates = keys.replicates;
    sweep.keys.base = true;
    sweep.keys.execution = keys.execution;
    sweep.measures = drawn_measures(measures_in(sweep.keys.measures, {}));
    sweep.warnings = sweep.start->validate();
    SweepCase base;
    base.label = "the design itself";
    base.design = std::make_shared<const Design>(sweep.start->design());
    add_block(std::move(base));
    const auto text = [](double value, io::Dimension dimension) { return io::quantity(value, dimension); };
    add(Deviation::hole_size, "hole size +- " + text(keys.hole_size, io::Dimension::length), keys.hole_size);
    add(Deviation::hole_position, "hole position +- " + text(keys.hole_position, io::Dimension::length),
        keys.hole_position);
    add(Deviation::grade, "grade - " + text(keys.grade, io::Dimension::ratio), -keys.grade);
    add(Deviation::grade, "grade + " + text(keys.grade, io::Dimension::ratio), keys.grade);
    add(Deviation::tilt, "tilt +- " + text(keys.tilt, io::Dimension::angle), keys.tilt);
    add(Deviation::shear, "shear +- " + text(keys.shear, io::Dimension::ratio), keys.shear);
    if (all.cases.empty())
      throw io::InputError({path.string(), 0, "tolerance"}, "every deviation is 0", "", "give one of them a size");
  }
};

}  // namespace

Tolerance read_tolerance(const fs::path& path, const std::vector<std::string>& overrides) {
  ToleranceReader reader{path, {}, {}};
  reader.read(overrides);
  reader.make_cases();
  return std::move(reader.all);
}

std::string tolerance_reference() {
  ToleranceKeys keys;
  io::Schema schema;
  describe(schema, keys);
  return schema.reference();
}

}  // namespace perfora::optimize
