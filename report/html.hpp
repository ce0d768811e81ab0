#pragma once
// Text into HTML and SVG.
#include <string>
#include <string_view>

namespace cnem::report {

/// With & < > " escaped.
std::string html_escape(std::string_view text);

/// A name with spaces for its underscores.
std::string words(std::string name);

std::string base64(std::string_view bytes);

} // namespace cnem::report
