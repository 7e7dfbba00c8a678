// What is here: discs at every frame as extended XYZ. What is not: bonds. Format: libAtoms' extended XYZ, which OVITO
// and ase read: a comment line of key="value" with the cell and the names of the columns.
#include <fmt/format.h>

#include <algorithm>
#include <iterator>

#include "io/files.h"
#include "report/export/registry.h"

namespace perfora::report {

void write_xyz(const Scene& scene, const std::filesystem::path& base) {
  require_frames(scene, "XYZ");
  const double depth = scene.discs() == 0 ? 1.0 : 2.0 * *std::max_element(scene.radius().begin(), scene.radius().end());
  fmt::memory_buffer out;
  const auto to = std::back_inserter(out);
  for (std::size_t k = 0; k < scene.size(); ++k) {
    const Moment moment = scene.moment(k);
    fmt::format_to(
        to, "{}\nLattice=\"{} 0 0 {} {} 0 0 0 {}\" pbc=\"{} {} F\" Time={} strain={} Properties=species:S:1:pos:R:3",
        scene.discs(), moment.info.h_xx, moment.info.h_xy, moment.info.h_yy, depth, scene.edges().open_x() ? 'F' : 'T',
        scene.edges().platens ? 'F' : 'T', scene.axis_value(k), moment.info.strain);
    for (const Column& column : moment.columns) fmt::format_to(to, ":{}:{}:1", column.name, column.whole ? 'I' : 'R');
    out.push_back('\n');
    for (std::size_t d = 0; d < scene.discs(); ++d) {
      fmt::format_to(to, "X {} {} 0", moment.position[2 * d], moment.position[2 * d + 1]);
      for (const Column& column : moment.columns) add_value(out, ' ', column, d);
      out.push_back('\n');
    }
  }
  io::write_file(with_extension(base, ".xyz"), {out.data(), out.size()});
}

}  // namespace perfora::report
