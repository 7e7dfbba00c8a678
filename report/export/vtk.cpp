// What is here: a collection BASE.pvd and a folder BASE.vtk of PolyData files: discs as points, bonds as lines, the
// cell as an outline, at every frame. What is not: the same over HDF5 (xdmf.h). Format: VTK's XML formats; arrays are
// appended raw, so that a file is no larger than its numbers.
#include <fmt/format.h>

#include <cstdint>
#include <cstring>
#include <iterator>
#include <numeric>

#include "io/files.h"
#include "report/export/registry.h"
#include "report/export/xml.h"

namespace perfora::report {
namespace {

namespace fs = std::filesystem;

/// One PolyData piece: its XML, and the arrays behind it.
class PolyData {
 public:
  PolyData(std::size_t points, const char* cells, std::size_t cell_count) {
    const bool verts = std::strcmp(cells, "Verts") == 0;
    xml_ = fmt::format(
        "<?xml version=\"1.0\"?>\n<VTKFile type=\"PolyData\" version=\"1.0\" byte_order=\"LittleEndian\" "
        "header_type=\"UInt64\">\n<PolyData>\n<Piece NumberOfPoints=\"{}\" NumberOfVerts=\"{}\" NumberOfLines=\"{}\" "
        "NumberOfStrips=\"0\" NumberOfPolys=\"0\">\n",
        points, verts ? cell_count : 0, verts ? 0 : cell_count);
  }
  void open(const char* element) { xml_ += fmt::format("<{}>\n", element); }
  void close(const char* element) { xml_ += fmt::format("</{}>\n", element); }
  void array(const char* type, const std::string& name, int components, const void* data, std::size_t bytes) {
    xml_ += fmt::format(
        "<DataArray type=\"{}\" Name=\"{}\" NumberOfComponents=\"{}\" format=\"appended\" offset=\"{}\"/>\n", type,
        name, components, appended_.size());
    const auto size = static_cast<std::uint64_t>(bytes);
    appended_.append(reinterpret_cast<const char*>(&size), sizeof size);
    appended_.append(static_cast<const char*>(data), bytes);
  }
  void array(const std::string& name, const std::vector<double>& values, int components = 1) {
    array("Float64", name, components, values.data(), values.size() * sizeof(double));
  }
  void array(const std::string& name, const std::vector<std::int64_t>& values) {
    array("Int64", name, 1, values.data(), values.size() * sizeof(std::int64_t));
  }
  void write(const fs::path& path) const {
    io::write_file(path, xml_ + "</Piece>\n</PolyData>\n<AppendedData encoding=\"raw\">\n_" + appended_ +
                             "\n</AppendedData>\n</VTKFile>\n");
  }

 private:
  std::string xml_, appended_;
};

std::vector<std::int64_t> counted(std::size_t count, std::int64_t step) {
  std::vector<std::int64_t> offsets(count);
  for (std::size_t k = 0; k < count; ++k) offsets[k] = static_cast<std::int64_t>(k + 1) * step;
  return offsets;
}

/// Points in the plane z = 0.
std::vector<double> in_space(const std::vector<double>& plane) {
  std::vector<double> points;
  points.reserve(plane.size() / 2 * 3);
  for (std::size_t k = 0; k + 1 < plane.size(); k += 2) points.insert(points.end(), {plane[k], plane[k + 1], 0.0});
  return points;
}

/// What a column's components along x are of: "velocity" of "velocity_x" where velocity_y comes next.
std::string vector_name(const std::vector<Column>& columns, std::size_t k) {
  const std::string& name = columns[k].name;
  if (!name.ends_with("_x") || k + 1 == columns.size()) return {};
  std::string whole = name.substr(0, name.size() - 2);
  return columns[k + 1].name == whole + "_y" ? whole : std::string();
}

/// As VTK takes them: whole numbers, numbers, and components along x and y as one vector in space (arrows, magnitudes).
void add_columns(PolyData& file, const std::vector<Column>& columns) {
  for (std::size_t k = 0; k < columns.size(); ++k) {
    const Column& column = columns[k];
    if (column.whole) {
      file.array(column.name, std::vector<std::int64_t>(column.values.begin(), column.values.end()));
    } else if (const std::string vector = vector_name(columns, k); !vector.empty()) {
      std::vector<double> plane;
      for (std::size_t i = 0; i < column.values.size(); ++i)
        plane.insert(plane.end(), {column.values[i], columns[k + 1].values[i]});
      file.array(vector, in_space(plane), 3);
      ++k;
    } else {
      file.array(column.name, column.values);
    }
  }
}

void add_points(PolyData& file, const std::vector<double>& plane) {
  file.open("Points");
  file.array("points", in_space(plane), 3);
  file.close("Points");
}

void add_cells(PolyData& file, const char* element, const std::vector<std::int64_t>& connectivity,
               const std::vector<std::int64_t>& offsets) {
  file.open(element);
  file.array("connectivity", connectivity);
  file.array("offsets", offsets);
  file.close(element);
}

void write_discs(const fs::path& path, const Moment& moment) {
  const std::size_t n = moment.position.size() / 2;
  PolyData file(n, "Verts", n);
  file.open("PointData");
  add_columns(file, moment.columns);
  file.close("PointData");
  add_points(file, moment.position);
  std::vector<std::int64_t> connectivity(n);
  std::iota(connectivity.begin(), connectivity.end(), 0);
  add_cells(file, "Verts", connectivity, counted(n, 1));
  file.write(path);
}

/// Pairs of discs as lines, those across the periodic boundary left out.
void write_pairs(const fs::path& path, const Moment& moment, const std::vector<std::int32_t>& pairs,
                 const std::vector<Column>& columns) {
  const std::vector<std::size_t> inside = bonds_inside(moment.info, moment.position, pairs);
  std::vector<std::int64_t> connectivity;
  for (const std::size_t b : inside) connectivity.insert(connectivity.end(), {pairs[2 * b], pairs[2 * b + 1]});
  PolyData file(moment.position.size() / 2, "Lines", inside.size());
  file.open("CellData");
  for (const Column& column : columns) {
    std::vector<double> values;
    for (const std::size_t b : inside) values.push_back(column.values[b]);
    file.array(column.name, values);
  }
  file.close("CellData");
  add_points(file, moment.position);
  add_cells(file, "Lines", connectivity, counted(inside.size(), 2));
  file.write(path);
}

void write_cell(const fs::path& path, const results::FrameInfo& cell) {
  PolyData file(4, "Lines", 1);
  file.open("CellData");
  file.array("strain", std::vector<double>{cell.strain});
  file.close("CellData");
  add_points(file, {0.0, 0.0, cell.h_xx, 0.0, cell.h_xx + cell.h_xy, cell.h_yy, cell.h_xy, cell.h_yy});
  add_cells(file, "Lines", {0, 1, 2, 3, 0}, {5});
  file.write(path);
}

}  // namespace

void write_vtk(const Scene& scene, const fs::path& base) {
  require_frames(scene, "VTK");
  const fs::path folder = with_extension(base, ".vtk");
  io::make_folders(folder);
  // What an earlier export with more frames left would be shown as part of this one by who opens the folder.
  for (const auto& old : fs::directory_iterator(folder))
    if (old.path().extension() == ".vtp") io::remove_output(old.path());
  std::string entries;
  for (std::size_t k = 0; k < scene.size(); ++k) {
    const Moment moment = scene.moment(k);
    const auto file = [&](int part, const char* name) {
      const std::string relative = fmt::format("{}/{:05d}-{}.vtp", folder.filename().string(), scene.number(k), name);
      entries += fmt::format("<DataSet timestep=\"{}\" part=\"{}\" name=\"{}\" file=\"{}\"/>\n", scene.axis_value(k),
                             part, name, escaped_xml(relative));
      return base.parent_path() / relative;
    };
    write_discs(file(0, "discs"), moment);
    write_pairs(file(1, "bonds"), moment, moment.pairs, moment.bond_columns);
    write_cell(file(2, "cell"), moment.info);
    if (!moment.contact_columns.empty())
      write_pairs(file(3, "contacts"), moment, moment.contacts, moment.contact_columns);
  }
  io::write_file(with_extension(base, ".pvd"),
                 "<?xml version=\"1.0\"?>\n<VTKFile type=\"Collection\" version=\"1.0\">\n<Collection>\n" + entries +
                     "</Collection>\n</VTKFile>\n");
}

}  // namespace perfora::report
