// What is here: text made safe for XML. What is not: reading of XML (geometry/drawn_svg.cpp).
#pragma once

#include <string>
#include <string_view>

namespace perfora::report {

/// `text` as it may stand in an element or in an attribute with double quotes; control characters become blanks.
std::string escaped_xml(std::string_view text);

}  // namespace perfora::report
