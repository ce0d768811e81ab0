#include "evaluate/round_cut.hpp"

#include "core/index.hpp"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <fmt/ranges.h>
#include <numbers>

namespace cnem::evaluate {
namespace {

constexpr double whole_turn = 2.0 * std::numbers::pi;

/// Points of a section on the side of the angle.
void add_points(const TriangleSurface& surface, const CutPlane& plane, std::vector<Vec2>& points) {
  for (const SectionLoop& loop : cut(surface, plane))
    for (const Vec2& x : loop.point)
      if (x.x() > 0.0) points.push_back(x);
}

/// A place of an outline in a section, and what the way from it to the next one is.
struct OutlineNode {
  Vec2 now, before; ///< m
  bool held, broken;
  PieceIndex piece;
};

/// The outlines of the bodies in a section, and the nodes beside it.
struct SheetInPlane {
  std::vector<Vec2> position, initial; ///< m
  IndexedVector<CloudFacetIndex, Facet<2>> facets;
  std::vector<std::int32_t> part;
  std::vector<char> on_plane, broken;
  Field volume;

  void add_outline(const std::vector<OutlineNode>& nodes, std::int32_t body) {
    const std::size_t first = position.size();
    for (const OutlineNode& node : nodes) {
      const std::size_t k = position.size(), next = k + 1 < first + nodes.size() ? k + 1 : first;
      facets.push_back({{as<NodeIndex>(k), as<NodeIndex>(next)}, node.piece});
      add(node.now, node.before, body, node.held, node.broken, 0.0);
    }
  }
  void add(const Vec2& x, const Vec2& x_before, std::int32_t body, bool held, bool lost, double size) {
    position.push_back(x);
    initial.push_back(x_before);
    part.push_back(body);
    on_plane.push_back(held);
    broken.push_back(lost);
    volume.push_back(size);
  }
};

/// Whose loop each is: outlines count through, cavities belong to the outline round them.
std::vector<std::int32_t> bodies_of(const std::vector<SectionLoop>& loops) {
  std::vector<std::int32_t> body(loops.size(), -1);
  std::int32_t count = 0;
  for (std::size_t l = 0; l < loops.size(); ++l)
    if (loops[l].area() > 0.0) body[l] = count++;
  for (std::size_t l = 0; l < loops.size(); ++l)
    for (std::size_t o = 0; o < loops.size() && body[l] < 0; ++o)
      if (loops[o].area() > 0.0 && inside(loops[o].point, loops[l].point.front())) body[l] = body[o];
  return body;
}

/// Edges that end at one node are cut in one place: those within `near`, m, are one.
std::vector<OutlineNode> outline_of(const SectionLoop& loop, const RoundSheet& sheet, const CutPlane& plane,
                                    double near) {
  std::vector<OutlineNode> nodes;
  for (std::size_t k = 0; k < loop.point.size(); ++k) {
    const auto [a, b] = loop.edge[k];
    const auto triangle = index_of(loop.triangle[k]);
    const bool held = sheet.on_plane[triangle] != 0;
    if (!nodes.empty() && (loop.point[k] - nodes.back().now).norm() < near) {
      nodes.back().piece = sheet.piece[triangle];
      nodes.back().held = nodes.back().held || held;
      continue;
    }
    const Vec3 &x = sheet.before.points[index_of(a)], &y = sheet.before.points[index_of(b)];
    const bool broken = !sheet.broken.empty() && sheet.broken[index_of(a)] && sheet.broken[index_of(b)];
    nodes.push_back(
        {loop.point[k], plane.flat(x + loop.share[k] * (y - x)), held, broken, sheet.piece[triangle]});
  }
  while (nodes.size() > 1 && (nodes.back().now - nodes.front().now).norm() < near) {
    nodes.front().held = nodes.front().held || nodes.back().held;
    nodes.pop_back();
  }
  return nodes;
}

SheetInPlane in_plane(const RoundSheet& sheet, const CutPlane& plane, double thickness) {
  SheetInPlane flat;
  const double near = 1e-9 * thickness;
  std::vector<SectionLoop> loops = cut(sheet.now, plane);
  std::erase_if(loops, [&](const SectionLoop& loop) { // round nodes that touch the plane
    return std::abs(loop.area()) < near * thickness;
  });
  const std::vector<std::int32_t> body = bodies_of(loops);
  for (std::size_t l = 0; l < loops.size(); ++l) {
    if (body[l] < 0) continue;
    const std::vector<OutlineNode> nodes = outline_of(loops[l], sheet, plane, near);
    if (nodes.size() > 2) flat.add_outline(nodes, body[l]);
  }
  for (std::size_t i = 0; i < sheet.before.points.size(); ++i) {
    const Vec3& x = sheet.now.points[i];
    if (std::abs(plane.height(x)) > std::cbrt(sheet.volume[i])) continue;
    for (std::size_t l = 0; l < loops.size(); ++l)
      if (loops[l].area() > 0.0 && inside(loops[l].point, plane.flat(x))) {
        flat.add(plane.flat(x), plane.flat(sheet.before.points[i]), body[l], false, false, sheet.volume[i]);
        break;
      }
  }
  return flat;
}

} // namespace

char CutAxis::counts_from() const {
  constexpr double askew = 1e-3;
  return (Vec3::UnitX() - direction.x() * direction).norm() > askew ? 'x' : 'y';
}

Vec3 CutAxis::outwards(double angle) const {
  const Vec3 axis = counts_from() == 'x' ? Vec3::UnitX() : Vec3::UnitY();
  const Vec3 zero = (axis - axis.dot(direction) * direction).normalized();
  return std::cos(angle) * zero - std::sin(angle) * direction.cross(zero);
}

CutPlane CutAxis::plane(double angle) const { return {centre, outwards(angle), -direction}; }

std::optional<RoundGap> gap_at(const CutAxis& axis, double angle, const RoundTools& tools,
                               const RoundSheet& sheet) {
  const CutPlane plane = axis.plane(angle);
  RoundGap gap;
  gap.angle = angle;
  add_points(tools.punch, plane, gap.tools.punch);
  for (const TriangleSurface& die : tools.dies) add_points(die, plane, gap.tools.die);
  const auto edges = edges_on(gap.tools, 1.0);
  if (!edges) return std::nullopt;
  gap.edges = *edges;
  std::vector<std::vector<Vec2>> before;
  for (SectionLoop& loop : cut(sheet.before, plane)) before.push_back(std::move(loop.point));
  gap.thickness = thickness_at(gap.tools, before, edges->middle());
  return gap.thickness > 0.0 ? std::optional(std::move(gap)) : std::nullopt;
}

std::vector<CutArc> find_arcs(const CutAxis& axis, const RoundTools& tools, const RoundSheet& sheet) {
  constexpr std::size_t probes = 180;
  constexpr double step = whole_turn / probes;
  std::vector<std::optional<Vec3>> edge; // of the punch, where it cuts
  for (std::size_t k = 0; k < probes; ++k) {
    const double angle = (static_cast<double>(k) + 0.5) * step;
    const auto gap = gap_at(axis, angle, tools, sheet);
    edge.push_back(gap ? std::optional<Vec3>(gap->edges.punch * axis.outwards(angle)) : std::nullopt);
  }
  const bool all_round = std::ranges::all_of(edge, [](const auto& one) { return one.has_value(); });
  std::vector<CutArc> arcs;
  for (std::size_t first = 0; first < probes; ++first) {
    if (!edge[first] || (all_round ? first > 0 : edge[(first + probes - 1) % probes].has_value())) continue;
    std::size_t count = 0;
    while (count < probes && edge[(first + count) % probes]) ++count;
    CutArc& arc = arcs.emplace_back();
    arc.from = static_cast<double>(first) * step;
    if (first + count > probes) arc.from -= whole_turn;
    arc.to = arc.from + static_cast<double>(count) * step;
    const std::size_t ways = all_round ? probes : count - 1;
    for (std::size_t k = 0; k < ways; ++k)
      arc.length += (*edge[(first + k + 1) % probes] - *edge[(first + k) % probes]).norm();
    // Half a step more at either end.
    arc.length = ways > 0 ? arc.length * static_cast<double>(count) / static_cast<double>(ways)
                          : step * edge[first]->norm();
  }
  std::ranges::sort(arcs, {}, &CutArc::from);
  return arcs;
}

std::vector<double> section_angles(const std::vector<CutArc>& arcs, int parts) {
  double turn = 0.0;
  for (const CutArc& arc : arcs) turn += arc.to - arc.from;
  std::vector<double> angles;
  for (int k = 0; k < parts; ++k) {
    double ahead = (k + 0.5) * turn / parts;
    auto arc = arcs.begin();
    for (; arc + 1 != arcs.end() && ahead > arc->to - arc->from; ++arc) ahead -= arc->to - arc->from;
    angles.push_back(arc->from + ahead);
  }
  return angles;
}

std::vector<ShearedFace> measure_section(const CutAxis& axis, const RoundGap& gap, const RoundSheet& sheet,
                                         double parallel, double smoothing) {
  const SheetInPlane flat = in_plane(sheet, axis.plane(gap.angle), gap.thickness);
  const CutSheet in_section{flat.position, flat.facets, sheet.fracture_piece, flat.part,    flat.volume,
                            flat.on_plane, {},          sheet.other_pieces,   flat.initial, flat.broken};
  const Cut here = cut_between(gap.tools, in_section, gap.edges, gap.thickness);
  std::vector<ShearedFace> faces = measure_cut(here, gap.tools, in_section, parallel, smoothing);
  for (ShearedFace& face : faces) face.angle = gap.angle;
  return faces;
}

void measure_round(BlankingResult& result, const CutAxis& axis, const std::vector<double>& angles,
                   const RoundTools& tools, const RoundSheet& sheet, std::optional<double> smoothing) {
  std::size_t nowhere = 0;
  for (const double angle : angles) {
    const auto gap = gap_at(axis, angle, tools, sheet);
    if (!gap) {
      ++nowhere;
      continue;
    }
    if (!smoothing) smoothing = gap->thickness / 50.0;
    result.smoothing = *smoothing;
    for (ShearedFace& face : measure_section(axis, *gap, sheet, result.parallel, *smoothing))
      result.faces.push_back(std::move(face));
  }
  if (nowhere > 0)
    result.note = fmt::format("{} passes no edge of {} where there was sheet, at {} of {} angles",
                              result.punch, fmt::join(result.dies, ", "), nowhere, angles.size());
}

} // namespace cnem::evaluate
