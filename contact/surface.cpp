#include "contact/surface.hpp"

#include "core/geometry/facets.hpp"
#include "core/index.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <limits>
#include <tuple>

namespace cnem::contact {

namespace {

IndexedVector<SurfaceEdgeIndex, SurfaceEdge>
edges_of(const IndexedVector<FacetIndex, std::array<BoundaryNodeIndex, 3>>& facets) {
  using Side = std::tuple<BoundaryNodeIndex, BoundaryNodeIndex, FacetIndex, std::size_t>;
  std::vector<Side> sides;
  sides.reserve(3 * facets.size());
  for (const FacetIndex f : facets.indices())
    for (std::size_t k = 0; k < 3; ++k) {
      const BoundaryNodeIndex a = facets[f][k], b = facets[f][(k + 1) % 3];
      sides.emplace_back(std::min(a, b), std::max(a, b), f, k);
    }
  std::sort(sides.begin(), sides.end());
  std::vector<std::tuple<FacetIndex, std::size_t, FacetIndex>> pairs;
  for (auto side = sides.begin(); side != sides.end();) {
    const auto& [low, high, f, k] = *side;
    ++side;
    FacetIndex other = FacetIndex::none;
    if (side != sides.end() && std::get<0>(*side) == low && std::get<1>(*side) == high)
      other = std::get<2>(*side++);
    pairs.emplace_back(f, k, other);
  }
  std::sort(pairs.begin(), pairs.end());
  IndexedVector<SurfaceEdgeIndex, SurfaceEdge> edges;
  for (const auto& [f, k, other] : pairs)
    edges.push_back({{facets[f][k], facets[f][(k + 1) % 3], facets[f][(k + 2) % 3]}, {f, other}});
  return edges;
}

} // namespace

template<int dim> Surface<dim>::Surface(const std::vector<Facet<dim>>& boundary, std::size_t nodes) {
  IndexedVector<NodeIndex, BoundaryNodeIndex> number(nodes, BoundaryNodeIndex::none);
  for (const Facet<dim>& facet : boundary)
    for (const NodeIndex i : facet.node) number[i] = {};
  for (const NodeIndex i : number.indices()) {
    if (!exists(number[i])) continue;
    number[i] = node.next();
    node.push_back(i);
  }
  if constexpr (dim == 2) {
    leaving.assign(node.size(), FacetIndex::none);
    entering.assign(node.size(), FacetIndex::none);
  } else {
    around.resize(node.size());
  }
  for (const Facet<dim>& facet : boundary) {
    const FacetIndex f = facets.next();
    auto& corner = facets.emplace_back();
    piece.push_back(facet.piece);
    for (std::size_t a = 0; a < dim; ++a) corner[a] = number[facet.node[a]];
    if constexpr (dim == 2)
      leaving[corner[0]] = entering[corner[1]] = f;
    else
      for (const BoundaryNodeIndex a : corner) around[a].push_back(f);
  }
  if constexpr (dim == 3) edges = edges_of(facets);
}

namespace {

template<int dim>
std::array<Vec<dim>, dim> corners(const std::array<BoundaryNodeIndex, dim>& facet,
                                  PlacesOnBoundary<dim> position) {
  std::array<Vec<dim>, dim> corner;
  for (std::size_t a = 0; a < dim; ++a) corner[a] = position[facet[a]];
  return corner;
}

} // namespace

/// Of those facets around a node that count.
template<int dim>
template<class Counts>
double Surface<dim>::area_of(BoundaryNodeIndex at, PlacesOnBoundary<dim> position, Space space,
                             Counts&& counts) const {
  double area = 0.0;
  const auto add = [&](FacetIndex f) {
    if (!exists(f)) return;
    const auto& facet = facets[f];
    const auto corner = corners<dim>(facet, position);
    if (!counts(corner)) return;
    const auto own = std::find(facet.begin(), facet.end(), at) - facet.begin();
    area += corner_areas<dim>(space, corner)[index_of(own)];
  };
  if constexpr (dim == 2) {
    add(entering[at]);
    add(leaving[at]);
  } else {
    for (const FacetIndex f : around[at]) add(f);
  }
  return area;
}

template<int dim>
double Surface<dim>::area(BoundaryNodeIndex at, PlacesOnBoundary<dim> position, Space space) const {
  return area_of(at, position, space, [](const auto&) { return true; });
}

template<int dim>
double Surface<dim>::area_against(BoundaryNodeIndex at, const Vec<dim>& normal,
                                  PlacesOnBoundary<dim> position, Space space) const {
  return area_of(at, position, space, [&](const std::array<Vec<dim>, dim>& corner) {
    const Vec<dim> outwards = area_normal<dim>(corner);
    return outwards.dot(normal) < -0.5 * outwards.norm();
  });
}

template struct Surface<2>;
template struct Surface<3>;

bool encloses(const Surface<2>& surface, PlacesOnBoundary<2> position, const Vec2& x) {
  bool inside = false;
  for (const auto& facet : surface.facets) {
    const Vec2 &a = position[facet[0]], &b = position[facet[1]];
    if ((a.y() > x.y()) == (b.y() > x.y())) continue;
    // the ray towards +x meets the edge where the point is on the inner side of its direction
    const double side = cross(b - a, x - a);
    if ((b.y() > a.y()) == (side > 0.0)) inside = !inside;
  }
  return inside;
}

namespace {

/// One edge of the workpiece as a ridge sees it at one time.
struct EdgeView {
  Vec2 a{0, 0}, b{0, 0};
  Vec2 along{0, 0};  ///< unit
  Vec2 normal{0, 0}; ///< unit, into the workpiece: out of a tool that presses on it
  double length = 0.0;

  EdgeView(const Surface<2>& surface, FacetIndex facet, PlacesOnBoundary<2> position)
      : a(position[surface.facets[facet][0]]), b(position[surface.facets[facet][1]]), length((b - a).norm()) {
    along = (b - a) / length;
    normal = left_normal(along);
  }
  double place(const Vec2& p) const { return along.dot(p - a) / length; }
  double gap(const Ridge<2>& ridge, const Vec2& shift) const {
    return normal.dot(a - ridge.extreme(normal) - shift) + ridge.sagitta(length);
  }
};

/// Beyond an end at which the workpiece is concave, a ridge that is also beyond the neighbouring edge presses
/// on the node between them.
bool presses_on_notch(const Surface<2>& surface, const EdgeView& edge, FacetIndex facet,
                      PlacesOnBoundary<2> position, const Vec2& tip, bool at_end) {
  const BoundaryNodeIndex vertex = surface.facets[facet][at_end ? 1 : 0];
  const FacetIndex other = at_end ? surface.leaving[vertex] : surface.entering[vertex];
  if (!exists(other)) return false;
  const EdgeView neighbour(surface, other, position);
  const double turn = at_end ? cross(edge.along, neighbour.along) : cross(neighbour.along, edge.along);
  if (turn >= 0.0 || (tip - position[vertex]).norm() > 0.5 * edge.length) return false;
  const double place = neighbour.place(tip);
  return at_end ? place < 0.0 : place > 1.0;
}

double fraction_passed(const RidgeHit<2>& hit) {
  return hit.start >= 0.0 ? hit.start / (hit.start - hit.gap) : hit.start;
}

/// Of two facets that meet at a convex node the ridge came in through the one it passed last.
void keep_last_passed(const Surface<2>& surface, PlacesOnBoundary<2> position, std::vector<RidgeHit<2>>& hits,
                      std::size_t first) {
  const auto beaten = [&](const RidgeHit<2>& hit) {
    return std::any_of(hits.begin() + static_cast<std::ptrdiff_t>(first), hits.end(),
                       [&](const RidgeHit<2>& o) {
                         if (&o == &hit) return false;
                         const auto &f = surface.facets[hit.facet], &g = surface.facets[o.facet];
                         if (f[0] != g[1] && f[1] != g[0]) return false;
                         const EdgeView e(surface, hit.facet, position), n(surface, o.facet, position);
                         const double turn = f[1] == g[0] ? cross(e.along, n.along) : cross(n.along, e.along);
                         if (turn <= 0.0) return false;
                         const double mine = fraction_passed(hit), others = fraction_passed(o);
                         return others > mine || (others == mine && o.facet < hit.facet);
                       });
  };
  std::vector<RidgeHit<2>> kept;
  for (std::size_t i = first; i < hits.size(); ++i)
    if (!beaten(hits[i])) kept.push_back(hits[i]);
  hits.resize(first);
  hits.insert(hits.end(), kept.begin(), kept.end());
}

} // namespace

template<>
void ridge_hits<2>(const Surface<2>& surface, std::span<const FacetIndex> facets, const ToolShape<2>& shape,
                   PlacesOnBoundary<2> start, PlacesOnBoundary<2> end, const Vec2& shift_start,
                   const Vec2& shift_end, std::vector<RidgeHit<2>>& hits) {
  const std::vector<Ridge<2>>& ridges = shape.ridges();
  for (std::size_t r = 0; r < ridges.size(); ++r) {
    const Ridge<2>& ridge = ridges[r];
    const std::size_t first = hits.size();
    for (const FacetIndex f : facets) {
      const Vec2 &a = end[surface.facets[f][0]], &b = end[surface.facets[f][1]];
      const double reach = ridge_reach(ridge, (b - a).lpNorm<1>());
      if ((ridge.centre + shift_end - a).squaredNorm() > reach * reach) continue;
      const EdgeView now(surface, f, end);
      const double gap = now.gap(ridge, shift_end);
      if (gap >= 0.0 || gap < -0.5 * now.length || !ridge.faces(now.normal)) continue;
      const Vec2 tip = ridge.extreme(now.normal) + shift_end;
      const double place = now.place(tip);
      constexpr double rounding = 1e-9;
      if (place < -rounding && !presses_on_notch(surface, now, f, end, tip, false)) continue;
      if (place > 1.0 + rounding && !presses_on_notch(surface, now, f, end, tip, true)) continue;
      const EdgeView before(surface, f, start);
      double passed = before.gap(ridge, shift_start);
      if (passed < -rounding * now.length) {
        if (!encloses(surface, start, ridge.extreme(before.normal) + shift_start)) continue;
      } else {
        passed = std::max(passed, 0.0);
      }
      const double s = std::clamp(place, 0.0, 1.0);
      hits.push_back({as<std::int32_t>(r), f, surface.facets[f], {1.0 - s, s}, now.normal, gap, passed});
    }
    keep_last_passed(surface, end, hits, first);
  }
}

template<>
std::vector<RidgeDepth<2>> ridges_inside<2>(const Surface<2>& surface, const ToolShape<2>& shape,
                                            PlacesOnBoundary<2> position, const Vec2& shift) {
  std::vector<RidgeDepth<2>> found;
  for (const Ridge<2>& ridge : shape.ridges()) {
    const Vec2 middle = Eigen::Rotation2Dd(0.5 * ridge.angle) * ridge.first;
    const Vec2 tip = ridge.extreme(middle) + shift;
    if (!encloses(surface, position, tip)) continue;
    RidgeDepth<2> inside{{}, std::numeric_limits<double>::infinity(), tip};
    double least = std::numeric_limits<double>::infinity();
    for (const FacetIndex f : surface.facets.indices()) {
      const EdgeView edge(surface, f, position);
      const double place = std::clamp(edge.place(tip), 0.0, 1.0);
      const double distance = (edge.a + place * edge.length * edge.along - tip).norm();
      if (distance >= least) continue;
      least = distance;
      inside.depth = distance - ridge.sagitta(edge.length);
      inside.node = surface.facets[f][place > 0.5 ? 1 : 0];
    }
    found.push_back(inside);
  }
  return found;
}

} // namespace cnem::contact
