// The evaluation of a cut in space: sheet and tools as surfaces, sections round the punch.
#include "core/index.hpp"
#include "evaluate/blanking_parts.hpp"
#include "evaluate/force_stroke.hpp"
#include "evaluate/round_cut.hpp"
#include "input/tool_surface.hpp"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <fmt/ranges.h>

namespace cnem::evaluate {
namespace {

Box<3> box_of(const std::vector<Vec3>& points) {
  Box<3> box{points.front(), points.front()};
  for (const Vec3& x : points) {
    box.low = box.low.cwiseMin(x);
    box.high = box.high.cwiseMax(x);
  }
  return box;
}

/// Triangles whose nodes are held together by a plane along the cutting direction.
std::vector<char> held_triangles(const Supports<3>& supports, const Vec3& direction,
                                 const TriangleSurface& surface) {
  std::vector<char> held(surface.triangles.size(), 0);
  for (const Support<3>& support : supports.list()) {
    if (!along_the_cut(support, direction)) continue;
    std::vector<char> on(surface.points.size(), 0);
    for (const NodeIndex i : support.nodes) on[index_of(i)] = 1;
    for (std::size_t t = 0; t < held.size(); ++t)
      held[t] |= static_cast<char>(
          std::ranges::all_of(surface.triangles[t], [&](auto i) { return on[index_of(i)]; }));
  }
  return held;
}

RoundSheet sheet_of(const input::Case& input, const results::Snapshot<3>& shot, const Supports<3>& supports,
                    const Vec3& direction) {
  RoundSheet sheet;
  sheet.now.points = places<3>(shot.state.node.position);
  for (const Facet<3>& facet : shot.cloud.facets) {
    const auto corner = [&](std::size_t a) { return as<std::int32_t>(index_of(facet.node[a])); };
    sheet.now.triangles.push_back({corner(0), corner(1), corner(2)});
    sheet.piece.push_back(facet.piece);
  }
  sheet.before = {places<3>(shot.state.node.initial_position), sheet.now.triangles};
  const auto& names = shot.cloud.piece_names;
  for (const PieceIndex piece : names.indices())
    if (names[piece] == input::Adaptation::fracture_piece) sheet.fracture_piece = piece;
  sheet.other_pieces = other_pieces(input.domain, names);
  sheet.on_plane = held_triangles(supports, direction, sheet.now);
  sheet.broken = broken_nodes(shot);
  sheet.volume = shot.approximation.node_volume;
  return sheet;
}

} // namespace

BlankingResult evaluate_blanking(const input::Case& input, const results::Snapshot<3>& shot,
                                 const Supports<3>& supports, const results::HistoryTable& history) {
  const input::BlankingReport& asked = *input.report.blanking;
  const double now = shot.state.time;
  BlankingResult result;
  result.time = now;
  result.force_unit = "N";
  result.work_unit = "J";
  result.punch = input.tools[asked.punch].name;
  result.parallel = asked.parallel;
  Vec3 stroke = shot.contact.displacement(asked.punch, now);
  for (const std::size_t die : asked.dies) {
    result.dies.push_back(input.tools[die].name);
    stroke -= shot.contact.displacement(die, now) / static_cast<double>(asked.dies.size());
  }
  result.stroke = stroke.norm();
  if (!(result.stroke > 0.0)) {
    result.note = fmt::format("{} has not moved", result.punch);
    return result;
  }
  CutAxis axis;
  axis.direction = stroke.normalized();
  result.direction_x = axis.direction.x();
  result.direction_y = axis.direction.y();
  result.direction_z = axis.direction.z();
  if (history.rows() > 0)
    for (const input::Tool& tool : input.tools)
      result.forces.push_back(largest_force(
          force_curve(history, tool.name, result.punch, result.dies, axis.direction), tool.name));

  const RoundSheet sheet = sheet_of(input, shot, supports, axis.direction);
  const auto surface = [&](std::size_t tool) {
    TriangleSurface made = input::tool_surface(*input.tools[tool].solid, box_of(sheet.before.points));
    for (Vec3& x : made.points) x += shot.contact.displacement(tool, now);
    return made;
  };
  RoundTools tools{surface(asked.punch), {}};
  for (const std::size_t die : asked.dies) tools.dies.push_back(surface(die));
  const Box<3> punch = box_of(tools.punch.points);
  axis.centre = asked.centre.value_or(0.5 * (punch.low + punch.high));
  const std::vector<CutArc> arcs = find_arcs(axis, tools, sheet);
  if (arcs.empty()) {
    result.note = fmt::format("{} passes no edge of {} where there was sheet, at no angle", result.punch,
                              fmt::join(result.dies, ", "));
    return result;
  }
  for (const CutArc& arc : arcs) result.cut_length += arc.length;
  measure_round(result, axis, section_angles(arcs, asked.sections), tools, sheet, asked.smoothing);
  result.measured = measured_beside(result.faces, asked.measured);
  return result;
}

} // namespace cnem::evaluate
