// What is here: reading and checking R.h5, P.h5, T.h5 and elastic answers. What is not: anything that is computed from
// them.
#include "report/run_result.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdlib>

#include "geometry/packing_file.h"
#include "io/error.h"
#include "io/hdf5.h"

namespace perfora::report {
namespace {

constexpr const char* run_format = "perfora.run/1";
constexpr const char* pack_format = "perfora.pack/1";
constexpr const char* test_format = "perfora.test/1";
constexpr const char* elastic_format = "perfora.elastic/1";

/// Order of docs/formats.md (HDF5 lists its members by the alphabet).
constexpr std::array<const char*, 23> history_order = {"strain_yy",
                                                       "strain_yy_log",
                                                       "stress_yy",
                                                       "stress_xx",
                                                       "stress_xy",
                                                       "stress_asymmetry",
                                                       "broken_bonds",
                                                       "fragments",
                                                       "contacts",
                                                       "time",
                                                       "rate",
                                                       "external_work",
                                                       "elastic_bonds",
                                                       "elastic_contacts",
                                                       "kinetic",
                                                       "damage",
                                                       "friction",
                                                       "viscous",
                                                       "cundall",
                                                       "platen_stress_bottom",
                                                       "platen_stress_top",
                                                       "wall_stress_left",
                                                       "wall_stress_right"};

[[noreturn]] void refuse(const io::Hdf5Reader& file, const std::string& key, const std::string& problem,
                         const std::string& allowed = {}) {
  throw io::InputError({file.path().string(), 0, key}, problem, allowed,
                       "write the file again with this version of perfora");
}

void require_format(const io::Hdf5Reader& file, const std::string& wanted, const std::string& what) {
  const std::string found = file.has_attribute("/", "format") ? file.attribute_text("/", "format") : "";
  if (found == wanted) return;
  const std::string remedy = wanted == run_format    ? "give the R.h5 of `perfora evaluate`"
                             : wanted == pack_format ? "give the P.h5 of `perfora pack`"
                             : wanted == test_format ? "give the T.h5 of `perfora test`"
                                                     : "give the file of `perfora evaluate --elastic`";
  throw io::InputError({file.path().string(), 0, "format"},
                       found.empty() ? "the file has no attribute `format`, so it is not " + what
                                     : "the file is \"" + found + "\", not " + what,
                       "\"" + wanted + "\"", remedy);
}

template <class Values>
void require_size(const io::Hdf5Reader& file, const std::string& name, const Values& values, std::size_t wanted) {
  if (values.size() != wanted) refuse(file, name, fmt::format("has {} numbers where {} belong", values.size(), wanted));
}

void require_finite(const io::Hdf5Reader& file, const std::string& name, const std::vector<double>& values) {
  const auto bad = std::find_if(values.begin(), values.end(), [](double value) { return !std::isfinite(value); });
  if (bad != values.end())
    refuse(file, name, fmt::format("entry {} is {}", bad - values.begin(), *bad), "finite numbers");
}

std::vector<double> finite_doubles(const io::Hdf5Reader& file, const std::string& name) {
  std::vector<double> values = file.doubles(name);
  require_finite(file, name, values);
  return values;
}

void require_pairs(const io::Hdf5Reader& file, const std::string& name, const std::vector<std::int32_t>& pairs,
                   std::int32_t discs) {
  for (std::int32_t disc : pairs)
    if (disc < 0 || disc >= discs)
      refuse(file, name, fmt::format("names disc {}", disc), fmt::format("0 to {}", discs - 1));
}

std::string optional_text(const io::Hdf5Reader& file, const std::string& name) {
  return file.has(name) ? file.text(name) : std::string();
}

std::string optional_attribute(const io::Hdf5Reader& file, const std::string& name) {
  return file.has_attribute("/", name) ? file.attribute_text("/", name) : std::string();
}

Provenance read_provenance(const io::Hdf5Reader& file) {
  Provenance made;
  made.program_version = optional_attribute(file, "program_version");
  made.git_revision = optional_attribute(file, "git_revision");
  made.compiler = optional_attribute(file, "compiler");
  made.simd = optional_attribute(file, "simd");
  made.command_line = optional_attribute(file, "command_line");
  made.seeds = optional_attribute(file, "seeds");
  if (file.has_attribute("/", "threads")) made.threads = file.attribute_int("/", "threads");
  if (file.has_attribute("/", "results_version")) made.results_version = file.attribute_int("/", "results_version");
  if (file.has_attribute("/", "seconds")) made.seconds = file.attribute_double("/", "seconds");
  return made;
}

Edges read_edges(const io::Hdf5Reader& file) {
  const std::string sides = optional_attribute(file, "sides");
  return {optional_attribute(file, "top_bottom") == "platens", sides == "walls", sides == "free"};
}

nlohmann::json read_summary(const io::Hdf5Reader& file) {
  if (!file.has("/summary")) return nlohmann::json::object();
  nlohmann::json summary = nlohmann::json::parse(file.text("/summary"), nullptr, false);
  if (!summary.is_object()) refuse(file, "/summary", "is not a JSON object");
  return summary;
}

std::vector<Column> read_history(const io::Hdf5Reader& file) {
  std::vector<std::string> names = file.children("/history");
  const auto place = [](const std::string& name) {
    return std::find(history_order.begin(), history_order.end(), name) - history_order.begin();
  };
  std::stable_sort(names.begin(), names.end(), [&](const auto& a, const auto& b) { return place(a) < place(b); });
  std::vector<Column> columns;
  for (const std::string& name : names) {
    const std::string dataset = "/history/" + name;
    Column column{name, {}, finite_doubles(file, dataset)};
    if (file.has_attribute(dataset, "units")) column.units = file.attribute_text(dataset, "units");
    if (!columns.empty()) require_size(file, dataset, column.values, columns.front().values.size());
    columns.push_back(std::move(column));
  }
  for (const char* name : {"strain_yy", "stress_yy"})
    if (std::none_of(columns.begin(), columns.end(), [&](const Column& column) { return column.name == name; }))
      refuse(file, std::string("/history/") + name, "is missing");
  return columns;
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
  require_pairs(file, group + "/discs/fragment", frame.fragment, discs);
  frame.bond_damage = finite_doubles(file, group + "/bonds/damage");
  frame.bond_pairs = file.int32s(group + "/bonds/pairs");
  require_size(file, group + "/bonds/pairs", frame.bond_pairs, 2 * frame.bond_damage.size());
  require_pairs(file, group + "/bonds/pairs", frame.bond_pairs, discs);
  return frame;
}

std::vector<FrameInfo> read_frame_list(const io::Hdf5Reader& file) {
  std::vector<FrameInfo> frames;
  if (!file.has("/frames")) return frames;
  for (const std::string& name : file.children("/frames"))
    frames.push_back(read_frame_info(file, "/frames/" + name, name));
  std::stable_sort(frames.begin(), frames.end(), [](const auto& a, const auto& b) { return a.strain < b.strain; });
  return frames;
}

Events read_events(const io::Hdf5Reader& file, std::int32_t discs) {
  Events events;
  if (!file.has("/events")) return events;
  events.time = finite_doubles(file, "/events/time");
  const auto doubles = [&](const char* name) {
    std::vector<double> values = finite_doubles(file, name);
    require_size(file, name, values, events.size());
    return values;
  };
  const auto integers = [&](const char* name) {
    std::vector<std::int32_t> values = file.int32s(name);
    require_size(file, name, values, events.size());
    return values;
  };
  events.strain = doubles("/events/strain");
  events.x = doubles("/events/x");
  events.y = doubles("/events/y");
  events.energy = doubles("/events/energy");
  events.i = integers("/events/i");
  events.j = integers("/events/j");
  events.mode = integers("/events/mode");
  events.bond = integers("/events/bond");
  require_pairs(file, "/events/i", events.i, discs);
  require_pairs(file, "/events/j", events.j, discs);
  return events;
}

Bonds read_bonds(const io::Hdf5Reader& file, std::int32_t discs) {
  Bonds bonds;
  if (!file.has("/bonds")) return bonds;
  bonds.rest_length = finite_doubles(file, "/bonds/rest_length");
  bonds.strength_factor = finite_doubles(file, "/bonds/strength_factor");
  bonds.pairs = file.int32s("/bonds/pairs");
  require_size(file, "/bonds/strength_factor", bonds.strength_factor, bonds.size());
  require_size(file, "/bonds/pairs", bonds.pairs, 2 * bonds.size());
  require_pairs(file, "/bonds/pairs", bonds.pairs, discs);
  return bonds;
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

}  // namespace

const std::vector<double>& RunResult::column(std::string_view name) const {
  for (const Column& candidate : history)
    if (candidate.name == name) return candidate.values;
  std::vector<std::string> names;
  for (const Column& candidate : history) names.push_back(candidate.name);
  const std::string nearest = io::nearest_name(name, names);
  throw io::InputError({path.string(), 0, "/history/" + std::string(name)}, "the history has no such column",
                       fmt::format("{}", fmt::join(names, ", ")),
                       nearest.empty() ? "" : "did you mean " + nearest + "?");
}

RunResult read_run(const std::filesystem::path& path) {
  const io::Hdf5Reader file(path);
  require_format(file, run_format, "a run");
  RunResult run;
  run.path = path;
  run.status = optional_attribute(file, "status");
  run.reason = optional_attribute(file, "reason");
  run.provenance = read_provenance(file);
  run.width = file.attribute_double("/", "width");
  run.height = file.attribute_double("/", "height");
  run.mean_diameter = file.attribute_double("/", "mean_diameter");
  if (!(run.width > 0.0) || !(run.height > 0.0)) refuse(file, "width", "the block has no size", "positive sizes");
  run.edges = read_edges(file);
  run.history = read_history(file);
  run.frames = read_frame_list(file);
  run.clipped = geometry::read_packing(file, "/clipped");
  require_packing(file, "/clipped", run.clipped);
  run.layout = geometry::read_layout(file, "/layout");
  run.events = read_events(file, run.clipped.size());
  run.bonds = read_bonds(file, run.clipped.size());
  run.config = optional_text(file, "/config");
  run.summary = read_summary(file);
  return run;
}

Frame read_frame(const RunResult& run, std::size_t index) {
  const io::Hdf5Reader file(run.path);
  const FrameInfo& info = run.frames.at(index);
  return read_frame_group(file, "/frames/" + info.name, info, run.clipped.size());
}

PackResult read_pack(const std::filesystem::path& path) {
  const io::Hdf5Reader file(path);
  require_format(file, pack_format, "a packing");
  PackResult pack;
  pack.path = path;
  pack.provenance = read_provenance(file);
  pack.periodic = geometry::read_packing(file, "/packing");
  require_packing(file, "/packing", pack.periodic);
  pack.clipped = geometry::read_packing(file, "/clipped");
  require_packing(file, "/clipped", pack.clipped);
  pack.layout = geometry::read_layout(file, "/layout");
  pack.config = optional_text(file, "/config");
  pack.summary = read_summary(file);
  return pack;
}

MaterialResult read_material_tests(const std::filesystem::path& path) {
  const io::Hdf5Reader file(path);
  require_format(file, test_format, "a file of material tests");
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
    test.strain = finite_doubles(file, group + "/curve/strain");
    test.stress = finite_doubles(file, group + "/curve/stress");
    require_size(file, group + "/curve/stress", test.stress, test.strain.size());
    if (file.has(group + "/frame"))
      test.frame = read_frame_group(file, group + "/frame", read_frame_info(file, group + "/frame", child),
                                    result.sample.size());
    result.tests.push_back(std::move(test));
  }
  result.config = optional_text(file, "/config");
  result.summary = read_summary(file);
  return result;
}

ElasticResult read_elastic(const std::filesystem::path& path) {
  const io::Hdf5Reader file(path);
  require_format(file, elastic_format, "an elastic answer");
  ElasticResult elastic;
  elastic.path = path;
  elastic.provenance = read_provenance(file);
  elastic.clipped = geometry::read_packing(file, "/clipped");
  require_packing(file, "/clipped", elastic.clipped);
  elastic.layout = geometry::read_layout(file, "/layout");
  elastic.disc_strain = file.doubles("/first_yield/disc_strain");
  require_size(file, "/first_yield/disc_strain", elastic.disc_strain, elastic.clipped.x.size());
  for (const double strain : elastic.disc_strain)
    if (!(strain > 0.0)) refuse(file, "/first_yield/disc_strain", fmt::format("holds {}", strain), "positive strains");
  auto& bonds = elastic.first_bonds;
  bonds.x = finite_doubles(file, "/first_yield/bonds/x");
  bonds.y = finite_doubles(file, "/first_yield/bonds/y");
  bonds.strain = finite_doubles(file, "/first_yield/bonds/strain");
  bonds.mode = file.int32s("/first_yield/bonds/mode");
  require_size(file, "/first_yield/bonds/y", bonds.y, bonds.x.size());
  require_size(file, "/first_yield/bonds/strain", bonds.strain, bonds.x.size());
  require_size(file, "/first_yield/bonds/mode", bonds.mode, bonds.x.size());
  elastic.config = optional_text(file, "/config");
  elastic.summary = read_summary(file);
  return elastic;
}

std::optional<double> summary_number(const nlohmann::json& summary, std::string_view key) {
  if (!summary.is_object()) return std::nullopt;
  const auto found = summary.find(std::string(key));
  if (found != summary.end()) return found->is_number() ? std::optional(found->get<double>()) : std::nullopt;
  for (const char* part : {"summary", "pack"})
    if (const auto inner = summary.find(part); inner != summary.end())
      if (const auto value = summary_number(*inner, key)) return value;
  return std::nullopt;
}

std::optional<std::pair<double, double>> plateau_window(const nlohmann::json& summary) {
  if (!summary.is_object()) return std::nullopt;
  const auto start = summary_number(summary, "plateau_start");
  const auto end = summary_number(summary, "plateau_end");
  if (start && end) return std::pair(*start, *end);
  for (const nlohmann::json& place : {summary, summary.value("summary", nlohmann::json::object())}) {
    const auto window = place.find("plateau_window");
    if (window != place.end() && window->is_array() && window->size() == 2 && (*window)[0].is_number() &&
        (*window)[1].is_number())
      return std::pair((*window)[0].get<double>(), (*window)[1].get<double>());
  }
  return std::nullopt;
}

std::string history_csv(const RunResult& run) {
  fmt::memory_buffer out;
  for (std::size_t c = 0; c < run.history.size(); ++c)
    fmt::format_to(std::back_inserter(out), "{}{}", c == 0 ? "" : ",", run.history[c].name);
  out.push_back('\n');
  for (std::size_t row = 0; row < run.rows(); ++row) {
    for (std::size_t c = 0; c < run.history.size(); ++c)
      fmt::format_to(std::back_inserter(out), "{}{:.17g}", c == 0 ? "" : ",", run.history[c].values[row]);
    out.push_back('\n');
  }
  return fmt::to_string(out);
}

}  // namespace perfora::report
