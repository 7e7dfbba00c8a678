// What is here: R.h5 and P.h5 turned into moments. What is not: formats.
#include "report/export/scene.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <iterator>

#include "io/hdf5.h"
#include "io/progress.h"
#include "io/text.h"
#include "io/toml.h"
#include "results/formats.h"
#include "results/pack_file.h"

namespace perfora::report {
namespace {

namespace fs = std::filesystem;

std::vector<double> positions_of(const geometry::Packing& packing) {
  std::vector<double> position;
  position.reserve(2 * packing.x.size());
  for (std::size_t d = 0; d < packing.x.size(); ++d) position.insert(position.end(), {packing.x[d], packing.y[d]});
  return position;
}

/// Number `part` of every `parts`.
std::vector<double> every(const std::vector<double>& values, std::size_t part, std::size_t parts) {
  std::vector<double> picked;
  picked.reserve(values.size() / parts);
  for (std::size_t k = part; k < values.size(); k += parts) picked.push_back(values[k]);
  return picked;
}

void add_forces(Moment& moment, results::Frame& frame) {
  if (!frame.has_forces()) return;
  moment.columns.push_back({"velocity_x", "m/s", false, every(frame.velocity, 0, 2)});
  moment.columns.push_back({"velocity_y", "m/s", false, every(frame.velocity, 1, 2)});
  moment.columns.push_back({"spin", "rad/s", false, frame.spin});
  moment.columns.push_back({"stress_xx", "Pa", false, every(frame.stress, 0, 3)});
  moment.columns.push_back({"stress_yy", "Pa", false, every(frame.stress, 1, 3)});
  moment.columns.push_back({"stress_xy", "Pa", false, every(frame.stress, 2, 3)});
  moment.bond_columns.push_back({"normal_force", "N/m", false, std::move(frame.bond_normal_force)});
  moment.bond_columns.push_back({"shear_force", "N/m", false, std::move(frame.bond_shear_force)});
  moment.contacts = std::move(frame.contact_pairs);
  moment.contact_columns.push_back({"normal_force", "N/m", false, std::move(frame.contact_normal_force)});
  moment.contact_columns.push_back({"shear_force", "N/m", false, std::move(frame.contact_shear_force)});
}

std::string format_of(const fs::path& file) {
  const io::Hdf5Reader reader(file);
  return reader.has_attribute("/", "format") ? reader.attribute_text("/", "format") : std::string();
}

}  // namespace

Scene::Scene(const fs::path& file, const ExportOptions& options) : path_(file), options_(options) {
  const std::string format = format_of(file);
  if (format == results::pack_format) {
    const results::PackResult pack = results::read_pack(file);
    radius_ = pack.clipped.radius;
    start_position_ = positions_of(pack.clipped);
    start_info_ = {"00000", 0.0, 0.0, pack.clipped.width, 0.0, pack.clipped.height};
    provenance_ = pack.provenance;
    choose({start_info_});
    return;
  }
  if (format != results::run_format)
    throw io::InputError({file.string(), 0, "format"},
                         format.empty() ? "the file says of no format" : "the file is \"" + format + "\"",
                         "a run (R.h5) or a packing (P.h5)", "give what perfora evaluate or perfora pack wrote");
  run_ = results::read_run(file);
  radius_ = run_->clipped.radius;
  start_position_ = positions_of(run_->clipped);
  start_info_ = {"start", 0.0, 0.0, run_->width, 0.0, run_->height};
  edges_ = run_->edges;
  bonds_ = std::move(run_->bonds);
  events_ = std::move(run_->events);
  provenance_ = run_->provenance;
  choose(run_->frames);
}

void Scene::choose(const std::vector<results::FrameInfo>& frames) {
  for (std::size_t k = 0; k < frames.size(); ++k) chosen_.push_back({frames[k], k});
  if (!options_.at) return;
  if (chosen_.empty())
    throw io::InputError({path_.string(), 0, "/frames"}, "the run kept no frames, so there is none at a strain",
                         "a run with output.frames = \"few\" or \"all\"", "run the design again with frames");
  const auto off = [this](const Chosen& one) { return std::abs(one.info.strain - *options_.at); };
  const auto nearest = std::min_element(chosen_.begin(), chosen_.end(),
                                        [&](const Chosen& a, const Chosen& b) { return off(a) < off(b); });
  // A run keeps a frame for every 5 % of strain; further beyond the last one it is a slip, such as 10 for 10 %.
  constexpr double beyond = 0.05;
  const double last = chosen_.back().info.strain;
  if (*options_.at > last + beyond)
    throw io::InputError(
        {"--at", 0, ""},
        fmt::format("the run ends at {} strain, and {} is asked", io::quantity(last, io::Dimension::ratio),
                    io::quantity(*options_.at, io::Dimension::ratio)),
        "a strain that the run reached", *options_.at >= 1.0 ? "write \"10 %\" for per cent" : "");
  chosen_ = {*nearest};
  io::log_info(fmt::format("the frame at {} strain, the nearest to {}",
                           io::quantity(chosen_.front().info.strain, io::Dimension::ratio),
                           io::quantity(*options_.at, io::Dimension::ratio)));
}

double Scene::axis_value(std::size_t k) const {
  return options_.axis == TimeAxis::strain ? info(k).strain : info(k).time;
}

Moment Scene::moment(std::size_t k) const {
  if (!run_) return {start_info_, start_position_, {{"radius", "m", false, radius_}}, {}, {}, {}, {}};
  results::Frame frame = results::read_frame(*run_, chosen_[k].place);
  Moment moment;
  moment.info = frame.info;
  moment.columns.push_back({"radius", "m", false, radius_});
  moment.columns.push_back({"angle", "rad", false, std::move(frame.angle)});
  moment.columns.push_back({"fragment", "", true, {frame.fragment.begin(), frame.fragment.end()}});
  moment.columns.push_back({"damage", "", false, std::move(frame.damage)});
  add_forces(moment, frame);
  moment.position = std::move(frame.position);
  moment.pairs = std::move(frame.bond_pairs);
  moment.bond_columns.insert(moment.bond_columns.begin(), {"damage", "", false, std::move(frame.bond_damage)});
  return moment;
}

Moment Scene::start() const {
  return {start_info_,
          start_position_,
          {{"radius", "m", false, radius_}},
          bonds_.pairs,
          {{"damage", "", false, std::vector<double>(bonds_.size(), 0.0)}},
          {},
          {}};
}

SceneMaterial Scene::material() const {
  SceneMaterial material;
  double grade = 1.0;
  const auto number = [](const io::Value& value) {
    if (const auto* real = std::get_if<double>(&value.data)) return *real;
    if (const auto* whole = std::get_if<std::int64_t>(&value.data)) return static_cast<double>(*whole);
    return 0.0;
  };
  for (const io::Entry& entry : io::parse_toml(provenance_.config, path_.string())) {
    if (entry.key == "material.normal_stiffness") material.normal_stiffness = number(entry.value);
    if (entry.key == "material.tangential_stiffness") material.tangential_stiffness = number(entry.value);
    if (entry.key == "material.density") material.density = number(entry.value);
    if (entry.key == "material.grade") grade = number(entry.value);
  }
  material.normal_stiffness *= grade;
  material.tangential_stiffness *= grade;
  if (!(material.normal_stiffness > 0.0 && material.density > 0.0))
    throw io::InputError({path_.string(), 0, "/config"}, "the configuration in the file names no stiffness or density",
                         "material.normal_stiffness and material.density", "run the design again");
  return material;
}

std::string Scene::title() const {
  return path_.filename().string() + " by perfora " + provenance_.program_version;
}

std::vector<std::size_t> bonds_inside(const results::FrameInfo& cell, const std::vector<double>& position,
                                      const std::vector<std::int32_t>& pairs) {
  std::vector<std::size_t> inside;
  for (std::size_t b = 0; b < pairs.size() / 2; ++b) {
    const auto i = static_cast<std::size_t>(pairs[2 * b]), j = static_cast<std::size_t>(pairs[2 * b + 1]);
    const double dy = position[2 * j + 1] - position[2 * i + 1];
    const double dx = position[2 * j] - position[2 * i] - cell.h_xy / cell.h_yy * dy;
    if (std::abs(dx) <= 0.5 * cell.h_xx && std::abs(dy) <= 0.5 * cell.h_yy) inside.push_back(b);
  }
  return inside;
}

void add_value(fmt::memory_buffer& out, char between, const Column& column, std::size_t row) {
  out.push_back(between);
  if (column.whole)
    fmt::format_to(std::back_inserter(out), "{}", static_cast<long long>(column.values[row]));
  else
    fmt::format_to(std::back_inserter(out), "{}", column.values[row]);
}

}  // namespace perfora::report
