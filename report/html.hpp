#pragma once
// Text into HTML and SVG.
#include <string>
#include <string_view>

namespace cnem::report {

/// With & < > " escaped.
std::string html_escape(std::string_view text);

std::string base64(std::string_view bytes);

} // namespace cnem::report
