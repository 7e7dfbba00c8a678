// What is here: the page of a report put together: one file with style, program, chart library, facts and numbers in
// it. What is not: the facts (run_part.h, campaign_parts.h).
#pragma once

#include <nlohmann/json.hpp>
#include <string>
#include <string_view>

#include "report/html/part.h"

namespace perfora::report {

/// The page of all facts and numbers. `facts` holds `title`; everything that came from a user stands in the JSON alone,
/// in which no '<' is left, and in the page's title, escaped. `renew_seconds`: the page loads itself anew so often
/// while the work goes on; 0: never.
std::string html_page(const Part& whole, int renew_seconds = 0);

/// Text for HTML: & < > " ' as entities.
std::string escaped(std::string_view text);
/// JSON that may stand between the tags of a script.
std::string script_json(const nlohmann::json& facts);

/// A file of report/html or a library beside it, as it was when the program was built: "page.html", "style.css",
/// "chart.js", ... Empty for an unknown name.
std::string_view embedded(std::string_view name);

}  // namespace perfora::report
