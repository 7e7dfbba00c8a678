// What is here: see summary_text.h; one table of labels, keys and units a schema.
#include "app/summary_text.h"

#include <fmt/format.h>

#include <array>
#include <cmath>
#include <span>

#include "app/sweep_text.h"

namespace perfora::app {

namespace {

using nlohmann::json;

enum class Unit { number, count, stress, length, time, percent, energy_density };

struct Line {
  const char* label;
  const char* key;
  Unit unit;
};

constexpr Line pack_lines[] = {
    {"discs", "discs", Unit::count},
    {"perforations", "perforations", Unit::count},
    {"mean diameter", "mean_diameter", Unit::length},
    {"solid fraction of the packing", "solid_fraction", Unit::percent},
    {"porosity (share of the perforations)", "porosity", Unit::percent},
    {"bonds per disc", "bonds_per_disc", Unit::number},
    {"thinnest wall", "thinnest_wall", Unit::length},
    {"thinnest wall between the discs", "thinnest_wall_discretised", Unit::length},
    {"largest overlap / smaller diameter", "max_overlap_ratio", Unit::number},
    {"coordination number", "coordination_number", Unit::number},
    {"rattlers", "rattler_fraction", Unit::percent},
};

constexpr Line curve_lines[] = {
    {"first peak stress", "first_peak_stress", Unit::stress},
    {"first peak strain", "first_peak_strain", Unit::percent},
    {"smallest stress after it / peak", "stress_drop_ratio", Unit::percent},
    {"plateau stress", "plateau_stress", Unit::stress},
    {"smallest stress in the window", "minimum_stress_in_window", Unit::stress},
    {"undulation", "undulation", Unit::percent},
    {"densification strain", "densification_strain", Unit::percent},
    {"strain of largest efficiency", "efficiency_strain", Unit::percent},
    {"stress only rises from strain", "only_rising_strain", Unit::percent},
    {"half the first peak again at strain", "recovery_strain", Unit::percent},
    {"peaks behind the first", "intermediate_peaks", Unit::count},
    {"energy absorbed to window end", "energy_absorbed", Unit::energy_density},
    {"share of Cundall damping in the work", "cundall_share", Unit::percent},
};

constexpr Line damage_lines[] = {
    {"broken bonds", "broken_bonds", Unit::count},
    {"  in tension", "broken_in_tension", Unit::count},
    {"  in shear", "broken_in_shear", Unit::count},
    {"fragments", "fragments", Unit::count},
    {"largest fragment (of the solid)", "largest_fragment_fraction", Unit::percent},
};

constexpr Line run_lines[] = {
    {"strain reached", "final_strain", Unit::percent},
    {"steps", "steps", Unit::count},
    {"time step", "time_step", Unit::time},
    {"mean strain rate (1/s)", "rate", Unit::number},
    {"  smallest", "smallest_rate", Unit::number},
    {"  largest", "largest_rate", Unit::number},
    {"energy residual", "energy_residual", Unit::percent},
    {"largest overlap / mean diameter", "max_overlap_in_run", Unit::percent},
    {"wave transits before the peak", "transits_before_peak", Unit::number},
    {"kinetic / elastic energy at the peak", "kinetic_ratio_at_peak", Unit::percent},
    {"critical step / step", "step_margin", Unit::number},
};

constexpr Line elastic_lines[] = {
    {"bonds", "bonds", Unit::count},
    {"Young's modulus, stress along x", "young_x", Unit::stress},
    {"Young's modulus, stress along y", "young_y", Unit::stress},
    {"contraction in y, stress along x", "poisson_xy", Unit::number},
    {"contraction in x, stress along y", "poisson_yx", Unit::number},
    {"shear modulus", "shear_modulus", Unit::stress},
    {"modulus along y, width held", "oedometric_modulus", Unit::stress},
    {"  share of the affine (Voigt) bound", "affine_share", Unit::percent},
    {"anisotropy", "anisotropy", Unit::percent},
    {"nearest isotropic: Young's modulus", "isotropic_young", Unit::stress},
    {"  Poisson's ratio", "isotropic_poisson", Unit::number},
    {"  read as plane strain: E", "plane_strain_young", Unit::stress},
    {"  nu", "plane_strain_poisson", Unit::number},
};

constexpr Line first_yield_lines[] = {
    {"strain", "first_yield_strain", Unit::percent},
    {"stress", "first_yield_stress", Unit::stress},
    {"lateral stress", "first_yield_lateral_stress", Unit::stress},
    {"first bond yields in", "first_yield_mode", Unit::number},
    {"bonds within 2 % of its strain", "first_yield_bonds", Unit::count},
};

constexpr Line solution_lines[] = {
    {"iterations", "iterations", Unit::count},
    {"forces left over forces that meet", "residual", Unit::number},
};

constexpr Line optimize_lines[] = {
    {"score", "score", Unit::number},
    {"target", "target", Unit::stress},
    {"evaluations", "evaluations", Unit::count},
    {"stopped because", "stop_reason", Unit::number},
};

constexpr Line material_lines[] = {
    {"Young's modulus E (2D)", "young_modulus", Unit::stress},
    {"Poisson's ratio nu (2D)", "poisson_ratio", Unit::number},
    {"E, plane-strain reading", "young_modulus_plane_strain", Unit::stress},
    {"nu, plane-strain reading", "poisson_ratio_plane_strain", Unit::number},
    {"shear modulus G", "shear_modulus", Unit::stress},
    {"oedometric modulus C11", "oedometric_modulus", Unit::stress},
    {"tensile strength", "tensile_strength", Unit::stress},
    {"compressive strength", "compressive_strength", Unit::stress},
    {"compressive / tensile strength", "strength_ratio", Unit::number},
    {"shear strength", "shear_strength", Unit::stress},
    {"oedometric strength", "oedometric_strength", Unit::stress},
    {"fracture energy (J/m2)", "fracture_energy", Unit::number},
    {"characteristic length E G / ft^2", "characteristic_length", Unit::length},
};

constexpr int label_width = 38;

std::string value_text(double value, Unit unit) {
  switch (unit) {
    case Unit::number:
      return fmt::format("{:.4g}", value);
    case Unit::count:
      return with_thousands(value);
    case Unit::stress:
      return stress_text(value);
    case Unit::length:
      return length_text(value);
    case Unit::time:
      return fmt::format("{:.4g} us", 1e6 * value);
    case Unit::percent:
      return fmt::format("{:.4g} %", 100.0 * value);
    case Unit::energy_density:
      return fmt::format("{:.4g} kJ/m3", 1e-3 * value);
  }
  return {};
}

std::string line_text(const std::string& label, const std::string& value) {
  return fmt::format("  {:<{}} {}\n", label, label_width, value);
}

std::string wall_pair_text(const json& object) {
  const auto pair = object.find("thinnest_wall_pair");
  if (pair == object.end() || !pair->is_array() || pair->size() != 2) return {};
  const auto first = pair->at(0).get<int>() + 1, second = pair->at(1).get<int>() + 1;  // people count from 1
  return line_text("  between perforations", first == second ? fmt::format("{} and its periodic image", first)
                                                             : fmt::format("{} and {}", first, second));
}

/// What to print for a key; empty: nothing (walls where there are no perforations).
std::string entry_text(const Line& line, const json& value) {
  if (value.is_number()) return value_text(value.get<double>(), line.unit);
  if (value.is_string()) return value.get<std::string>();
  return std::string(line.key).starts_with("thinnest_wall") ? "" : "not reached";
}

std::string lines_text(const char* title, const json& object, std::span<const Line> lines) {
  std::string text;
  for (const Line& line : lines) {
    const auto found = object.find(line.key);
    if (found == object.end()) continue;
    const std::string value = entry_text(line, *found);
    if (!value.empty()) text += line_text(line.label, value);
    if (std::string(line.key) == "thinnest_wall") text += wall_pair_text(object);
  }
  return text.empty() ? text : std::string(title) + "\n" + text;
}

std::string head_text(const json& object) {
  std::string text = fmt::format("{}: {}\n", object.value("status", "?"), object.value("reason", ""));
  if (const auto seeds = object.find("seeds"); seeds != object.end() && seeds->is_object()) {
    std::string list;
    for (const auto& [name, value] : seeds->items())
      list += fmt::format("{}{} {}", list.empty() ? "" : ", ", name, value.dump());
    text += line_text("seeds", list);
  }
  return text;
}

std::string performance_text(const json& object) {
  const auto found = object.find("performance");
  if (found == object.end()) return {};
  auto number = [&](const char* key) {
    return found->contains(key) && found->at(key).is_number() ? found->at(key).get<double>() : NAN;
  };
  std::string text = "Performance\n";
  // Studies and sweeps go on over several calls; what they cost is the sum over their simulations.
  if (const double all = number("simulated_seconds"); std::isfinite(all)) {
    text += line_text("time of the last call", duration_text(number("seconds")));
    text += line_text("sum of all simulations", duration_text(all));
  } else {
    text += line_text(
        "time", fmt::format("{} on {}", duration_text(number("seconds")), threads_text(found->value("threads", 1))));
  }
  if (std::isfinite(number("solution_seconds")))
    text += line_text("  of it for the solution", duration_text(number("solution_seconds")));
  if (std::isfinite(number("steps_per_second")))
    text += line_text("steps per second", fmt::format("{:.4g}", number("steps_per_second")));
  if (std::isfinite(number("ns_per_bond_step")))
    text += line_text("ns per bond and step", fmt::format("{:.3g}", number("ns_per_bond_step")));
  if (std::isfinite(number("peak_memory"))) text += line_text("largest memory", memory_text(number("peak_memory")));
  return text;
}

std::string plateau_window_text(const json& object) {
  const auto window = object.find("plateau_window");
  if (window == object.end() || !window->is_array() || window->size() != 2 || !window->at(0).is_number()) return {};
  return line_text("plateau window", fmt::format("{:.4g} to {:.4g} % strain", 100.0 * window->at(0).get<double>(),
                                                 100.0 * window->at(1).get<double>()));
}

Unit unit_of(const std::string& key) {
  for (const auto lines : {std::span<const Line>(curve_lines), std::span<const Line>(damage_lines)})
    for (const Line& line : lines)
      if (key == line.key) return line.unit;
  return Unit::number;
}

std::string statistics_text(const json& statistics) {
  std::string text = fmt::format("  {:<26} {:>14} {:>14} {:>14} {:>14} {:>14} {:>5}\n", "over the replicates", "mean",
                                 "+- (95 %)", "deviation", "smallest", "largest", "n");
  for (const auto& [name, entry] : statistics.items()) {
    auto value = [&](const char* key) {
      return entry.at(key).is_number() ? value_text(entry.at(key).get<double>(), unit_of(name)) : std::string("-");
    };
    text +=
        fmt::format("  {:<26} {:>14} {:>14} {:>14} {:>14} {:>14} {:>5}\n", name, value("mean"), value("confidence_95"),
                    value("standard_deviation"), value("minimum"), value("maximum"), entry.at("count").get<int>());
  }
  return text;
}

/// One line a number, with its scatter over the samples.
std::string material_text(const json& material) {
  std::string text = "Material\n";
  for (const Line& line : material_lines) {
    const auto found = material.find(line.key);
    if (found == material.end() || !found->at("mean").is_number()) continue;
    std::string value = value_text(found->at("mean").get<double>(), line.unit);
    if (found->at("standard_deviation").is_number())
      value += fmt::format(" (deviation {}, {} samples)",
                           value_text(found->at("standard_deviation").get<double>(), line.unit),
                           found->at("count").get<int>());
    text += line_text(line.label, value);
  }
  return text;
}

std::string calibrate_text(const json& object) {
  std::string text = "Bond parameters found\n";
  for (const auto& [key, value] : object.at("found").items())
    text += line_text("material." + key, value.is_number() ? fmt::format("{:.6g}", value.get<double>()) : "none");
  if (object.at("targets").empty()) return text;
  text += fmt::format("  {:<26} {:>14} {:>14} {:>10}\n", "wanted", "", "reached", "");
  for (const json& target : object.at("targets")) {
    const std::string name = target.at("name").get<std::string>();
    const Unit unit = name == "poisson_ratio" ? Unit::number : Unit::stress;
    const auto text_of = [&](const char* key) {
      return target.at(key).is_number() ? value_text(target.at(key).get<double>(), unit) : std::string("-");
    };
    text += fmt::format("  {:<26} {:>14} {:>14} {:>10}\n", name, text_of("wanted"), text_of("reached"),
                        target.at("met").get<bool>() ? "met" : "NOT MET");
  }
  return text;
}

/// The stiffness as three lines of a matrix.
std::string stiffness_text(const json& object) {
  const auto found = object.find("stiffness");
  if (found == object.end() || !found->is_array()) return {};
  std::string text = "Stiffness (MPa): xx, yy, xy with engineering shear\n";
  for (const json& row : *found) {
    text += " ";
    for (const json& value : row)
      text += value.is_number() ? fmt::format(" {:>12.5g}", 1e-6 * value.get<double>()) : fmt::format(" {:>12}", "-");
    text += "\n";
  }
  return text;
}

std::string first_yield_place_text(const json& object) {
  const auto place = object.find("first_yield_place");
  if (place == object.end() || !place->is_array() || place->size() != 2) return {};
  return line_text("place of the first bond (x, y)", fmt::format("{}, {}", length_text(place->at(0).get<double>()),
                                                                 length_text(place->at(1).get<double>())));
}

std::string elastic_text(const json& object) {
  return lines_text("Elastic answer", object, elastic_lines) + stiffness_text(object) +
         lines_text("First yield, compression along y at fixed width", object, first_yield_lines) +
         first_yield_place_text(object) + lines_text("Solution", object, solution_lines);
}

std::string optimize_text(const json& object) {
  std::string text = lines_text("Search", object, optimize_lines);
  if (const auto best = object.find("best"); best != object.end() && best->is_object()) {
    text += "Best design\n";
    for (const auto& [key, value] : best->items())
      text += line_text(key, value.is_string() ? value.get<std::string>() : value.dump());
  }
  return text;
}

}  // namespace

std::string with_thousands(double count) {
  if (!std::isfinite(count)) return "?";
  std::string digits = fmt::format("{:.0f}", std::abs(count));
  for (auto k = static_cast<std::ptrdiff_t>(digits.size()) - 3; k > 0; k -= 3)
    digits.insert(static_cast<std::size_t>(k), 1, ',');
  return count < 0.0 ? "-" + digits : digits;
}

std::string stress_text(double pascal) {
  const double size = std::abs(pascal);
  if (size >= 1e9) return fmt::format("{:.4g} GPa", 1e-9 * pascal);
  if (size >= 1e6) return fmt::format("{:.4g} MPa", 1e-6 * pascal);
  if (size >= 1e3) return fmt::format("{:.4g} kPa", 1e-3 * pascal);
  return fmt::format("{:.4g} Pa", pascal);
}

std::string length_text(double metres) {
  const double size = std::abs(metres);
  if (size >= 1.0) return fmt::format("{:.4g} m", metres);
  if (size >= 1e-4 || size == 0.0) return fmt::format("{:.4g} mm", 1e3 * metres);
  return fmt::format("{:.4g} um", 1e6 * metres);
}

std::string threads_text(int threads) {
  return threads == 1 ? "1 thread" : fmt::format("{} threads", threads);
}

std::string memory_text(double bytes) {
  if (bytes >= 1e9) return fmt::format("{:.3g} GB", 1e-9 * bytes);
  if (bytes >= 1e6) return fmt::format("{:.3g} MB", 1e-6 * bytes);
  return fmt::format("{:.3g} kB", 1e-3 * bytes);
}

std::string duration_text(double seconds) {
  if (!std::isfinite(seconds)) return "?";
  if (seconds < 10.0) return fmt::format("{:.2g} s", seconds);
  const auto whole = static_cast<long long>(std::llround(seconds));
  if (whole < 60) return fmt::format("{} s", whole);
  if (whole < 3600) return fmt::format("{} min {:02} s", whole / 60, whole % 60);
  if (whole < 86400) return fmt::format("{} h {:02} min", whole / 3600, whole % 3600 / 60);
  return fmt::format("{} d {} h", whole / 86400, whole % 86400 / 3600);
}

std::string summary_text(const json& object) {
  const std::string schema = object.value("schema", "");
  std::string text = head_text(object);
  if (schema == "perfora.optimize/1") return text + optimize_text(object) + performance_text(object);
  if (schema == "perfora.sweep/1") return text + performance_text(object) + sweep_table_text(object);
  if (schema == "perfora.ensemble/1") return text + statistics_text(object.at("statistics"));
  if (schema == "perfora.calibrate/1") return text + calibrate_text(object) + performance_text(object);
  if (schema == "perfora.test/1") return text + material_text(object.at("material")) + performance_text(object);
  text += lines_text("Packing", object, pack_lines);
  if (schema == "perfora.elastic/1") return text + elastic_text(object) + performance_text(object);
  text += lines_text("Curve", object, curve_lines) + plateau_window_text(object);
  text += lines_text("Breakage at the end", object, damage_lines);
  text += lines_text("Run", object, run_lines);
  return text + performance_text(object);
}

}  // namespace perfora::app
