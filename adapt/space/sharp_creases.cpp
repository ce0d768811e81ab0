#include "adapt/space/sharp_creases.hpp"
#include "core/disjoint_sets.hpp"
#include "core/index.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

namespace cnem::adapt {

using Edge = WorkingSurface::Edge;

namespace {

/// sin α of an acute angle in the metal between the facets of an edge; 1 where it is none, as at a notch.
double acuteness(const WorkingSurface& surface, Edge e) {
  const Vec3 from = surface.at(surface.start(e)), along = surface.at(surface.end(e)) - from;
  const Vec3 one = along.cross(surface.at(surface.apex(e)) - from),
             other = (surface.at(surface.apex(surface.across(e))) - from).cross(along);
  const Vec3 turn = one.cross(other);
  const double lengths = one.norm() * other.norm();
  if (!(lengths > 0.0) || one.dot(other) >= 0.0 || turn.dot(along) <= 0.0) return 1.0;
  return turn.norm() / lengths;
}

struct AcuteEdge {
  NodeIndex start, end;
  double sine;   ///< of the angle
  double length; ///< h, of all acute edges that hang together with it but for the longest
};

std::vector<AcuteEdge> acute_edges(const WorkingSurface& surface, const Field& wanted) {
  std::vector<AcuteEdge> list;
  for (Edge e = 0; e < surface.edges(); ++e) {
    if (!surface.alive(e) || e > surface.across(e) || surface.is_still(surface.piece(e)) ||
        surface.is_still(surface.piece(surface.across(e)))) // metal goes on beyond a period
      continue;
    if (const double sine = acuteness(surface, e); sine < 1.0)
      list.push_back({surface.start(e), surface.end(e), sine, 0.0});
  }
  DisjointSets together(wanted.size());
  for (const AcuteEdge& edge : list) together.join(index_of(edge.start), index_of(edge.end));
  Field total(wanted.size(), 0.0), longest = total; // by the first node of what hangs together
  for (const AcuteEdge& edge : list) {
    const std::size_t i = together.first(index_of(edge.start));
    const double length = 2.0 * surface.length(surface.between(edge.start, edge.end)) /
                          (wanted[index_of(edge.start)] + wanted[index_of(edge.end)]);
    total[i] += length;
    longest[i] = std::max(longest[i], length);
  }
  for (AcuteEdge& edge : list) {
    const std::size_t i = together.first(index_of(edge.start));
    edge.length = total[i] - longest[i];
  }
  return list;
}

} // namespace

Field spacing_at_sharp_creases(const WorkingSurface& surface, const Field& wanted) {
  constexpr double widest = 4.0, growth = 0.5; // over h, and for each length that is as long
  constexpr double per_length = 2.0;           // of a crease
  Field factor(wanted.size(), 1.0);
  bool widened = false;
  const auto widen = [&](NodeIndex i, double to) {
    if (!(to > factor[index_of(i)])) return;
    factor[index_of(i)] = to;
    widened = true;
  };
  for (const AcuteEdge& acute : acute_edges(surface, wanted)) {
    const double at_crease = std::min({1.0 / acute.sine, widest, per_length * acute.length});
    for (const NodeIndex i : {acute.start, acute.end}) widen(i, at_crease);
  }
  while (std::exchange(widened, false))
    for (Edge e = 0; e < surface.edges(); ++e) {
      if (!surface.alive(e)) continue;
      const NodeIndex a = surface.start(e), b = surface.end(e);
      const double h = 0.5 * (wanted[index_of(a)] + wanted[index_of(b)]);
      widen(b, factor[index_of(a)] - growth * surface.length(e) / h);
    }
  Field spacing = wanted;
  for (std::size_t i = 0; i < spacing.size(); ++i) spacing[i] *= factor[i];
  return spacing;
}

} // namespace cnem::adapt
