// What is here: the verdict as the line of a picture. What is not: the verdict (results/verdict.h).
#pragma once

#include <nlohmann/json.hpp>
#include <string>

#include "report/canvas.h"

namespace perfora::report {

/// One line at (x, y), cut to `width`: green where the wish is met, red where it is missed or out of reach, else grey.
/// Nothing for an empty text.
void draw_verdict(Canvas& canvas, double x, double y, double width, const std::string& outcome,
                  const std::string& text);
/// The same of a summary that may hold a verdict.
void draw_verdict(Canvas& canvas, double x, double y, double width, const nlohmann::json& summary);

}  // namespace perfora::report
