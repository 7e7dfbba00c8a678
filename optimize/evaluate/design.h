// What is here: the design, all keys of a design file together, with its seeds; reading and writing it.
// What is not: what each key does (its own room).
#pragma once

#include <cstdint>
#include <filesystem>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "geometry/layout.h"
#include "geometry/make_packing.h"
#include "io/schema.h"
#include "results/evaluation.h"
#include "results/provenance.h"
#include "results/target.h"
#include "solver/options.h"

namespace perfora::optimize {

/// Four streams, all derived from `seed` unless set (> 0). Replicate r changes packing and noise only.
/// A stream's seed is splitmix64(splitmix64(seed) + name of the stream), cut to 53 bits so that JSON holds it exactly;
/// replicate 0 uses it as it is (so the seeds a result names can be given back as --packing-seed and so on), replicate
/// r > 0 uses splitmix64(splitmix64(it) + r), cut alike.
struct Seeds {
  static constexpr std::int64_t largest = (std::int64_t{1} << 53) - 1;  ///< exact in JSON and whatever reads it
  std::int64_t seed = 1;
  std::int64_t packing = 0, noise = 0, layout = 0, search = 0;  ///< 0: derived from `seed`

  using Effective = results::EffectiveSeeds;
  Effective effective(int replicate) const;
};

/// Every option of one design; plain, copyable.
struct Design {
  geometry::LayoutOptions layout;
  geometry::PackingOptions packing;
  solver::SolverOptions solver;
  results::MeasureOptions measures;
  results::Target target;
  Seeds seeds;

  /// What the curve of this design is measured by.
  results::MeasuringFrame measuring_frame() const;
};

/// Binds all sections: [cell] [layout] [packing] [material] [noise] [loading] [dynamics] [output] [measures] [target]
/// [seeds].
void describe(io::Schema& schema, Design& design);

/// What a design is checked for: a compression, or its packing and elastic response alone.
enum class Purpose { run, block };

/// A design with its table of keys (bound to it) and where each value came from.
class DesignFile {
 public:
  DesignFile();                               ///< defaults
  explicit DesignFile(const Design& design);  ///< a design with no file behind it
  /// The same as if a file `name` had set every key: each value is checked, and messages name that file.
  static DesignFile of(const Design& design, const std::string& name);
  explicit DesignFile(const std::filesystem::path& path, const std::vector<std::string>& overrides = {});
  /// From TOML text, such as schema().to_toml() gives; `name` stands for the file in messages.
  static DesignFile from_toml(const std::string& text, const std::string& name);

  /// An independent copy, with the origins of its values.
  DesignFile clone() const;

  Design& design() { return *design_; }
  const Design& design() const { return *design_; }
  io::Schema& schema() { return *schema_; }
  const io::Schema& schema() const { return *schema_; }
  /// What the file has as `title` at its top, otherwise its name without the ending; empty for defaults and text.
  const std::string& title() const { return title_; }
  void set_title(std::string title) { title_ = std::move(title); }
  /// The file it was read from; empty for defaults and text.
  const std::filesystem::path& path() const { return path_; }

  /// Everything that can be said without placing discs: ranges across keys, horizon against the thinnest wall,
  /// overlapping holes, too many holes. Throws io::InputError; returns warnings (walls thinner than 2 r_H, a coarse
  /// packing and what it costs, ...). An imported packing is read.
  std::vector<std::string> validate(Purpose purpose = Purpose::run) const;
  /// Throws as validate() does and warns of nothing: for designs that a search makes by the thousand.
  void require_valid(Purpose purpose = Purpose::run) const;

 private:
  std::unique_ptr<Design> design_;
  std::unique_ptr<io::Schema> schema_;
  std::filesystem::path path_;
  std::string title_;
};

/// The design without the places of its files whose content it knows: what tells designs apart.
Design without_places(Design design);

/// The first file of a design from a record or another host that does not hold what it held when the design was
/// written.
struct ChangedFile {
  std::string key, problem;  ///< "layout.file", a sentence; both empty where there is none
};
ChangedFile changed_file(const Design& design);

/// `stored`, the resolved configuration in a file or journal, as it tells designs apart: old names of keys resolved,
/// keys that it lacks at their defaults, without_places(); as it is where it holds keys that this program does not
/// know.
std::string comparable_configuration(const std::string& stored);
/// Whether `stored`, the resolved configuration in a file or journal, is that of `design`, its files wherever they lie.
bool same_configuration(const std::string& stored, const DesignFile& design);

using results::results_version;

}  // namespace perfora::optimize
