// What is here: rims as lines and arcs of SVG; layouts from configurations. What is not: the layouts (geometry/).
#include "report/html/layout_path.h"

#include <fmt/format.h>

#include <cmath>
#include <numbers>

#include "geometry/layout.h"
#include "io/error.h"
#include "io/schema.h"
#include "io/toml.h"

namespace perfora::report {
namespace {

constexpr double in_mm = 1e3;

/// One closed rim; `top`: height of the cell, mm.
std::string rim(const geometry::Perforation& hole, double top) {
  constexpr double tolerance = 1e-5;  // m: below what a thumbnail shows
  std::string path;
  for (const geometry::Arc& arc : hole.outline(tolerance)) {
    const auto at = [&](double angle) {
      return fmt::format("{:.3f} {:.3f}", in_mm * (arc.centre.x + arc.radius * std::cos(angle)),
                         top - in_mm * (arc.centre.y + arc.radius * std::sin(angle)));
    };
    path += path.empty() ? 'M' : 'L';
    path += at(arc.from);
    if (arc.radius <= 0.0) continue;
    // Two halves: one arc of a full turn would have equal ends.
    const double middle = 0.5 * (arc.from + arc.to), r = in_mm * arc.radius;
    for (const double end : {middle, arc.to}) path += fmt::format("A{:.3f} {:.3f} 0 0 0 {}", r, r, at(end));
  }
  return path.empty() ? path : path + "Z";
}

}  // namespace

nlohmann::json layout_facts(const geometry::PerforationLayout& layout) {
  std::string path;
  for (const geometry::Perforation& hole : layout.cut_out(true, true)) path += rim(hole, in_mm * layout.height);
  return {{"width", in_mm * layout.width}, {"height", in_mm * layout.height}, {"path", path}};
}

std::optional<geometry::PerforationLayout> layout_of(const std::string& configuration, std::uint64_t seed) {
  try {
    geometry::LayoutOptions options;
    io::Schema schema;
    geometry::describe(schema, options);
    for (const io::Entry& entry : io::parse_toml(configuration, "configuration"))
      if (const io::Key* key = schema.find(entry.key)) key->set(entry.value, {"configuration", 0, entry.key});
    return geometry::place_perforations(options, seed);
  } catch (const io::InputError&) {
    return std::nullopt;
  }
}

}  // namespace perfora::report
