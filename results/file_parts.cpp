// What is here: the shared groups of result files, their checks. What is not: whole files.
#include "results/file_parts.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "io/error.h"

namespace perfora::results {
namespace {

void require_finite(const io::Hdf5Reader& file, const std::string& name, const std::vector<double>& values) {
  const auto bad = std::find_if(values.begin(), values.end(), [](double value) { return !std::isfinite(value); });
  if (bad != values.end())
    refuse(file, name, fmt::format("entry {} is {}", bad - values.begin(), *bad), "finite numbers");
}

}  // namespace

void refuse(const io::Hdf5Reader& file, const std::string& key, const std::string& problem,
            const std::string& allowed) {
  throw io::InputError({file.path().string(), 0, key}, problem, allowed,
                       "write the file again with this version of perfora");
}

void require_format(const io::Hdf5Reader& file, const std::string& wanted, const std::string& what,
                    const std::string& remedy) {
  const std::string found = optional_attribute(file, "format");
  if (found == wanted) return;
  throw io::InputError({file.path().string(), 0, "format"},
                       found.empty() ? "the file has no attribute `format`, so it is not " + what
                                     : "the file is \"" + found + "\", not " + what,
                       "\"" + wanted + "\"", remedy);
}

std::vector<double> finite_doubles(const io::Hdf5Reader& file, const std::string& name) {
  std::vector<double> values = file.doubles(name);
  require_finite(file, name, values);
  return values;
}

void require_discs(const io::Hdf5Reader& file, const std::string& name, const std::vector<std::int32_t>& indices,
                   std::int32_t discs) {
  for (std::int32_t disc : indices)
    if (disc < 0 || disc >= discs)
      refuse(file, name, fmt::format("names disc {}", disc), fmt::format("0 to {}", discs - 1));
}

void require_modes(const io::Hdf5Reader& file, const std::string& name, const std::vector<std::int32_t>& modes) {
  for (const std::int32_t mode : modes)
    if (mode != static_cast<int>(BreakMode::tension) && mode != static_cast<int>(BreakMode::shear))
      refuse(file, name, fmt::format("holds {}", mode), "0 (tension) or 1 (shear)");
}

void require_packing(const io::Hdf5Reader& file, const std::string& group, const geometry::Packing& packing) {
  require_size(file, group + "/y", packing.y, packing.x.size());
  require_size(file, group + "/radius", packing.radius, packing.x.size());
  require_finite(file, group + "/x", packing.x);
  require_finite(file, group + "/y", packing.y);
  require_finite(file, group + "/radius", packing.radius);
  for (double radius : packing.radius)
    if (!(radius > 0.0)) refuse(file, group + "/radius", fmt::format("holds {}", radius), "positive radii");
}

std::string optional_text(const io::Hdf5Reader& file, const std::string& name) {
  return file.has(name) ? file.text(name) : std::string();
}

std::string optional_attribute(const io::Hdf5Reader& file, const std::string& name) {
  return file.has_attribute("/", name) ? file.attribute_text("/", name) : std::string();
}

void write_head(io::Hdf5Writer& file, const char* format, const Provenance& provenance, const nlohmann::json& summary) {
  file.attribute("/", "format", std::string(format));
  if (!provenance.title.empty()) file.attribute("/", "title", provenance.title);
  file.attribute("/", "program_version", provenance.program_version);
  file.attribute("/", "git_revision", provenance.git_revision);
  file.attribute("/", "compiler", provenance.compiler);
  if (!provenance.simd.empty()) file.attribute("/", "simd", provenance.simd);
  if (provenance.threads > 0) file.attribute("/", "threads", provenance.threads);
  if (provenance.seconds > 0.0) file.attribute("/", "seconds", provenance.seconds);
  file.attribute("/", "command_line", provenance.command_line);
  file.attribute("/", "seeds", provenance.seeds);
  file.attribute("/", "results_version", provenance.results_version);
  file.text("/config", provenance.config);
  file.text("/summary", summary.dump(2));
}

Provenance read_provenance(const io::Hdf5Reader& file) {
  Provenance made;
  made.title = optional_attribute(file, "title");
  made.program_version = optional_attribute(file, "program_version");
  made.git_revision = optional_attribute(file, "git_revision");
  made.compiler = optional_attribute(file, "compiler");
  made.simd = optional_attribute(file, "simd");
  made.command_line = optional_attribute(file, "command_line");
  made.seeds = optional_attribute(file, "seeds");
  if (file.has_attribute("/", "threads")) made.threads = file.attribute_int("/", "threads");
  if (file.has_attribute("/", "results_version")) made.results_version = file.attribute_int("/", "results_version");
  if (file.has_attribute("/", "seconds")) made.seconds = file.attribute_double("/", "seconds");
  made.config = optional_text(file, "/config");
  return made;
}

nlohmann::json read_summary(const io::Hdf5Reader& file) {
  if (!file.has("/summary")) return nlohmann::json::object();
  nlohmann::json summary = nlohmann::json::parse(file.text("/summary"), nullptr, false);
  if (!summary.is_object()) refuse(file, "/summary", "is not a JSON object");
  return summary;
}

void write_history(io::Hdf5Writer& file, const std::string& group, const History& history) {
  for (const History::Column& column : History::columns()) {
    const bool empty = (history.*column.values).empty();
    if (empty && (column.optional || history.rows() > 0)) continue;  // A file without rows keeps its columns.
    file.dataset(group + "/" + column.name, history.*column.values, 0, column.units);
    if (*column.units == '\0') file.attribute(group + "/" + column.name, "units", std::string("1"));
  }
}

History read_history(const io::Hdf5Reader& file, const std::string& group) {
  History history;
  for (const History::Column& column : History::columns()) {
    const std::string dataset = group + "/" + column.name;
    if (!file.has(dataset)) continue;
    history.*column.values = finite_doubles(file, dataset);
    require_size(file, dataset, history.*column.values, history.strain_yy.size());
  }
  return history;
}

void write_events(io::Hdf5Writer& file, const std::string& group, const std::vector<BreakEvent>& events) {
  std::vector<double> time, strain, x, y, energy;
  std::vector<std::int32_t> bond, i, j;
  std::vector<std::uint8_t> mode;
  for (const BreakEvent& e : events) {
    time.push_back(e.time);
    strain.push_back(e.strain);
    x.push_back(e.x);
    y.push_back(e.y);
    energy.push_back(e.energy);
    bond.push_back(e.bond);
    i.push_back(e.i);
    j.push_back(e.j);
    mode.push_back(static_cast<std::uint8_t>(e.mode));
  }
  file.group(group);
  file.dataset(group + "/time", time, 0, "s");
  file.dataset(group + "/strain", strain);
  file.dataset(group + "/i", i);
  file.dataset(group + "/j", j);
  file.dataset(group + "/x", x, 0, "m");
  file.dataset(group + "/y", y, 0, "m");
  file.dataset(group + "/mode", mode);
  file.dataset(group + "/energy", energy, 0, "J/m");
  file.dataset(group + "/bond", bond);
}

std::vector<BreakEvent> read_events(const io::Hdf5Reader& file, const std::string& group, std::int32_t discs) {
  if (!file.has(group)) return {};
  const std::vector<double> time = finite_doubles(file, group + "/time");
  const auto doubles = [&](const char* name) {
    std::vector<double> values = finite_doubles(file, group + name);
    require_size(file, group + name, values, time.size());
    return values;
  };
  const auto integers = [&](const char* name) {
    std::vector<std::int32_t> values = file.int32s(group + name);
    require_size(file, group + name, values, time.size());
    return values;
  };
  const auto strain = doubles("/strain"), x = doubles("/x"), y = doubles("/y"), energy = doubles("/energy");
  const auto i = integers("/i"), j = integers("/j"), mode = integers("/mode"), bond = integers("/bond");
  require_discs(file, group + "/i", i, discs);
  require_discs(file, group + "/j", j, discs);
  require_modes(file, group + "/mode", mode);
  std::vector<BreakEvent> events(time.size());
  for (std::size_t k = 0; k < events.size(); ++k)
    events[k] = {time[k], strain[k], bond[k], i[k], j[k], x[k], y[k], static_cast<BreakMode>(mode[k]), energy[k]};
  return events;
}

namespace {

void write_forces(io::Hdf5Writer& file, const std::string& group, const Frame& frame) {
  if (!frame.has_forces()) return;
  file.dataset(group + "/discs/velocity", frame.velocity, 2, "m/s");
  file.dataset(group + "/discs/spin", frame.spin, 0, "rad/s");
  file.dataset(group + "/discs/stress", frame.stress, 3, "Pa");
  file.dataset(group + "/bonds/normal_force", frame.bond_normal_force, 0, "N/m");
  file.dataset(group + "/bonds/shear_force", frame.bond_shear_force, 0, "N/m");
  file.dataset(group + "/contacts/pairs", frame.contact_pairs, 2);
  file.dataset(group + "/contacts/normal_force", frame.contact_normal_force, 0, "N/m");
  file.dataset(group + "/contacts/shear_force", frame.contact_shear_force, 0, "N/m");
}

void read_forces(const io::Hdf5Reader& file, const std::string& group, std::int32_t discs, Frame& frame) {
  if (!file.has(group + "/discs/stress")) return;
  const auto read = [&](const char* name, std::size_t size) {
    std::vector<double> values = finite_doubles(file, group + name);
    require_size(file, group + name, values, size);
    return values;
  };
  const auto n = static_cast<std::size_t>(discs);
  frame.velocity = read("/discs/velocity", 2 * n);
  frame.spin = read("/discs/spin", n);
  frame.stress = read("/discs/stress", 3 * n);
  frame.bond_normal_force = read("/bonds/normal_force", frame.bond_damage.size());
  frame.bond_shear_force = read("/bonds/shear_force", frame.bond_damage.size());
  frame.contact_pairs = file.int32s(group + "/contacts/pairs");
  require_discs(file, group + "/contacts/pairs", frame.contact_pairs, discs);
  frame.contact_normal_force = read("/contacts/normal_force", frame.contact_pairs.size() / 2);
  frame.contact_shear_force = read("/contacts/shear_force", frame.contact_pairs.size() / 2);
}

}  // namespace

void write_frame_group(io::Hdf5Writer& file, const std::string& group, const Frame& frame) {
  file.dataset(group + "/discs/position", frame.position, 2, "m");
  file.dataset(group + "/discs/angle", frame.angle, 0, "rad");
  file.dataset(group + "/discs/fragment", frame.fragment);
  file.dataset(group + "/discs/damage", frame.damage);
  file.dataset(group + "/bonds/pairs", frame.bond_pairs, 2);
  file.dataset(group + "/bonds/damage", frame.bond_damage);
  write_forces(file, group, frame);
  file.attribute(group, "strain", frame.info.strain);
  file.attribute(group, "time", frame.info.time);
  file.attribute(group, "h_xx", frame.info.h_xx);
  file.attribute(group, "h_xy", frame.info.h_xy);
  file.attribute(group, "h_yy", frame.info.h_yy);
}

FrameInfo read_frame_info(const io::Hdf5Reader& file, const std::string& group, const std::string& name) {
  FrameInfo info;
  info.name = name;
  info.strain = file.attribute_double(group, "strain");
  info.time = file.attribute_double(group, "time");
  info.h_xx = file.attribute_double(group, "h_xx");
  info.h_xy = file.attribute_double(group, "h_xy");
  info.h_yy = file.attribute_double(group, "h_yy");
  if (!std::isfinite(info.strain) || !std::isfinite(info.time) || !(info.h_xx > 0.0) || !(info.h_yy > 0.0) ||
      !std::isfinite(info.h_xx) || !std::isfinite(info.h_xy) || !std::isfinite(info.h_yy))
    refuse(file, group, fmt::format("strain {}, cell {} x {} m", info.strain, info.h_xx, info.h_yy),
           "a finite strain and a cell of positive size");
  return info;
}

Frame read_frame_group(const io::Hdf5Reader& file, const std::string& group, const FrameInfo& info,
                       std::int32_t discs) {
  Frame frame;
  frame.info = info;
  const auto n = static_cast<std::size_t>(discs);
  frame.position = finite_doubles(file, group + "/discs/position");
  frame.angle = finite_doubles(file, group + "/discs/angle");
  frame.damage = finite_doubles(file, group + "/discs/damage");
  frame.fragment = file.int32s(group + "/discs/fragment");
  require_size(file, group + "/discs/position", frame.position, 2 * n);
  require_size(file, group + "/discs/angle", frame.angle, n);
  require_size(file, group + "/discs/damage", frame.damage, n);
  require_size(file, group + "/discs/fragment", frame.fragment, n);
  require_discs(file, group + "/discs/fragment", frame.fragment, discs);
  frame.bond_damage = finite_doubles(file, group + "/bonds/damage");
  frame.bond_pairs = file.int32s(group + "/bonds/pairs");
  require_size(file, group + "/bonds/pairs", frame.bond_pairs, 2 * frame.bond_damage.size());
  require_discs(file, group + "/bonds/pairs", frame.bond_pairs, discs);
  read_forces(file, group, discs, frame);
  return frame;
}

}  // namespace perfora::results
