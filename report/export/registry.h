// What is here: the one list of exports of result files to formats of other programs. What is not: the command
// (app/export.cpp), what a file holds (scene.h).
#pragma once

#include <filesystem>
#include <span>
#include <string>
#include <vector>

#include "report/export/scene.h"

namespace perfora::report {

/// One format. `base` is the path of the output without an extension.
struct Export {
  const char* name;       ///< of the flag, without its dashes: "lammps-dump"
  const char* extension;  ///< of its file, or of the first of them: ".dump"
  const char* help;       ///< one clause for the flag
  /// The files beside the first one, or a folder of them (with a slash at its end).
  std::vector<std::string> others;
  /// Writes all of them, whole. Throws io::InputError where the scene has not got what the format needs.
  void (*write)(const Scene& scene, const std::filesystem::path& base);
};

/// All exports, in the order in which the help lists them.
std::span<const Export> exports();

/// base + "extension", whatever dots the name of base holds.
std::filesystem::path with_extension(const std::filesystem::path& base, const std::string& extension);

/// Throws io::InputError where the scene has no frames: `format` is what needs them.
void require_frames(const Scene& scene, const char* format);

void write_lammps_dump(const Scene& scene, const std::filesystem::path& base);
void write_lammps_data(const Scene& scene, const std::filesystem::path& base);
void write_vtk(const Scene& scene, const std::filesystem::path& base);
void write_csv(const Scene& scene, const std::filesystem::path& base);
void write_xyz(const Scene& scene, const std::filesystem::path& base);
void write_xdmf_export(const Scene& scene, const std::filesystem::path& base);

}  // namespace perfora::report
