#pragma once
// Text into HTML and SVG.
#include <string>
#include <string_view>

namespace cnem::report {

/// With & < > " escaped.
std::string html_escape(std::string_view text);

/// A name with spaces for its underscores.
std::string words(std::string name);

/// HTML whose cells of tables and figures (td, dd) break no line between a number and its unit.
std::string keep_units(std::string html);

std::string base64(std::string_view bytes);

/// A PNG file as a part of the page, with what the script (report/report_style.hpp) needs to show it on a
/// dark page.
std::string picture_element(std::string_view png, std::string_view alt);

} // namespace cnem::report
