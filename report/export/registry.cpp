// What is here: the entries of the list of exports. What is not: how a format is written (one file each).
#include "report/export/registry.h"

#include "io/error.h"
#include "report/export/xdmf.h"

namespace perfora::report {

std::span<const Export> exports() {
  static const std::vector<Export> list = {
      {"lammps-dump",
       ".dump",
       "LAMMPS text dump of the discs at every frame (OVITO, ase, pizza)",
       {},
       write_lammps_dump},
      {"lammps-data",
       ".data",
       "LAMMPS data file of discs and harmonic bonds before loading, or at --at (read_data, OVITO)",
       {},
       write_lammps_data},
      {"vtk", ".pvd", "VTK PolyData of discs, bonds and cell at every frame (ParaView, VisIt)", {".vtk/"}, write_vtk},
      {"xdmf", ".xdmf", "XDMF over the run file: discs, bonds and cell (ParaView)", {".xdmf.h5"}, write_xdmf_export},
      {"csv",
       ".discs.csv",
       "Tables of discs, bonds and contacts at every frame and of broken bonds (pandas, R, spreadsheets)",
       {".bonds.csv", ".contacts.csv", ".breaks.csv"},
       write_csv},
      {"xyz", ".xyz", "Extended XYZ of the discs at every frame (OVITO, ase)", {}, write_xyz},
  };
  return list;
}

std::filesystem::path with_extension(const std::filesystem::path& base, const std::string& extension) {
  std::filesystem::path path = base;
  path += extension;
  return path;
}

void require_frames(const Scene& scene, const char* format) {
  if (scene.size() > 0) return;
  throw io::InputError({scene.path().string(), 0, "/frames"},
                       std::string("the run kept no frames, which ") + format + " shows",
                       "a run with output.frames = \"few\" or \"all\"", "run the design again with frames");
}

void write_xdmf_export(const Scene& scene, const std::filesystem::path& base) {
  require_frames(scene, "XDMF");
  if (!scene.is_run())
    throw io::InputError({scene.path().string(), 0, ""}, "XDMF is written over a run file, and this is a packing", "",
                         "export a packing with --vtk");
  if (scene.chose_a_moment())
    throw io::InputError({"--at", 0, ""}, "XDMF shows every frame of a run file", "",
                         "leave --at out, or export --vtk");
  write_xdmf(scene.path(), with_extension(base, ".xdmf"), scene.axis());
}

}  // namespace perfora::report
