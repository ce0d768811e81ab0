// How faces that overlap, of cohesive interfaces and others, are set apart before a cloud is made of them.
#include "core/geometry/winding_number.hpp"
#include "core/index.hpp"
#include "mechanics/boundary_parting.hpp"
#include "mechanics/cohesive_faces.hpp"
#include "mechanics/placed_element.hpp"

#include <algorithm>
#include <array>
#include <boost/geometry/geometries/box.hpp>
#include <boost/geometry/geometries/point.hpp>
#include <boost/geometry/index/rtree.hpp>
#include <cmath>
#include <iterator>
#include <limits>
#include <optional>
#include <utility>
#include <vector>

namespace cnem {
namespace {

constexpr double apart = 1e-5;   ///< of an element or a segment: what is left between faces
constexpr double deepest = 0.5;  ///< of a segment: what is deeper in the other face is not beside it
constexpr double shallow = 1e-3; ///< of a segment or facet: what is deeper is no remainder of contact
constexpr double facing = -0.25; ///< cosine between normals below which two faces face each other
constexpr int most_passes = 8;   ///< setting one pair apart may push another together

namespace bg = boost::geometry;
using TreePoint = bg::model::point<double, 2, bg::cs::cartesian>;
using TreeBox = bg::model::box<TreePoint>;
using Tree = bg::index::rtree<std::pair<TreeBox, std::size_t>, bg::index::quadratic<16>>;

TreeBox box_of(const Vec2& low, const Vec2& high) {
  return {TreePoint(low.x(), low.y()), TreePoint(high.x(), high.y())};
}

using Shifts = IndexedVector<NodeIndex, Vec2>;

/// Of several wishes for a node the largest holds.
void wish(Vec2& own, const Vec2& wanted) {
  if (wanted.squaredNorm() > own.squaredNorm()) own = wanted;
}

/// Of how many bodies the boundary of a cloud, at the places of its nodes, goes round a point: its winding
/// number.
int bodies_at(const Cloud<2>& cloud, const Fields<2>& position, const Vec2& x) {
  int turns = 0;
  for (const Facet<2>& facet : cloud.facets)
    turns += winding_of_edge(vector_at<2>(position, index_of(facet.node[0])),
                             vector_at<2>(position, index_of(facet.node[1])), x);
  return turns;
}

/// One face of an interface at the places of its nodes, to ask how deep points lie in its matter.
class PlacedFace {
public:
  PlacedFace(const std::vector<BondedSegment>& face, std::size_t side, const Fields<2>& position)
      : face_(face) {
    for (const BondedSegment& segment : face) {
      const Vec2 a = vector_at<2>(position, index_of(segment.node[0])),
                 edge = vector_at<2>(position, index_of(segment.node[1])) - a;
      from_.push_back(a);
      edge_.push_back(edge);
      outward_.push_back((side == 0 ? -1.0 : 1.0) * left_normal(edge).normalized());
      reach_ = std::max(reach_, deepest * edge.norm());
    }
    std::vector<std::pair<TreeBox, std::size_t>> boxes;
    for (std::size_t i = 0; i < size(); ++i) {
      const Vec2 to = from_[i] + edge_[i];
      boxes.emplace_back(box_of(from_[i].cwiseMin(to), from_[i].cwiseMax(to)), i);
    }
    tree_ = Tree(boxes);
  }

  std::size_t size() const { return face_.size(); }
  const BondedSegment& segment(std::size_t i) const { return face_[i]; }
  bool joined(std::size_t i) const { ///< to the one before
    return i > 0 && i < size() && face_[i].node[0] == face_[i - 1].node[1];
  }
  double length(std::size_t i) const { return edge_[i].norm(); }
  /// Outward, of the first node of a segment.
  Vec2 normal_at(std::size_t i) const {
    return joined(i) ? Vec2((outward_[i] + outward_[i - 1]).normalized()) : outward_[i];
  }

  struct Node {
    NodeIndex index;
    Vec2 place, normal; ///< outward
  };
  /// All, chain by chain with both ends of each: where a body has been cut through, faces have corners.
  std::vector<Node> nodes() const {
    std::vector<Node> all;
    for (std::size_t i = 0; i < size(); ++i) {
      all.push_back({face_[i].node[0], from_[i], normal_at(i)});
      if (!joined(i + 1)) all.push_back({face_[i].node[1], from_[i] + edge_[i], outward_[i]});
    }
    return all;
  }

  struct Foot {
    std::size_t segment;
    Vec2 place;
    Vec2 normal; ///< outward
    double gap;  ///< m, negative within the matter
  };
  /// Where the face is nearest, among what is not deeper under x than faces lie in each other; nothing where
  /// that is an end of it, or the point itself.
  std::optional<Foot> nearest(const Vec2& x) const {
    double least = std::numeric_limits<double>::infinity();
    std::size_t at = 0;
    double place = 0.0;
    const Vec2 reach = Vec2::Constant(reach_);
    std::vector<std::pair<TreeBox, std::size_t>> near;
    tree_.query(bg::index::intersects(box_of(x - reach, x + reach)), std::back_inserter(near));
    std::sort(near.begin(), near.end(), [](const auto& a, const auto& b) { return a.second < b.second; });
    for (const auto& [box, i] : near) {
      const double there = std::clamp(edge_[i].dot(x - from_[i]) / edge_[i].squaredNorm(), 0.0, 1.0);
      const double distance = (x - from_[i] - there * edge_[i]).squaredNorm();
      if (distance < least) least = distance, at = i, place = there;
    }
    if (least == 0.0 || !std::isfinite(least)) return std::nullopt;
    const Vec2 foot = from_[at] + place * edge_[at], away = x - foot;
    if (place > 0.0 && place < 1.0) return Foot{at, foot, outward_[at], outward_[at].dot(away)};
    const std::size_t node = place == 0.0 ? at : at + 1;
    if (!joined(node)) return std::nullopt;
    const Vec2 normal = normal_at(node);
    return Foot{at, foot, normal, std::copysign(away.norm(), normal.dot(away))};
  }

private:
  const std::vector<BondedSegment>& face_;
  std::vector<Vec2> from_, edge_, outward_;
  Tree tree_;
  double reach_ = 0.0; ///< m
};

/// Of pairs that were bonded and are not in contact's hands.
bool part_bonded(const CohesiveInterface& interface, const Fields<2>& position, const auto& free,
                 Shifts& shift) {
  bool any = false;
  for (std::size_t e = 0; e < interface.element.size(); ++e) {
    const CohesiveElement& element = interface.element[e];
    const PlacedElement now(element, position);
    for (std::size_t end = 0; end < 2; ++end) {
      if (free(interface.state[e][end])) continue;
      const Vec2 jump = now.jump(element, end);
      const double wide = apart * 2.0 * element.weight(), missing = wide - now.normal.dot(jump);
      if (missing <= 0.5 * wide || jump.isZero(0.0)) continue; // by less not at each reference
      any = true;
      for (std::size_t s = 0; s < 2; ++s) {
        const auto values = element.values(s, end);
        for (std::size_t a = 0; a < 2; ++a)
          if (values[a] > 0.0)
            wish(shift[element.side[s].node[a]], (s == 0 ? 0.5 : -0.5) * missing * now.normal);
      }
    }
  }
  return any;
}

/// Of what lies on each other now: faces that slide and bend overlap elsewhere than where they were bonded.
/// What stands beyond a film, on its other side, is in no matter: two bodies are to be at half the depth.
bool part_touching(const CohesiveInterface& interface, const Cloud<2>& cloud, const Fields<2>& position,
                   Shifts& shift) {
  bool any = false;
  const std::array face{PlacedFace(interface.face[0], 0, position),
                        PlacedFace(interface.face[1], 1, position)};
  for (std::size_t s = 0; s < 2; ++s) {
    const PlacedFace &own = face[s], &other = face[1 - s];
    for (const PlacedFace::Node& node : own.nodes()) {
      const auto foot = other.nearest(node.place);
      if (!foot || foot->normal.dot(node.normal) > facing) continue;
      const double length = other.length(foot->segment), wide = apart * length, missing = wide - foot->gap;
      if (missing <= 0.5 * wide || missing > deepest * length) continue;
      if (missing > shallow * length && bodies_at(cloud, position, 0.5 * (node.place + foot->place)) < 2)
        continue;
      any = true;
      wish(shift[node.index], 0.5 * missing * foot->normal);
      for (const NodeIndex of_foot : other.segment(foot->segment).node)
        wish(shift[of_foot], -0.5 * missing * foot->normal);
    }
  }
  return any;
}

/// The boundary of a cloud at the places of its nodes.
class PlacedBoundary {
public:
  PlacedBoundary(const Cloud<2>& cloud, const Fields<2>& position)
      : cloud_(cloud), position_(position), entering_(cloud.position.size(), CloudFacetIndex::none),
        leaving_(entering_) {
    std::vector<std::pair<TreeBox, CloudFacetIndex>> boxes;
    for (const CloudFacetIndex f : cloud.facets.indices()) {
      const auto [a, b] = cloud.facets[f].node;
      leaving_[a] = entering_[b] = f;
      boxes.emplace_back(box_of(at(a).cwiseMin(at(b)), at(a).cwiseMax(at(b))), f);
      reach_ = std::max(reach_, shallow * length(f));
    }
    tree_ = FacetTree(boxes);
  }

  /// Adds what sets nodes apart from facets they lie under; whether any does.
  bool wish_apart(Shifts& shift) const {
    bool any = false;
    std::vector<std::pair<TreeBox, CloudFacetIndex>> near;
    for (const NodeIndex i : leaving_.indices()) {
      if (!exists(leaving_[i])) continue;
      const Vec2 x = at(i), reach = Vec2::Constant(reach_);
      near.clear();
      tree_.query(bg::index::intersects(box_of(x - reach, x + reach)), std::back_inserter(near));
      CloudFacetIndex under = CloudFacetIndex::none;
      for (const auto& [box, f] : near) {
        if (!lies_under(i, f)) continue;
        const bool nearer = !exists(under) || gap(i, f) > gap(i, under);
        if (nearer || (gap(i, f) == gap(i, under) && f < under)) under = f;
      }
      if (!exists(under)) continue;
      any = true;
      const Vec2 half = 0.5 * (kept * length(under) - gap(i, under)) * normal(under);
      wish(shift[i], half);
      for (const NodeIndex end : cloud_.facets[under].node) wish(shift[end], -half);
    }
    return any;
  }

private:
  static constexpr double kept = 1e-6;     ///< of a facet, as contact keeps
  static constexpr double rounding = 1e-9; ///< of a facet: faces that coincide are in none
  using FacetTree = bg::index::rtree<std::pair<TreeBox, CloudFacetIndex>, bg::index::quadratic<16>>;

  Vec2 at(NodeIndex i) const { return vector_at<2>(position_, index_of(i)); }
  Vec2 edge(CloudFacetIndex f) const { return at(cloud_.facets[f].node[1]) - at(cloud_.facets[f].node[0]); }
  double length(CloudFacetIndex f) const { return edge(f).norm(); }
  Vec2 normal(CloudFacetIndex f) const { return -left_normal(edge(f)).normalized(); }
  double gap(NodeIndex i, CloudFacetIndex f) const {
    return normal(f).dot(at(i) - at(cloud_.facets[f].node[0]));
  }

  bool lies_under(NodeIndex i, CloudFacetIndex f) const {
    const auto [a, b] = cloud_.facets[f].node;
    if (i == a || i == b) return false;
    const double place = edge(f).dot(at(i) - at(a)) / edge(f).squaredNorm(), depth = -gap(i, f);
    if (place <= 0.0 || place >= 1.0 || depth <= rounding * length(f) || depth > shallow * length(f))
      return false;
    const Vec2 out = normal(f);
    if (std::min(normal(entering_[i]).dot(out), normal(leaving_[i]).dot(out)) > facing) return false;
    return bodies_at(cloud_, position_, at(i) + 0.5 * depth * out) > 1;
  }

  const Cloud<2>& cloud_;
  const Fields<2>& position_;
  IndexedVector<NodeIndex, CloudFacetIndex> entering_, leaving_; ///< [node] none: inside
  FacetTree tree_;
  double reach_ = 0.0; ///< m
};

void move(Fields<2>& position, const Shifts& shift) {
  for (const NodeIndex i : shift.indices())
    for (std::size_t k = 0; k < 2; ++k) position[k][index_of(i)] += shift[i][static_cast<Eigen::Index>(k)];
}

} // namespace

void part_boundary(const Cloud<2>& cloud, Fields<2>& position) {
  for (int pass = 0; pass < most_passes; ++pass) {
    Shifts shift(position[0].size(), Vec2::Zero());
    if (!PlacedBoundary(cloud, position).wish_apart(shift)) return;
    move(position, shift);
  }
}

const CohesiveInterface* CohesiveFaces::part(const Cloud<2>& cloud, Fields<2>& position) {
  const Fields<2> before = position;
  const auto left_free = [&](const CohesiveEnd& end) { return free(end); };
  bool any = false;
  const CohesiveInterface* last = nullptr;
  for (int pass = 0; pass <= most_passes; ++pass) {
    Shifts shift(position[0].size(), Vec2::Zero());
    last = nullptr;
    for (const CohesiveInterface& interface : interface_)
      if (pass == 0 ? part_bonded(interface, position, left_free, shift)
                    : part_touching(interface, cloud, position, shift))
        last = &interface;
    any |= last != nullptr;
    if (pass == most_passes || (pass > 0 && !last)) break;
    move(position, shift);
  }
  for (CohesiveInterface& interface : interface_)
    for (std::size_t e = 0; e < interface.element.size(); ++e) {
      const CohesiveElement& element = interface.element[e];
      std::array<CohesiveEnd, 2>& state = interface.state[e];
      for (CohesiveEnd& end : state)
        if (free(end)) end.separation = Vec2::Zero(), end.offset = 0.0; // nothing lies in the other face now
      if (!any || (free(state[0]) && free(state[1]))) continue;
      const PlacedElement was(element, before), is(element, position);
      for (std::size_t end = 0; end < 2; ++end)
        if (!free(state[end]))
          state[end].offset += is.normal.dot(is.jump(element, end)) - was.normal.dot(was.jump(element, end));
    }
  return last;
}

} // namespace cnem
