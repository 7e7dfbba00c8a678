// What is here: T.h5 read, checked and written. What is not: numbers read from its curves.
#include "results/material_file.h"

#include <fmt/format.h>

#include <cstdlib>

#include "geometry/packing_file.h"
#include "results/file_parts.h"
#include "results/formats.h"

namespace perfora::results {
namespace {

struct CurveColumn {
  const char* name;
  const char* units;
  std::vector<double> MaterialCurve::*values;
};
constexpr CurveColumn curve_columns[] = {
    {"strain", "", &MaterialCurve::strain},
    {"stress", "Pa", &MaterialCurve::stress},
    {"lateral_strain", "", &MaterialCurve::lateral_strain},
    {"lateral_stress", "Pa", &MaterialCurve::lateral_stress},
    {"damage", "J/m", &MaterialCurve::damage},
    {"work", "J/m", &MaterialCurve::work},
    {"cundall", "J/m", &MaterialCurve::cundall},
    {"broken_bonds", "", &MaterialCurve::broken_bonds},
};

}  // namespace

MaterialResult read_material_tests(const std::filesystem::path& path) {
  const io::Hdf5Reader file(path);
  require_format(file, material_format, "a file of material tests", "give the T.h5 of `perfora test`");
  MaterialResult result;
  result.path = path;
  result.provenance = read_provenance(file);
  result.sample = geometry::read_packing(file, "/sample");
  require_packing(file, "/sample", result.sample);
  for (const std::string& child : file.children("/tests")) {
    const std::string group = fmt::format("/tests/{}", child);
    const std::size_t dash = child.rfind('-');
    if (dash == std::string::npos || child.find_first_not_of("0123456789", dash + 1) != std::string::npos)
      refuse(file, group, "is not named after a test and a replicate", "as tension-000");
    MaterialTest test;
    test.name = child.substr(0, dash);
    test.replicate = std::atoi(child.substr(dash + 1).c_str());
    for (const CurveColumn& column : curve_columns) {
      const std::string dataset = group + "/curve/" + column.name;
      test.curve.*column.values = finite_doubles(file, dataset);
      require_size(file, dataset, test.curve.*column.values, test.curve.strain.size());
    }
    if (file.has(group + "/frame"))
      test.frame = read_frame_group(file, group + "/frame", read_frame_info(file, group + "/frame", child),
                                    result.sample.size());
    test.events = read_events(file, group + "/events", result.sample.size());
    result.tests.push_back(std::move(test));
  }
  result.summary = read_summary(file);
  return result;
}

void write_material_tests(const std::filesystem::path& path, const MaterialResult& result) {
  io::Hdf5Writer file(path);
  write_head(file, material_format, result.provenance, result.summary);
  geometry::write_packing(file, "/sample", result.sample);
  for (const MaterialTest& test : result.tests) {
    const std::string group = fmt::format("/tests/{}-{:03d}", test.name, test.replicate);
    for (const CurveColumn& column : curve_columns)
      file.dataset(group + "/curve/" + column.name, test.curve.*column.values, 0, column.units);
    if (!test.frame) continue;
    write_frame_group(file, group + "/frame", *test.frame);
    write_events(file, group + "/events", test.events);
  }
  file.commit();
}

}  // namespace perfora::results
