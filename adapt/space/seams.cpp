#include "adapt/space/seams.hpp"
#include "adapt/space/least_cut.hpp"
#include "core/geometry/facets.hpp"
#include "core/index.hpp"
#include "voronoi/space/crossings.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <utility>
#include <vector>

namespace cnem::adapt {
namespace {

using voronoi::face_of_tetrahedron;
using Marks = IndexedVector<SimplexIndex, char>;

/// Where one side of a period is cut anew.
class NewCut {
public:
  NewCut(const WorkingBody& body, const SpaceStructure& structure, const SpaceRules& rules, PieceIndex side)
      : body_(body), mesh_(structure.mesh), structure_(structure), rules_(rules), side_(side),
        on_side_(body.size(), 0), on_skin_(body.size(), 0), elsewhere_(body.node().held) {
    for (const Facet<3>& facet : body.cloud().facets)
      for (const NodeIndex i : facet.node) {
        if (facet.piece == side)
          on_side_[i] = 1;
        else if (rules.surface.is_still(facet.piece))
          elsewhere_[i] = 1;
        else
          on_skin_[i] = 1;
      }
    shallow_ = shallowness();
  }

  /// m², what the side weighs where it is.
  double weight_of_side() const {
    double sum = 0.0;
    for (const SimplexIndex t : mesh_.node.indices())
      for (std::size_t k = 0; k < 4; ++k)
        if (is_of_side(t, k)) sum += weight(t, k);
    return sum;
  }

  /// What goes over; empty where the side is far from the skin or stays.
  Marks beyond() const {
    Marks free(mesh_.node.size(), 0);
    bool any = false;
    for (const SimplexIndex t : free.indices()) any |= free[t] = is_thin(t);
    if (!any) return {};
    constexpr int rings = 2;
    for (int n = 0; n < rings; ++n) widen(free);
    for (const SimplexIndex t : free.indices())
      if (std::any_of(mesh_.node[t].begin(), mesh_.node[t].end(), [&](NodeIndex i) { return elsewhere_[i]; }))
        free[t] = 0;
    return cut(free);
  }

private:
  Vec3 at(NodeIndex i) const { return body_.at(i); }
  bool is_of_side(SimplexIndex t, std::size_t k) const {
    const CloudFacetIndex f = mesh_.facet[t][k];
    return exists(f) && body_.cloud().facets[f].piece == side_;
  }

  /// Whether a tetrahedron that reaches from the side to the skin is so thin that they are nearer to each
  /// other than they should be.
  bool is_thin(SimplexIndex t) const {
    const auto& node = mesh_.node[t];
    std::vector<NodeIndex> below, skin, border;
    double h = 0.0;
    for (const NodeIndex i : node) {
      if (!on_side_[i] && !on_skin_[i]) return false;
      (!on_skin_[i] ? below : on_side_[i] ? border : skin).push_back(i);
      h += 0.25 * body_.spacing(i);
    }
    if (below.empty() || skin.empty()) return false;
    const double volume = volume_of(body_.cloud(), node);
    constexpr double thin = 0.6;             // h
    const auto height = [&](NodeIndex top) { // 3 V over the face opposite
      const std::size_t k = index_of(std::find(node.begin(), node.end(), top) - node.begin());
      return 3.0 * volume / area(t, k);
    };
    if (below.size() == 1) return height(below[0]) < thin * h;
    if (skin.size() == 1) return height(skin[0]) < thin * h;
    const Vec3 across = (at(below[1]) - at(below[0])).cross(at(skin[1]) - at(skin[0]));
    return 6.0 * volume < thin * h * across.norm();
  }

  double area(SimplexIndex t, std::size_t k) const {
    std::array<Vec3, 3> x;
    for (std::size_t c = 0; c < 3; ++c) x[c] = at(mesh_.node[t][face_of_tetrahedron[k][c]]);
    return area_normal<3>(x).norm();
  }

  /// By what has a node in common.
  void widen(Marks& marks) const {
    IndexedVector<NodeIndex, char> near(body_.size(), 0);
    for (const SimplexIndex t : marks.indices())
      if (marks[t])
        for (const NodeIndex i : mesh_.node[t]) near[i] = 1;
    for (const NodeIndex i : body_.nodes())
      if (near[i])
        for (const SimplexIndex t : structure_.tetrahedra.of(i)) marks[t] = 1;
  }

  /// [node] how much nearer than half of the spacing it lies below the skin, over that; 0 on the skin.
  Field shallowness() const {
    Field list(body_.size(), 0.0);
    for (const SimplexIndex t : mesh_.node.indices())
      for (std::size_t k = 0; k < 4; ++k) {
        const NodeIndex i = mesh_.node[t][k];
        const CloudFacetIndex f = mesh_.facet[t][k];
        if (on_skin_[i] || !exists(f) || rules_.surface.is_still(body_.cloud().facets[f].piece)) continue;
        const double depth = 3.0 * volume_of(body_.cloud(), mesh_.node[t]) / area(t, k);
        list[index_of(i)] = std::max(list[index_of(i)], 1.0 - depth / (0.5 * body_.spacing(i)));
      }
    return list;
  }

  /// m², of a face in a cut.
  double weight(SimplexIndex t, std::size_t k) const {
    constexpr double of_shallow = 4.0;
    double sum = 1.0;
    for (const std::size_t c : face_of_tetrahedron[k])
      sum += of_shallow * shallow_[index_of(mesh_.node[t][c])];
    return area(t, k) * sum;
  }

  /// Those beyond the least cut through tetrahedra that are free to go. Nodes just below the skin weigh, as a
  /// side should not end in slivers, and the side where it is weighs less, as it should not wander.
  Marks cut(const Marks& free) const {
    constexpr double keeps = 0.75;
    IndexedVector<SimplexIndex, std::size_t> vertex(free.size(), 0);
    std::size_t vertices = 0;
    for (const SimplexIndex t : free.indices())
      if (free[t]) vertex[t] = vertices++;
    const std::size_t stays = vertices++, goes = vertices++;
    std::vector<GraphEdge> edges;
    for (const SimplexIndex t : free.indices()) {
      if (!free[t]) continue;
      for (std::size_t k = 0; k < 4; ++k) {
        if (const SimplexIndex next = mesh_.neighbour[t][k]; exists(next)) {
          if (!free[next])
            edges.push_back({stays, vertex[t], weight(t, k)});
          else if (t < next)
            edges.push_back({vertex[t], vertex[next], weight(t, k)});
        } else if (is_of_side(t, k)) {
          edges.push_back({vertex[t], goes, keeps * weight(t, k)});
        }
      }
    }
    const std::vector<char> over = side_of_least_cut(vertices, edges, goes, stays);
    Marks beyond(free.size(), 0);
    for (const SimplexIndex t : free.indices()) beyond[t] = free[t] && over[vertex[t]];
    return beyond;
  }

  const WorkingBody& body_;
  const voronoi::Tetrahedra& mesh_;
  const SpaceStructure& structure_;
  const SpaceRules& rules_;
  PieceIndex side_;
  IndexedVector<NodeIndex, char> on_side_, on_skin_;
  IndexedVector<NodeIndex, char> elsewhere_; ///< on other sides, or held
  Field shallow_;                            ///< [node] as shallowness()
};

} // namespace

bool recut_sides(WorkingBody& body, SpaceStructure& structure, const SpaceRules& rules, PassReport& report) {
  bool any = false;
  for (const Period& period : rules.periods)
    for (const PieceIndex side : period) {
      const NewCut cut(body, structure, rules, side);
      const Marks beyond = cut.beyond();
      if (std::find(beyond.begin(), beyond.end(), 1) == beyond.end()) continue;
      WorkingBody recut = body;
      SpaceStructure now = structure;
      PassReport told;
      if (hand_over(recut, now, rules, beyond, told) == 0) continue;
      if (NewCut(recut, now, rules, side).weight_of_side() >= cut.weight_of_side()) continue; // not all went
      if (!voronoi::crossings(recut.cloud()).empty()) continue;
      body = std::move(recut);
      body.set_sound();
      structure = std::move(now);
      report += told;
      any = true;
    }
  return any;
}

} // namespace cnem::adapt
