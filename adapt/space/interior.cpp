// Which inner nodes go, and where new ones come.
#include "adapt/space/node_grid.hpp"
#include "adapt/space/resample.hpp"
#include "core/geometry/facets.hpp"
#include "core/machine/parallel.hpp"
#include "voronoi/space/bodies.hpp"
#include "voronoi/space/winding.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

namespace cnem::adapt {

namespace {

IndexedVector<NodeIndex, char> on_boundary(const WorkingBody& body) {
  IndexedVector<NodeIndex, char> is(body.size(), 0);
  for (const auto& facet : body.cloud().facets)
    for (const NodeIndex i : facet.node) is[i] = 1;
  return is;
}

double mean_spacing(const WorkingBody& body) {
  const Field& size = body.node().size;
  return std::accumulate(size.begin(), size.end(), 0.0) / static_cast<double>(size.size());
}

/// A facet, the smallest ball with its corners on it, and how far inwards of it no node should be, m.
struct Guarded {
  std::array<Vec3, 3> corner;
  Vec3 inwards, centre;
  double radius, depth;

  Guarded(const WorkingBody& body, const Facet<3>& facet, double depth_of_spacing)
      : corner(corners_of<3>(facet, body.cloud().position)) {
    const DiametralBall ball = diametral_ball(corner);
    centre = ball.centre;
    radius = ball.radius;
    inwards = -area_normal<3>(corner).normalized();
    double h = 0.0;
    for (const NodeIndex i : facet.node) h += body.spacing(i) / 3.0;
    depth = depth_of_spacing * h;
  }

  double reach() const { return std::max(radius, std::hypot(radius, depth)); }
  /// Whether x is in the ball, or before the facet and not deeper than it should be.
  bool too_near(const Vec3& x) const {
    if ((x - centre).squaredNorm() < radius * radius) return true;
    const double height = inwards.dot(x - corner[0]);
    if (height < 0.0 || height >= depth) return false;
    for (std::size_t k = 0; k < 3; ++k)
      if ((corner[(k + 1) % 3] - corner[k]).cross(x - corner[k]).dot(inwards) > 0.0) return false;
    return true;
  }
};

NodeIndex nearest_corner(const WorkingBody& body, const Facet<3>& facet, const Vec3& x) {
  NodeIndex best = facet.node[0];
  for (const NodeIndex i : facet.node)
    if ((body.at(i) - x).squaredNorm() < (body.at(best) - x).squaredNorm()) best = i;
  return best;
}

/// The nearest corner of a facet of the same part; none: the part has no boundary.
NodeIndex nearest_of_boundary(const WorkingBody& body, NodeIndex node) {
  double best = std::numeric_limits<double>::max();
  NodeIndex found = NodeIndex::none;
  for (const auto& facet : body.cloud().facets) {
    const NodeIndex i = nearest_corner(body, facet, body.at(node));
    const double distance = (body.at(i) - body.at(node)).squaredNorm();
    if (distance >= best || !body.may_mix(i, node)) continue;
    best = distance;
    found = i;
  }
  return found;
}

} // namespace

std::vector<Removal> crowded(const WorkingBody& body, const std::vector<Removal>& list,
                             const SpaceThresholds& limits, PassReport& report) {
  const IndexedVector<NodeIndex, char> boundary = on_boundary(body);
  IndexedVector<NodeIndex, NodeIndex> near(body.size(), NodeIndex::none);
  for (const Removal& removal : list) near[removal.gone] = removal.near;
  IndexedVector<NodeIndex, char> outside(body.size(), 0);
  for (const voronoi::SingleBody& single : voronoi::single_bodies(body.cloud())) {
    const voronoi::Winding winding(single.cloud);
    for_each_block(single.node.size(), [&](std::size_t begin, std::size_t end) {
      for (std::size_t k = begin; k < end; ++k) {
        const NodeIndex i = single.node[as<NodeIndex>(k)];
        if (!boundary[i] && !exists(near[i])) outside[i] = winding(body.at(i)) != 1;
      }
    });
  }
  for (const NodeIndex i : body.nodes())
    if (outside[i] && !body.held(i)) {
      near[i] = nearest_of_boundary(body, i);
      report.outside += exists(near[i]);
    }
  const NodeGrid grid(body.cloud().position, mean_spacing(body));
  for (const auto& facet : body.cloud().facets) {
    const Guarded guarded(body, facet, limits.near_facet);
    grid.near(guarded.centre, guarded.reach(), [&](NodeIndex i, double) {
      if (boundary[i] || exists(near[i]) || body.held(i) || !body.may_mix(i, facet.node[0]) ||
          !guarded.too_near(body.at(i)))
        return;
      near[i] = nearest_corner(body, facet, body.at(i));
      ++report.removed;
    });
  }
  // of two the one with less matter goes
  for (const NodeIndex i : body.nodes()) {
    if (exists(near[i])) continue;
    grid.near(body.at(i), limits.pair * body.spacing(i), [&](NodeIndex k, double squared) {
      if (k == i || exists(near[i]) || exists(near[k]) || !body.may_mix(i, k)) return;
      const double limit = limits.pair * body.size_between(i, k);
      if (squared >= limit * limit) return;
      const bool keep_i = boundary[i] || body.held(i), keep_k = boundary[k] || body.held(k);
      if (keep_i && keep_k) return;
      const auto order = [&](NodeIndex n) { return std::pair(body.node().mass[index_of(n)], n); };
      const bool i_goes = keep_k || (!keep_i && order(i) < order(k));
      (i_goes ? near[i] : near[k]) = i_goes ? k : i;
      ++report.removed;
    });
  }
  std::vector<Removal> all;
  for (const NodeIndex i : body.nodes())
    if (exists(near[i])) all.push_back({i, near[i]});
  return all;
}

namespace {

/// Adds to those that go inner nodes with too little volume, none of them beside another that goes. How many.
int add_dense(const WorkingBody& body, const SpaceStructure& structure, const SpaceThresholds& limits,
              std::vector<Removal>& list) {
  const IndexedVector<NodeIndex, char> boundary = on_boundary(body);
  std::vector<std::pair<double, NodeIndex>> order;
  for (const NodeIndex i : body.nodes()) {
    if (boundary[i] || body.held(i)) continue;
    const double h = body.spacing(i), share = structure.volume(i) / (h * h * h);
    if (share < limits.dense) order.emplace_back(share, i);
  }
  std::sort(order.begin(), order.end());
  IndexedVector<NodeIndex, char> touched(body.size(), 0);
  for (const Removal& removal : list) {
    touched[removal.gone] = 1;
    for (const NodeIndex k : structure.neighbours(removal.gone)) touched[k] = 1;
  }
  const std::size_t before = list.size();
  for (const auto& [share, i] : order) {
    if (touched[i]) continue;
    NodeIndex nearest = NodeIndex::none;
    for (const NodeIndex k : structure.neighbours(i)) {
      touched[k] = 1;
      if (!exists(nearest) ||
          (body.at(k) - body.at(i)).squaredNorm() < (body.at(nearest) - body.at(i)).squaredNorm())
        nearest = k;
    }
    list.push_back({i, nearest});
  }
  return static_cast<int>(list.size() - before);
}

struct Gap {
  double order; ///< minus the length over its limit
  NodeIndex a, b;
  Vec3 x;
};

std::vector<Gap> gaps(const WorkingBody& body, const SpaceStructure& structure, double long_edge) {
  std::vector<Gap> list;
  for (const NodeIndex a : body.nodes())
    for (const NodeIndex b : structure.neighbours(a)) {
      if (b < a) continue;
      const double limit = long_edge * body.size_between(a, b);
      const double squared = (body.at(b) - body.at(a)).squaredNorm();
      if (squared <= limit * limit || (body.is_debris(a) && body.is_debris(b))) continue;
      list.push_back({-std::sqrt(squared) / limit, a, b, 0.5 * (body.at(a) + body.at(b))});
    }
  std::sort(list.begin(), list.end(), [](const Gap& one, const Gap& other) {
    return std::tie(one.order, one.a, one.b) < std::tie(other.order, other.a, other.b);
  });
  return list;
}

} // namespace

bool fill(WorkingBody& body, SpaceStructure& structure, const std::vector<Removal>& list,
          const SpaceRules& rules, PassReport& report) {
  const SpaceThresholds& limits = rules.thresholds;
  std::vector<Removal> going = list;
  report.removed += add_dense(body, structure, limits, going);
  const std::vector<Gap> long_edges = gaps(body, structure, limits.long_edge);
  if (long_edges.empty() && going.empty()) return false;
  // where new nodes might come, by which facets are asked who is in their way
  std::vector<Vec3> place;
  for (const Gap& gap : long_edges) place.push_back(gap.x);
  IndexedVector<NodeIndex, char> barred(place.size(), 0); // by number of the gap
  const double spacing = mean_spacing(body);
  const NodeGrid places(place, spacing);
  for (const auto& facet : body.cloud().facets) {
    const Guarded guarded(body, facet, limits.clear_facet);
    places.near(guarded.centre, guarded.reach(), [&](NodeIndex g, double) {
      if (body.cloud().one_body(facet.node[0], long_edges[index_of(g)].a) &&
          guarded.too_near(place[index_of(g)]))
        barred[g] = 1;
    });
  }
  const auto position = body.cloud().position; // a copy: insertions move the others in memory
  const NodeGrid nodes(position, spacing);
  const std::size_t before = body.size();
  for (std::size_t g = 0; g < long_edges.size(); ++g) {
    const Gap& gap = long_edges[g];
    if (barred[g]) continue;
    const double clear = limits.clear_node * body.size_between(gap.a, gap.b);
    bool free = true;
    nodes.near(gap.x, clear, [&](NodeIndex k, double) { free = free && !body.cloud().one_body(k, gap.a); });
    if (!free) continue;
    body.insert_between(gap.a, gap.b, gap.x);
    // other gaps must not come too near
    places.near(gap.x, clear, [&](NodeIndex other, double) { barred[other] = 1; });
  }
  if (body.size() == before && going.empty()) return false;
  report.inserted += static_cast<int>(body.size() - before);
  remove(body, structure, going, rules, report);
  return true;
}

} // namespace cnem::adapt
