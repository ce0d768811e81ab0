#include "report/html.hpp"

#include "report/palette_png.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cstdint>

namespace cnem::report {

std::string html_escape(std::string_view text) {
  std::string escaped;
  escaped.reserve(text.size());
  for (const char c : text) switch (c) {
    case '&':
      escaped += "&amp;";
      break;
    case '<':
      escaped += "&lt;";
      break;
    case '>':
      escaped += "&gt;";
      break;
    case '"':
      escaped += "&quot;";
      break;
    default:
      escaped += c;
    }
  return escaped;
}

std::string words(std::string name) {
  std::replace(name.begin(), name.end(), '_', ' ');
  return name;
}

std::string keep_units(std::string html) {
  const auto digit = [](char c) { return c >= '0' && c <= '9'; };
  std::string kept;
  kept.reserve(html.size());
  bool inside = false;
  for (std::size_t k = 0; k < html.size(); ++k) {
    const std::string_view rest = std::string_view(html).substr(k);
    if (rest.starts_with("<td") || rest.starts_with("<dd")) inside = true;
    if (rest.starts_with("</td") || rest.starts_with("</dd")) inside = false;
    const bool unit = k > 0 && k + 1 < html.size() && digit(html[k - 1]) && html[k + 1] != '(' &&
                      html[k + 1] != ' ' && !digit(html[k + 1]);
    if (inside && html[k] == ' ' && unit)
      kept += "\u00a0";
    else
      kept += html[k];
  }
  return kept;
}

std::string base64(std::string_view bytes) {
  constexpr std::string_view digits = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  std::string text;
  text.reserve((bytes.size() + 2) / 3 * 4);
  for (std::size_t k = 0; k < bytes.size(); k += 3) {
    std::uint32_t group = 0;
    const std::size_t count = std::min<std::size_t>(3, bytes.size() - k);
    for (std::size_t i = 0; i < 3; ++i)
      group = group << 8 | (i < count ? static_cast<unsigned char>(bytes[k + i]) : 0u);
    for (std::size_t i = 0; i < 4; ++i) text += i <= count ? digits[group >> (18 - 6 * i) & 63u] : '=';
  }
  return text;
}

std::string picture_element(std::string_view png, std::string_view alt) {
  const std::optional<PngPatch> dark = dark_patch(png);
  return fmt::format("<img alt=\"{}\"{} src=\"data:image/png;base64,{}\"/>", html_escape(alt),
                     dark ? fmt::format(" data-dark=\"{}:{}\"", dark->offset, base64(dark->bytes)) : "",
                     base64(png));
}

} // namespace cnem::report
