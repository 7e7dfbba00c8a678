// What is here: the colour of a verdict. What is not: its words.
#include "report/verdict_line.h"

namespace perfora::report {

void draw_verdict(Canvas& canvas, double x, double y, double width, const std::string& outcome,
                  const std::string& text) {
  if (text.empty()) return;
  const bool bad = outcome == "missed" || outcome == "out of reach";
  const Colour colour = outcome == "met" ? mix(palette::green, palette::ink, 0.3)
                        : bad            ? palette::vermilion
                                         : palette::soft_ink;
  const TextStyle style{.size = 17.0, .colour = colour, .bold = true};
  canvas.text(x, y, canvas.fit("verdict: " + text, width, style), style);
}

void draw_verdict(Canvas& canvas, double x, double y, double width, const nlohmann::json& summary) {
  const auto verdict = summary.find("verdict");
  if (verdict == summary.end() || !verdict->is_object()) return;
  draw_verdict(canvas, x, y, width, verdict->value("outcome", ""), verdict->value("text", ""));
}

}  // namespace perfora::report
