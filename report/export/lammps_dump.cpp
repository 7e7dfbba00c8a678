// What is here: discs at every frame as LAMMPS text dump. What is not: bonds (lammps_data.cpp holds those of one
// moment). Format: LAMMPS manual, "dump" and "dump_modify" (units, time).
#include <fmt/format.h>

#include <cmath>
#include <iterator>

#include "io/files.h"
#include "report/export/lammps_box.h"
#include "report/export/registry.h"

namespace perfora::report {
namespace {

/// LAMMPS knows velocities by these names.
std::string dump_name(const std::string& name) {
  if (name == "velocity_x") return "vx";
  if (name == "velocity_y") return "vy";
  return name;
}

/// A step is a whole number: of the frames in their file, or, on an axis of strain, parts per million of it.
long long step_of(const Scene& scene, std::size_t k) {
  constexpr double steps_per_strain = 1e6;
  return scene.axis() == TimeAxis::strain ? std::llround(scene.info(k).strain * steps_per_strain)
                                          : static_cast<long long>(scene.number(k));
}

void write_box(fmt::memory_buffer& out, const LammpsBox& box) {
  const auto to = std::back_inserter(out);
  const char x = box.open_x ? 's' : 'p', y = box.open_y ? 's' : 'p';
  if (box.xy != 0.0) {
    // With a tilt the bounds are those of the tilted box as a whole.
    fmt::format_to(to, "ITEM: BOX BOUNDS xy xz yz {0}{0} {1}{1} pp\n", x, y);
    fmt::format_to(to, "{} {} {}\n{} {} 0\n-0.5 0.5 0\n", box.x_low + std::min(0.0, box.xy),
                   box.x_high + std::max(0.0, box.xy), box.xy, box.y_low, box.y_high);
    return;
  }
  fmt::format_to(to, "ITEM: BOX BOUNDS {0}{0} {1}{1} pp\n{2} {3}\n{4} {5}\n-0.5 0.5\n", x, y, box.x_low, box.x_high,
                 box.y_low, box.y_high);
}

}  // namespace

void write_lammps_dump(const Scene& scene, const std::filesystem::path& base) {
  require_frames(scene, "a dump");
  fmt::memory_buffer out;
  const auto to = std::back_inserter(out);
  for (std::size_t k = 0; k < scene.size(); ++k) {
    const Moment moment = scene.moment(k);
    if (k == 0) fmt::format_to(to, "ITEM: UNITS\nsi\n");
    fmt::format_to(to, "ITEM: TIME\n{}\nITEM: TIMESTEP\n{}\nITEM: NUMBER OF ATOMS\n{}\n", scene.axis_value(k),
                   step_of(scene, k), scene.discs());
    write_box(out, box_of(scene, moment));
    fmt::format_to(to, "ITEM: ATOMS id type x y z");
    for (const Column& column : moment.columns) fmt::format_to(to, " {}", dump_name(column.name));
    out.push_back('\n');
    for (std::size_t d = 0; d < scene.discs(); ++d) {
      fmt::format_to(to, "{} 1 {} {} 0", d + 1, moment.position[2 * d], moment.position[2 * d + 1]);
      for (const Column& column : moment.columns) add_value(out, ' ', column, d);
      out.push_back('\n');
    }
  }
  io::write_file(with_extension(base, ".dump"), {out.data(), out.size()});
}

}  // namespace perfora::report
