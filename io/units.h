// What is here: units: texts with a unit into SI, the units of a dimension. What is not: numbers for people (text.h).
#pragma once

#include <string>
#include <string_view>

#include "io/schema.h"

namespace perfora::io {

/// Converts "20 mm", "2 MPa", "25 %" or a plain number to SI for the given dimension. Throws InputError (with
/// `origin`).
double parse_quantity(const Value& value, Dimension dimension, const Origin& origin);
/// SI unit of a dimension as printed: "m", "Pa", "N/m", ...; "" for none and ratio.
std::string_view si_unit(Dimension dimension);
/// Name of a dimension: "length", "energy density", ...; "" for none.
std::string_view dimension_name(Dimension dimension);
/// A quantity of this dimension as it may be written, such as "20 mm"; empty for a plain number and a count.
std::string_view example_of(Dimension dimension);
/// Whether `unit`, in any spelling that parse_quantity takes, is a unit of the dimension.
bool is_unit(std::string_view unit, Dimension dimension);
/// The unit names accepted for a dimension, for messages.
std::string accepted_units(Dimension dimension);

}  // namespace perfora::io
