// What is here: the XDMF file and its companion. What is not: reading of R.h5 (results/run_file.h).
// What ParaView 5.11 needs was tried file by file: points need an explicit connectivity, HyperSlab items lose their
// geometry, so each frame names datasets of its own.
#include "report/export/xdmf.h"

#include <fmt/format.h>

#include <cmath>
#include <numeric>
#include <string>
#include <vector>

#include "io/files.h"
#include "io/hdf5.h"
#include "report/export/xml.h"
#include "results/frame.h"
#include "results/run_file.h"

namespace perfora::report {
namespace {

enum class Number { int32, float64 };

std::string item(Number number, const std::string& dimensions, const std::string& reference) {
  const bool is_integer = number == Number::int32;
  return fmt::format(R"(<DataItem Format="HDF" NumberType="{}" Precision="{}" Dimensions="{}">{}</DataItem>)",
                     is_integer ? "Int" : "Float", is_integer ? 4 : 8, dimensions, reference);
}

std::string attribute(const std::string& name, const char* centre, const std::string& data) {
  return fmt::format("        <Attribute Name=\"{}\" AttributeType=\"Scalar\" Center=\"{}\">{}</Attribute>\n", name,
                     centre, data);
}

/// results::Bonds as they lie in the picture.
struct Lines {
  std::vector<std::int32_t> pairs;
  std::vector<double> damage;
};

/// Without the bonds that reach across the periodic boundary.
Lines lines_of(const results::Frame& frame) {
  Lines lines;
  for (const std::size_t b : bonds_inside(frame.info, frame.position, frame.bond_pairs)) {
    lines.pairs.insert(lines.pairs.end(), {frame.bond_pairs[2 * b], frame.bond_pairs[2 * b + 1]});
    lines.damage.push_back(frame.bond_damage[b]);
  }
  return lines;
}

/// File names as the XDMF file writes them, and sizes.
struct Names {
  std::string run, companion;
  std::int32_t discs = 0;
  TimeAxis axis = TimeAxis::time;
};

/// One grid at one time. `body`: topology, geometry, attributes.
std::string grid(const char* name, TimeAxis axis, const results::FrameInfo& frame, const std::string& body) {
  return fmt::format("      <Grid Name=\"{}\" GridType=\"Uniform\">\n        <Time Value=\"{}\"/>\n{}      </Grid>\n",
                     name, axis == TimeAxis::strain ? frame.strain : frame.time, body);
}

std::string topology(const char* type, std::size_t cells, int nodes, const std::string& data) {
  return fmt::format(
      "        <Topology TopologyType=\"{}\" NumberOfElements=\"{}\" NodesPerElement=\"{}\">{}</Topology>\n", type,
      cells, nodes, data);
}

std::string geometry_of(const Names& names, const results::FrameInfo& frame) {
  return "        <Geometry GeometryType=\"XY\">" +
         item(Number::float64, std::to_string(names.discs) + " 2",
              names.run + ":/frames/" + frame.name + "/discs/position") +
         "</Geometry>\n";
}

std::string discs_grid(const Names& names, const results::FrameInfo& frame) {
  const std::string n = std::to_string(names.discs);
  const std::string group = names.run + ":/frames/" + frame.name + "/discs/";
  return grid("discs", names.axis, frame,
              topology("Polyvertex", static_cast<std::size_t>(names.discs), 1,
                       item(Number::int32, n + " 1", names.companion + ":/discs/connectivity")) +
                  geometry_of(names, frame) +
                  attribute("radius", "Node", item(Number::float64, n, names.run + ":/clipped/radius")) +
                  attribute("angle", "Node", item(Number::float64, n, group + "angle")) +
                  attribute("fragment", "Node", item(Number::int32, n, group + "fragment")) +
                  attribute("damage", "Node", item(Number::float64, n, group + "damage")));
}

std::string bonds_grid(const Names& names, const results::FrameInfo& frame, std::size_t bonds) {
  const std::string m = std::to_string(bonds);
  const std::string group = names.companion + ":/frames/" + frame.name + "/bonds/";
  return grid("bonds", names.axis, frame,
              topology("Polyline", bonds, 2, item(Number::int32, m + " 2", group + "pairs")) +
                  geometry_of(names, frame) + attribute("damage", "Cell", item(Number::float64, m, group + "damage")));
}

std::string inline_item(Number number, const char* dimensions, const std::string& values) {
  const bool is_integer = number == Number::int32;
  return fmt::format(R"(<DataItem Format="XML" NumberType="{}" Precision="{}" Dimensions="{}">{}</DataItem>)",
                     is_integer ? "Int" : "Float", is_integer ? 4 : 8, dimensions, values);
}

std::string cell_grid(TimeAxis axis, const results::FrameInfo& cell) {
  const std::string corners =
      fmt::format("0 0 {0} 0 {1} {2} {3} {2}", cell.h_xx, cell.h_xx + cell.h_xy, cell.h_yy, cell.h_xy);
  return grid("cell", axis, cell,
              topology("Polyline", 1, 5, inline_item(Number::int32, "1 5", "0 1 2 3 0")) +
                  "        <Geometry GeometryType=\"XY\">" + inline_item(Number::float64, "4 2", corners) +
                  "</Geometry>\n" +
                  attribute("strain", "Cell", inline_item(Number::float64, "1", fmt::format("{}", cell.strain))));
}

/// One part of the block through time.
std::string collection(const char* name, const std::string& grids) {
  return fmt::format("    <Grid Name=\"{}\" GridType=\"Collection\" CollectionType=\"Temporal\">\n{}    </Grid>\n",
                     name, grids);
}

std::filesystem::path seen_from(const std::filesystem::path& folder, const std::filesystem::path& file) {
  std::error_code failed;
  const std::filesystem::path relative = std::filesystem::relative(file, folder.empty() ? "." : folder, failed);
  return failed || relative.empty() ? std::filesystem::absolute(file) : relative;
}

}  // namespace

void write_xdmf(const std::filesystem::path& run_file, const std::filesystem::path& out, TimeAxis axis) {
  const results::RunResult run = results::read_run(run_file);
  std::filesystem::path companion = out;
  companion += ".h5";
  const Names names{escaped_xml(seen_from(out.parent_path(), run_file).string()),
                    escaped_xml(companion.filename().string()), run.clipped.size(), axis};

  io::Hdf5Writer file(companion);
  file.attribute("/", "format", std::string("perfora.xdmf/1"));
  std::vector<std::int32_t> connectivity(static_cast<std::size_t>(names.discs));
  std::iota(connectivity.begin(), connectivity.end(), 0);
  file.dataset("/discs/connectivity", connectivity, 1);

  std::string discs, bonds, cells;
  for (std::size_t k = 0; k < run.frames.size(); ++k) {
    const results::FrameInfo& info = run.frames[k];
    const Lines lines = lines_of(results::read_frame(run, k));
    file.dataset("/frames/" + info.name + "/bonds/pairs", lines.pairs, 2);
    file.dataset("/frames/" + info.name + "/bonds/damage", lines.damage);
    discs += discs_grid(names, info);
    bonds += bonds_grid(names, info, lines.damage.size());
    cells += cell_grid(axis, info);
  }
  file.commit();
  io::write_file(out, "<?xml version=\"1.0\" ?>\n<Xdmf Version=\"2.0\">\n  <Domain>\n" + collection("discs", discs) +
                          collection("bonds", bonds) + collection("cell", cells) + "  </Domain>\n</Xdmf>\n");
}

}  // namespace perfora::report
