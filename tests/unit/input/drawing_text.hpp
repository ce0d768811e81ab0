#pragma once
// Drawings in DXF to begin with, and the small case with a drawing in the place of its outline.
#include "tests/unit/input/case_text.hpp"

#include <array>
#include <filesystem>
#include <fmt/format.h>
#include <fstream>
#include <unistd.h>

namespace cnem::input {

using Pairs = std::vector<std::pair<int, std::string>>;

/// Group codes as a file has them.
inline std::string lines_of(const Pairs& pairs) {
  std::string text;
  for (const auto& [code, value] : pairs) text += fmt::format("  {}\n{}\n", code, value);
  return text;
}
inline std::string point(double x, double y, int code = 10) {
  return lines_of({{code, fmt::format("{}", x)}, {code + 10, fmt::format("{}", y)}});
}
inline std::string line(const std::string& layer, Vec2 a, Vec2 b) {
  return lines_of({{0, "LINE"}, {8, layer}}) + point(a.x(), a.y()) + point(b.x(), b.y(), 11);
}
inline std::string circle(const std::string& layer, Vec2 centre, double radius) {
  return lines_of({{0, "CIRCLE"}, {8, layer}}) + point(centre.x(), centre.y()) +
         lines_of({{40, fmt::format("{}", radius)}});
}
inline std::string arc(const std::string& layer, Vec2 centre, double radius, double from, double to) {
  return lines_of({{0, "ARC"}, {8, layer}}) + point(centre.x(), centre.y()) +
         lines_of(
             {{40, fmt::format("{}", radius)}, {50, fmt::format("{}", from)}, {51, fmt::format("{}", to)}});
}
/// Corners with bulges.
inline std::string polyline(const std::string& layer, const std::vector<std::array<double, 3>>& corners) {
  std::string text =
      lines_of({{0, "LWPOLYLINE"}, {8, layer}, {90, fmt::format("{}", corners.size())}, {70, "1"}});
  for (const auto& [x, y, bulge] : corners) text += point(x, y) + lines_of({{42, fmt::format("{}", bulge)}});
  return text;
}
inline std::string dxf(const std::string& entities, const std::string& units = "4") {
  return lines_of({{0, "SECTION"},
                   {2, "HEADER"},
                   {9, "$INSUNITS"},
                   {70, units},
                   {0, "ENDSEC"},
                   {0, "SECTION"},
                   {2, "TABLES"},
                   {0, "LAYER"},
                   {2, "empty"},
                   {70, "0"},
                   {0, "LAYER"},
                   {2, "frozen"},
                   {70, "1"},
                   {0, "ENDSEC"},
                   {0, "SECTION"},
                   {2, "ENTITIES"}}) +
         entities + lines_of({{0, "ENDSEC"}, {0, "EOF"}});
}

inline const std::string square = line("low", {0, 0}, {10, 0}) + line("right", {10, 5}, {10, 0}) +
                                  line("high", {10, 5}, {0, 5}) + line("left", {0, 5}, {0, 0});

class Drawings : public ::testing::Test {
protected:
  Drawings() { std::filesystem::create_directories(folder_); }
  ~Drawings() override { std::filesystem::remove_all(folder_); }

  /// What the small case says with this in the place of its outline.
  std::string text(const std::string& domain) const {
    return replaced(small_case, "outer.rectangle = { from = \"0 0 mm\", to = \"10 5 mm\" }", domain);
  }
  Case read(const std::string& drawing, const std::string& domain, const std::string& name = "part.dxf",
            const std::string& more = "") {
    std::ofstream(folder_ / name, std::ios::binary) << drawing;
    return read_case_text(text(domain) + more, (folder_ / "case.toml").string());
  }
  std::string refused(const std::string& drawing, const std::string& domain = whole,
                      const std::string& name = "part.dxf") {
    try {
      read(drawing, domain, name);
    } catch (const InputError& error) { return error.what(); }
    return "accepted";
  }
  /// The resolved case without its first line, which names the file it came from.
  static std::string body(const Case& input) { return input.resolved.substr(input.resolved.find('\n')); }

  static inline const std::string whole = "drawing = { file = \"part.dxf\" }";
  const std::filesystem::path folder_ =
      std::filesystem::path(::testing::TempDir()) / fmt::format("cnem_drawings_{}", ::getpid());
};

} // namespace cnem::input
