#include "contact/covered_edges.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

namespace cnem::contact {
namespace {

/// A ridge and the face beside it on one edge.
struct Covering {
  const Ridge<2>& ridge;
  double share = 0.0; ///< of the face: 1 where the edge lies along it, 0 where the ridge bears alone
  Vec2 face{0, 0};    ///< –, outward normal
  double place = 0.0; ///< of the resultant on the edge, from 0 to 1

  Covering(const Surface<2>& surface, const RidgeHit<2>& hit, const Ridge<2>& met,
           PlacesOnBoundary<2> position, const Vec2& shift)
      : ridge(met), place(hit.weight[1]) {
    const auto& ends = surface.facets[hit.facet];
    const double length = (position[ends[1]] - position[ends[0]]).norm();
    const Vec2 last = Eigen::Rotation2Dd(ridge.angle) * ridge.first;
    const double to_first = ridge.first.dot(hit.normal), to_last = last.dot(hit.normal);
    const bool before = to_first > to_last; // tools run counter-clockwise: it covers the edge towards its end
    face = before ? ridge.first : last;
    const FacetIndex next = before ? surface.leaving[ends[1]] : surface.entering[ends[0]];
    if (!exists(next)) return;
    const Vec2& beside = position[surface.facets[next][before ? 1 : 0]];
    constexpr double touching = 0.1; // of the edge's length: a gap of more is none
    const double gap = face.dot(beside - ridge.extreme(face) - shift) / (touching * length);
    const double turn = std::acos(std::min(1.0, std::max(to_first, to_last))) / ridge.angle;
    share = smooth_step(1.0 - gap) * smooth_step(4.0 * (0.5 - turn)) * ridge.sharpness(length);
    place += 0.5 * share * ((before ? 1.0 : 0.0) - place);
  }

  Vec2 normal(const Vec2& of_edge) const { return (share * face + (1.0 - share) * of_edge).normalized(); }

  /// m, of an edge a → b at the place.
  double gap(const Vec2& a, const Vec2& b, const Vec2& shift) const {
    const Vec2 n = normal(left_normal(b - a).normalized());
    return n.dot(a + place * (b - a) - ridge.extreme(n) - shift) +
           (1.0 - share) * ridge.sagitta((b - a).norm());
  }
};

} // namespace

template<>
void share_with_faces<2>(const Surface<2>& surface, const ToolShape<2>& shape, PlacesOnBoundary<2> start,
                         PlacesOnBoundary<2> end, const Vec2& shift_start, const Vec2& shift_end,
                         std::vector<RidgeHit<2>>& hits) {
  for (RidgeHit<2>& hit : hits) {
    const Covering covering(surface, hit, shape.ridges()[static_cast<std::size_t>(hit.ridge)], end,
                            shift_end);
    if (covering.share == 0.0) continue;
    const auto& ends = surface.facets[hit.facet];
    const double before = covering.gap(start[ends[0]], start[ends[1]], shift_start);
    hit.start = std::max(before, 0.0);
    hit.gap = covering.gap(end[ends[0]], end[ends[1]], shift_end) - std::min(before, 0.0);
    hit.weight = {1.0 - covering.place, covering.place};
    hit.normal = covering.normal(hit.normal);
  }
  std::erase_if(hits, [](const RidgeHit<2>& hit) { return hit.gap >= 0.0; });
}

template<>
void share_with_faces<3>(const Surface<3>&, const ToolShape<3>&, PlacesOnBoundary<3>, PlacesOnBoundary<3>,
                         const Vec3&, const Vec3&, std::vector<RidgeHit<3>>&) {}

} // namespace cnem::contact
