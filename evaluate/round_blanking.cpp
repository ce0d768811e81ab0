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

std::vector<Vec3> places(const Fields<3>& field) {
  std::vector<Vec3> list(field[0].size());
  for (std::size_t i = 0; i < list.size(); ++i) list[i] = {field[0][i], field[1][i], field[2][i]};
  return list;
}

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
    if (support.kind != Support<3>::Kind::symmetry || std::abs(support.direction.dot(direction)) > 1e-6)
      continue;
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
  sheet.now.points = places(shot.state.node.position);
  sheet.before = places(shot.state.node.initial_position);
  for (const Facet<3>& facet : shot.cloud.facets) {
    const auto corner = [&](std::size_t a) { return as<std::int32_t>(index_of(facet.node[a])); };
    sheet.now.triangles.push_back({corner(0), corner(1), corner(2)});
    sheet.piece.push_back(facet.piece);
  }
  const auto& names = shot.cloud.piece_names;
  for (const PieceIndex piece : names.indices()) {
    if (names[piece] == input::Adaptation::fracture_piece) sheet.fracture_piece = piece;
    for (const input::Hole& hole : input.domain.holes)
      if (std::ranges::any_of(hole.outline.pieces,
                              [&](const CurvePiece& part) { return part.name == names[piece]; }))
        sheet.other_pieces.push_back(piece);
  }
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
    TriangleSurface made = input::tool_surface(*input.tools[tool].solid, box_of(sheet.before));
    for (Vec3& x : made.points) x += shot.contact.displacement(tool, now);
    return made;
  };
  RoundTools tools{surface(asked.punch), {}};
  for (const std::size_t die : asked.dies) tools.dies.push_back(surface(die));
  const Box<3> punch = box_of(tools.punch.points);
  axis.centre = asked.centre.value_or(0.5 * (punch.low + punch.high));
  const std::optional<CutArc> arc = find_arc(axis, tools, sheet);
  if (!arc) {
    result.note = fmt::format("{} passes no edge of {} where there was sheet, at no angle", result.punch,
                              fmt::join(result.dies, ", "));
    return result;
  }
  result.cut_length = arc->length;
  for (const double angle : arc->angles(asked.sections)) {
    const auto gap = gap_at(axis, angle, tools, sheet);
    if (!gap) continue;
    result.smoothing = asked.smoothing.value_or(gap->thickness / 50.0);
    for (ShearedFace& face : measure_section(axis, *gap, sheet, asked.parallel, asked.smoothing))
      result.faces.push_back(std::move(face));
  }
  result.measured = measured_beside(result.faces, asked.measured);
  return result;
}

} // namespace cnem::evaluate
