// What is here: an options struct with a key of every type, described as a room would describe its own.
// What is not: tests.
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include "io/schema.h"
#include "io/toml.h"

namespace perfora::io {

enum class Family { square, staggered };

struct ExampleOptions {
  double diameter = 0.020, fraction = 0.719, stress = 0.0, plain = 1.5, rate = 0.5;
  int rows = 6;
  std::int64_t seed = 1;
  bool noisy = false;
  std::string label = "none";
  Family family = Family::square;
  std::filesystem::path file;
  std::vector<double> strains, holes;
};

inline void describe(Schema& schema, ExampleOptions& options) {
  schema.section("layout", "Perforations.")
      .choice("family", options.family, {{"square", Family::square}, {"staggered", Family::staggered}},
              "Family of layouts.")
      .real("diameter", options.diameter, Dimension::length, Range::positive(), "Hole diameter.")
      .integer("rows", options.rows, Range::between(1, 1000), "Rows of holes.")
      .real_rows("holes", options.holes, 3, Dimension::length, "Rows of x, y, diameter.")
      .path("file", options.file, "CSV of holes.");
  schema.section("packing", "Discs.")
      .real("solid_fraction", options.fraction, Dimension::ratio, {0.0, 1.0, true, false}, "Share of solid | clipped.")
      .boolean("noisy", options.noisy, "Noise or none.")
      .text("label", options.label, "Free text.")
      .integer("seed", options.seed, Range::at_least(0), "Seed.");
  schema.section("loading", "Test.")
      .real("rate", options.rate, Dimension::rate, Range::non_negative(), "Strain rate.")
      .real("stress", options.stress, Dimension::stress, Range{}, "Lateral stress.")
      .real("plain", options.plain, Dimension::none, Range{}, "A number without dimension.")
      .real_list("strains", options.strains, Dimension::ratio, Range::between(0.0, 1.0), "Frames.");
}

struct Example {
  ExampleOptions options;
  Schema schema;
  Example() { describe(schema, options); }
  void apply(const std::string& text, const std::string& file = "a.toml") {
    apply_entries(schema, parse_toml(text, file), file);
  }
};

}  // namespace perfora::io
