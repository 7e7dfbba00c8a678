// What is here: the colour of a verdict. What is not: its words.
#include "report/verdict_line.h"

#include <algorithm>

namespace perfora::report {
namespace {

/// Place of the last blank up to which the text fits; its size where there is none.
std::size_t first_line_end(Canvas& canvas, const std::string& text, double width, const TextStyle& style) {
  std::size_t end = text.size();
  for (std::size_t blank = text.find(' '); blank != std::string::npos; blank = text.find(' ', blank + 1)) {
    if (canvas.text_width(text.substr(0, blank), style) > width) break;
    end = blank;
  }
  return end;
}

}  // namespace

void draw_verdict(Canvas& canvas, double x, double y, double width, const std::string& outcome,
                  const std::string& text) {
  if (text.empty()) return;
  const bool bad = outcome == "missed" || outcome == "out of reach";
  const Colour colour = outcome == "met" ? mix(palette::green, palette::ink, 0.3)
                        : bad            ? palette::vermilion
                                         : palette::soft_ink;
  const TextStyle style{.size = 17.0, .colour = colour, .bold = true};
  const std::string whole = "verdict: " + text;
  if (canvas.text_width(whole, style) <= width) {
    canvas.text(x, y, whole, style);
    return;
  }
  // Two lines, as small as they must be and still can be read; what does not fit then is cut.
  constexpr double largest = 15.0, smallest = 12.0;
  for (TextStyle small{.size = largest, .colour = colour, .bold = true};; small.size -= 1.0) {
    const std::size_t end = first_line_end(canvas, whole, width, small);
    const std::string rest = whole.substr(std::min(end + 1, whole.size()));
    if (canvas.text_width(rest, small) > width && small.size > smallest) continue;
    canvas.text(x, y - 5.0, whole.substr(0, end), small);
    canvas.text(x, y + 15.0, canvas.fit(rest, width, small), small);
    return;
  }
}

void draw_verdict(Canvas& canvas, double x, double y, double width, const nlohmann::json& summary) {
  const auto verdict = summary.find("verdict");
  if (verdict == summary.end() || !verdict->is_object()) return;
  draw_verdict(canvas, x, y, width, verdict->value("outcome", ""), verdict->value("text", ""));
}

}  // namespace perfora::report
