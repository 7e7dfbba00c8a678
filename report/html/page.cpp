// What is here: the page's places filled. What is not: what stands in the page (page.html and the files it names).
#include "report/html/page.h"

#include <fmt/format.h>

#include <stdexcept>

namespace perfora::report {
namespace {

/// `page` with the text for every place "{{name}}"; a place that has none is an error of this room.
std::string filled(std::string_view page, const std::map<std::string, std::string, std::less<>>& texts) {
  std::string result;
  for (std::size_t at = 0; at < page.size();) {
    const std::size_t open = page.find("{{", at);
    result += page.substr(at, open == std::string_view::npos ? open : open - at);
    if (open == std::string_view::npos) break;
    const std::size_t close = page.find("}}", open);
    const auto found = texts.find(page.substr(open + 2, close - open - 2));
    if (found == texts.end()) throw std::logic_error("page.html names a part that there is not");
    result += found->second;
    at = close + 2;
  }
  return result;
}

}  // namespace

std::string escaped(std::string_view text) {
  std::string result;
  for (const char c : text) {
    switch (c) {
      case '&':
        result += "&amp;";
        break;
      case '<':
        result += "&lt;";
        break;
      case '>':
        result += "&gt;";
        break;
      case '"':
        result += "&quot;";
        break;
      case '\'':
        result += "&#39;";
        break;
      default:
        result += c;
    }
  }
  return result;
}

std::string script_json(const nlohmann::json& facts) {
  std::string result;
  for (const char c : facts.dump(-1, ' ', false, nlohmann::json::error_handler_t::replace)) {
    if (c == '<')
      result += "\\u003c";  // neither </script> nor <!-- can come about
    else
      result += c;
  }
  return result;
}

std::string html_page(const Part& whole, int renew_seconds) {
  std::string program;
  for (const char* name : {"data.js", "elements.js", "charts.js", "block_colours.js", "block_gl.js", "block_canvas.js",
                           "viewer.js", "run.js", "scatter.js", "study.js", "map.js", "sweep.js", "main.js"})
    program += std::string(embedded(name)) + "\n";
  std::string numbers;
  for (const auto& [name, text] : whole.numbers)
    numbers += fmt::format("<script type=\"text/plain\" id=\"numbers-{}\">{}</script>\n", name, text);
  const std::string renew =
      renew_seconds > 0 ? fmt::format("<meta http-equiv=\"refresh\" content=\"{}\">", renew_seconds) : "";
  return filled(embedded("page.html"), {{"title", escaped(whole.facts.value("title", "report"))},
                                        {"renew", renew},
                                        {"style", std::string(embedded("style.css"))},
                                        {"charts", std::string(embedded("chart.js"))},
                                        {"inflate", std::string(embedded("inflate.js"))},
                                        {"program", program},
                                        {"facts", script_json(whole.facts)},
                                        {"numbers", numbers}});
}

}  // namespace perfora::report
