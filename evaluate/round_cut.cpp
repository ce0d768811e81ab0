#include "evaluate/round_cut.hpp"

#include "core/index.hpp"

#include <algorithm>
#include <cmath>
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

/// How much of the line at t lies between the uppermost and the lowest surface of a body, m, and where.
std::optional<std::array<double, 2>> heights_at(const std::vector<SectionLoop>& loops, double t) {
  double low = INFINITY, high = -INFINITY;
  for (const SectionLoop& loop : loops)
    for (std::size_t k = 0; k < loop.point.size(); ++k) {
      const Vec2 &a = loop.point[k], &b = loop.point[k + 1 < loop.point.size() ? k + 1 : 0];
      if ((a.x() < t) == (b.x() < t)) continue;
      const double y = a.y() + (t - a.x()) / (b.x() - a.x()) * (b.y() - a.y());
      low = std::min(low, y);
      high = std::max(high, y);
    }
  if (!(high > low)) return std::nullopt;
  return std::array{low, high};
}

/// Where punch and die are across the cut, m from the axis; none without a die.
std::optional<std::array<double, 2>> edges_of(const CutTools& tools) {
  double punch = -INFINITY, die = INFINITY;
  for (const Vec2& x : tools.punch) punch = std::max(punch, tools.across(x));
  for (const Vec2& x : tools.die)
    if (const double t = tools.across(x); t >= punch - 1e-9 * punch) die = std::min(die, t);
  if (!std::isfinite(punch) || !std::isfinite(die)) return std::nullopt;
  return std::array{punch, die};
}

/// The outlines of the bodies in a section, and the nodes beside it.
struct SheetInPlane {
  std::vector<Vec2> position, initial; ///< m
  IndexedVector<CloudFacetIndex, Facet<2>> facets;
  std::vector<std::int32_t> part;
  std::vector<char> on_plane, broken;
  Field volume;

  void add(const Vec2& x, const Vec2& before, std::int32_t body, bool held, bool lost, double size) {
    position.push_back(x);
    initial.push_back(before);
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

SheetInPlane in_plane(const RoundSheet& sheet, const CutPlane& plane, double thickness) {
  SheetInPlane flat;
  const std::vector<SectionLoop> loops = cut(sheet.now, plane);
  const std::vector<std::int32_t> body = bodies_of(loops);
  const double near = 1e-9 * thickness; // edges that end at one node are cut in one place
  for (std::size_t l = 0; l < loops.size(); ++l) {
    const SectionLoop& loop = loops[l];
    if (body[l] < 0) continue;
    const std::size_t first = flat.position.size();
    std::vector<PieceIndex> piece;
    for (std::size_t k = 0; k < loop.point.size(); ++k) {
      const auto [a, b] = loop.edge[k];
      const auto triangle = index_of(loop.triangle[k]);
      const bool held = sheet.on_plane[triangle] != 0;
      if (flat.position.size() > first && (loop.point[k] - flat.position.back()).norm() < near) {
        piece.back() = sheet.piece[triangle];
        flat.on_plane.back() |= static_cast<char>(held);
        continue;
      }
      const Vec3 &x = sheet.before[index_of(a)], &y = sheet.before[index_of(b)];
      const bool broken = !sheet.broken.empty() && sheet.broken[index_of(a)] && sheet.broken[index_of(b)];
      flat.add(loop.point[k], plane.flat(x + loop.share[k] * (y - x)), body[l], held, broken, 0.0);
      piece.push_back(sheet.piece[triangle]);
    }
    for (std::size_t k = first; k < flat.position.size(); ++k)
      flat.facets.push_back({{as<NodeIndex>(k), as<NodeIndex>(k + 1 < flat.position.size() ? k + 1 : first)},
                             piece[k - first]});
  }
  for (std::size_t i = 0; i < sheet.before.size(); ++i) {
    const Vec3& x = sheet.now.points[i];
    if (std::abs(plane.height(x)) > std::cbrt(sheet.volume[i])) continue;
    for (std::size_t l = 0; l < loops.size(); ++l)
      if (loops[l].area() > 0.0 && inside(loops[l].point, plane.flat(x))) {
        flat.add(plane.flat(x), plane.flat(sheet.before[i]), body[l], false, false, sheet.volume[i]);
        break;
      }
  }
  return flat;
}

} // namespace

Vec3 CutAxis::outwards(double angle) const {
  const Vec3 along_x = Vec3::UnitX() - direction.x() * direction;
  constexpr double steep = 1e-3;
  const Vec3 zero = along_x.norm() > steep ? along_x.normalized()
                                           : Vec3(Vec3::UnitY() - direction.y() * direction).normalized();
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
  const auto edges = edges_of(gap.tools);
  if (!edges) return std::nullopt;
  const auto heights =
      heights_at(cut({sheet.before, sheet.now.triangles}, plane), 0.5 * ((*edges)[0] + (*edges)[1]));
  if (!heights) return std::nullopt;
  gap.punch = (*edges)[0];
  gap.thickness = (*heights)[1] - (*heights)[0];
  return gap;
}

std::vector<double> CutArc::angles(int parts) const {
  std::vector<double> list;
  for (int k = 0; k < parts; ++k) list.push_back(from + (k + 0.5) * (to - from) / parts);
  return list;
}

std::optional<CutArc> find_arc(const CutAxis& axis, const RoundTools& tools, const RoundSheet& sheet) {
  constexpr std::size_t probes = 180;
  constexpr double step = whole_turn / probes;
  std::vector<std::optional<Vec3>> edge; // of the punch, where it cuts
  for (std::size_t k = 0; k < probes; ++k) {
    const double angle = (static_cast<double>(k) + 0.5) * step;
    const auto gap = gap_at(axis, angle, tools, sheet);
    edge.push_back(gap ? std::optional<Vec3>(gap->punch * axis.outwards(angle)) : std::nullopt);
  }
  std::size_t best = 0, most = 0;
  for (std::size_t first = 0; first < probes; ++first) {
    if (edge[(first + probes - 1) % probes] && first > 0) continue; // within a run
    std::size_t length = 0;
    while (length < probes && edge[(first + length) % probes]) ++length;
    if (length > most) {
      most = length;
      best = first;
    }
  }
  if (most == 0) return std::nullopt;
  CutArc arc;
  arc.from = static_cast<double>(best) * step;
  arc.to = arc.from + static_cast<double>(most) * step;
  const std::size_t ways = most == probes ? probes : most - 1;
  for (std::size_t k = 0; k < ways; ++k)
    arc.length += (*edge[(best + k + 1) % probes] - *edge[(best + k) % probes]).norm();
  if (ways > 0) arc.length *= static_cast<double>(most) / static_cast<double>(ways);
  return arc;
}

std::vector<ShearedFace> measure_section(const CutAxis& axis, const RoundGap& gap, const RoundSheet& sheet,
                                         double parallel, std::optional<double> smoothing) {
  const SheetInPlane flat = in_plane(sheet, axis.plane(gap.angle), gap.thickness);
  const auto edges = *edges_of(gap.tools);
  const double middle = 0.5 * (edges[0] + edges[1]), half = 0.5 * gap.thickness;
  const CutSheet in_section{flat.position,
                            flat.facets,
                            sheet.fracture_piece,
                            flat.part,
                            flat.volume,
                            flat.on_plane,
                            {{middle - half, 0.0},
                             {middle + half, 0.0},
                             {middle + half, gap.thickness},
                             {middle - half, gap.thickness}}, // as thick as the sheet there
                            sheet.other_pieces,
                            flat.initial,
                            flat.broken};
  std::vector<ShearedFace> faces;
  for (const Cut& one : find_cuts(gap.tools, in_section))
    for (ShearedFace& face :
         measure_cut(one, gap.tools, in_section, parallel, smoothing.value_or(gap.thickness / 50.0))) {
      face.angle = gap.angle;
      faces.push_back(std::move(face));
    }
  return faces;
}

} // namespace cnem::evaluate
