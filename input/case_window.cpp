// A window that moves with a tool.
#include "input/case_parts.hpp"
#include "input/cutting_tool.hpp"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>

namespace cnem::input {
namespace {

/// Whether the outline ends, along a direction, in one straight side square to it between two straight ones
/// along it that are at least `length` (m) long: only then is what is fed in like what is there.
bool ends_square(const Curve& outline, const Vec2& along, double length) {
  constexpr double parallel = 1e-6; // rad
  const auto& pieces = outline.pieces;
  const auto reach = [&](const CurvePiece& piece) {
    return std::min(piece.from.dot(along), piece.to.dot(along));
  };
  const auto end = std::max_element(pieces.begin(), pieces.end(),
                                    [&](const auto& a, const auto& b) { return reach(a) < reach(b); });
  const auto k = static_cast<std::size_t>(end - pieces.begin());
  const CurvePiece &before = pieces[(k + pieces.size() - 1) % pieces.size()],
                   &after = pieces[(k + 1) % pieces.size()];
  const auto runs = [&](const CurvePiece& piece, const Vec2& way) {
    return !piece.is_arc() && (piece.tangent(0.0) - way).norm() < parallel;
  };
  return runs(*end, left_normal(along)) && runs(before, along) && runs(after, -along) &&
         std::min(before.length(), after.length()) > length;
}

} // namespace

void read_moving_window(Setting& root, Case& result, Diagnostics& diagnostics) {
  const std::string at = "adapt.window";
  const auto tool = read_leading_tool(root, result, at, {"follow", "cutter"}, diagnostics);
  if (!tool) return;
  const auto refuse = [&](const char* name, const std::string& message) {
    const Setting& key = *root.find(at + name);
    diagnostics.add(Mistake::conflict, key.where, key.path, message);
  };
  MovingWindow window;
  window.tool = *tool;
  window.ahead = root.get<double>(at + ".ahead");
  window.behind = root.get<double>(at + ".behind");
  window.chip = root.find(at)->maybe<double>("chip");
  window.strip = window.ahead / 8.0;
  if (!(window.strip >= result.cloud.spacing))
    refuse(".ahead", fmt::format("found {:g} m beside nodes {:g} m apart, expected at least {:g} m: strips "
                                 "of an eighth of it would be narrower than a cell",
                                 window.ahead, result.cloud.spacing, 8.0 * result.cloud.spacing));
  if (window.chip && !result.report.cutting)
    refuse(".chip", "found a length of chip without report.cutting, expected that beside it: its feed says "
                    "where a chip begins");
  try {
    const CuttingTool cut = cutting_tool(result, *tool);
    if (!ends_square(result.domain.outer, cut.along, window.strip))
      refuse("", fmt::format("found a workpiece whose end ahead of the tool '{}' is not one straight side "
                             "square to its way between two along it, expected that: the workpiece is "
                             "continued there",
                             result.tools[*tool].name));
  } catch (const InputError& error) { return refuse(".follow", error.what()); }
  result.adapt.window = window;
}

} // namespace cnem::input
