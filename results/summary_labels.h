// What is here: the numbers that a summary shows: key, label, dimension, in the order they are printed. What is not:
// how they are printed (summary_text.h).
#pragma once

#include <span>
#include <string_view>

#include "io/schema.h"

namespace perfora::results {

/// One number of a JSON object of Perfora (SI) as a line of its summary.
struct Label {
  std::string_view key;
  std::string_view label;
  io::Dimension dimension;
};

/// Of perfora.pack/1, and the head of evaluations and elastic responses.
std::span<const Label> packing_labels();
/// Of perfora.evaluate/1: the curve, the broken bonds, the run.
std::span<const Label> curve_labels();
std::span<const Label> damage_labels();
std::span<const Label> run_labels();
/// Of perfora.elastic/1: moduli, first yield, solution.
std::span<const Label> elastic_labels();
std::span<const Label> first_yield_labels();
std::span<const Label> solution_labels();
/// Of perfora.optimize/1.
std::span<const Label> search_labels();
/// Of the material in perfora.test/1 and the targets of perfora.calibrate/1.
std::span<const Label> material_labels();
/// Of perfora.check/1.
std::span<const Label> estimate_labels();

/// Dimension of a key in one of these tables; none for a key that is in none of them.
io::Dimension dimension_of(std::string_view key);

}  // namespace perfora::results
