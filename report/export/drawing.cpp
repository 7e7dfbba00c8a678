// What is here: what both forms of a drawing share. What is not: the forms (drawing_svg.cpp, drawing_dxf.cpp).
#include "report/export/drawing.h"

#include <fmt/format.h>

namespace perfora::report {

const char* layer_name(Layer layer) {
  switch (layer) {
    case Layer::block:
      return "block";
    case Layer::holes:
      return "holes";
    case Layer::centres:
      return "centres";
    case Layer::dimensions:
      return "dimensions";
    case Layer::loading:
      return "loading";
    case Layer::text:
      return "text";
    case Layer::frame:
      return "frame";
  }
  return "";
}

std::string mm_text(double value, int digits) {
  std::string text = fmt::format("{:.{}f}", value, digits);
  if (text.find('.') != std::string::npos) {
    text.erase(text.find_last_not_of('0') + 1);
    if (text.back() == '.') text.pop_back();
  }
  return text == "-0" ? "0" : text;
}

}  // namespace perfora::report
