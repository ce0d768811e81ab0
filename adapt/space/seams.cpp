#include "adapt/space/seams.hpp"

#include "core/geometry/cell_complex.hpp"
#include "core/geometry/facets.hpp"
#include "core/index.hpp"
#include "voronoi/space/crossings.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <numbers>

namespace cnem::adapt {
namespace {

class Straightening {
public:
  Straightening(Cloud<3>& cloud, const PeriodImages& images, const IndexedVector<NodeIndex, char>& held,
                const Field& size, const SurfaceRules& rules)
      : cloud_(cloud), before_(cloud.position), rules_(rules), held_(held), size_(size),
        groups_(images.groups()),
        facets_(group_by_cell<CloudFacetIndex>(
            cloud.position.size(), cloud.facets.size(),
            [&](std::size_t f) { return cloud.facets[as<CloudFacetIndex>(f)].node; })),
        way_(cloud.position.size(), Vec3::Zero()), group_of_(cloud.position.size(), none) {
    for (std::size_t g = 0; g < groups_.size(); ++g)
      for (const NodeIndex i : groups_[g]) group_of_[i] = g;
  }

  /// The number of nodes that have moved.
  int run() {
    for (const std::vector<NodeIndex>& group : groups_)
      if (group.size() == 2) // else it is on two periods
        for (std::size_t a = 0; a < 2; ++a) consider(group[a], group[1 - a]);
    if (!move_alike(cloud_, groups_, way_, held_)) return 0;
    put_back_what_crosses();
    int moved = 0;
    for (const NodeIndex i : cloud_.position.indices()) moved += cloud_.position[i] != before_[i];
    return moved;
  }

private:
  static constexpr std::size_t none = static_cast<std::size_t>(-1);

  bool on_seam(CloudFacetIndex f) const { return rules_.is_still(cloud_.facets[f].piece); }
  Vec3 normal(CloudFacetIndex f) const { return area_normal<3>(corners_of<3>(cloud_.facets[f], before_)); }

  /// Sum of the area normals of the facets of a node, of sides or of the skin.
  Vec3 normal_at(NodeIndex i, bool of_sides) const {
    Vec3 sum = Vec3::Zero();
    for (const CloudFacetIndex f : facets_.of(index_of(i)))
      if (on_seam(f) == of_sides) sum += normal(f);
    return sum;
  }

  std::vector<PieceIndex> skin_at(NodeIndex i, NodeIndex k = NodeIndex::none) const {
    std::vector<PieceIndex> pieces;
    for (const CloudFacetIndex f : facets_.of(index_of(i))) {
      const auto& node = cloud_.facets[f].node;
      if (!on_seam(f) && (!exists(k) || std::find(node.begin(), node.end(), k) != node.end()))
        pieces.push_back(cloud_.facets[f].piece);
    }
    std::sort(pieces.begin(), pieces.end());
    pieces.erase(std::unique(pieces.begin(), pieces.end()), pieces.end());
    return pieces;
  }

  /// Ways of a node of the border, of its image and of nodes within the side beside it.
  void consider(NodeIndex i, NodeIndex image) {
    const Vec3 skin = normal_at(i, false) + normal_at(image, false), side = normal_at(i, true);
    if (skin.isZero() || side.isZero()) return; // within the side, or flat
    const Vec3 up = skin.normalized();
    static const double least = std::cos(12.0 * std::numbers::pi / 180.0);
    if (up.dot(side.normalized()) > -least) return;
    constexpr double reach = 1.5, depth = 0.4, at_once = 0.2; // h
    Vec3 over = Vec3::Zero();                                 // what is thin
    for (const CloudFacetIndex f : facets_.of(index_of(i))) {
      if (!on_seam(f)) continue;
      for (const NodeIndex k : cloud_.facets[f].node) {
        if (k == i || !skin_at(k).empty()) continue;
        const Vec3 to = before_[k] - before_[i];
        over += to;
        const double h = size_[index_of(k)], lacking = depth * h + up.dot(to);
        if (lacking > 0.0 && to.norm() < reach * h) propose(k, -std::min(lacking, at_once * h) * up);
      }
    }
    over -= up.dot(over) * up;
    if (!over.isZero()) go_along_skin(i, over.normalized());
  }

  void go_along_skin(NodeIndex i, const Vec3& over) {
    const std::vector<PieceIndex> pieces = skin_at(i);
    NodeIndex to = NodeIndex::none;
    double best = 0.5; // cosine
    for (const CloudFacetIndex f : facets_.of(index_of(i))) {
      if (on_seam(f)) continue;
      for (const NodeIndex k : cloud_.facets[f].node) {
        if (k == i || group_of_[k] != none) continue;
        const double along = over.dot((before_[k] - before_[i]).normalized());
        if (along > best && skin_at(i, k) == pieces) {
          best = along;
          to = k;
        }
      }
    }
    if (!exists(to)) return;
    constexpr double at_once = 0.3, share = 0.4; // h, of the edge
    const Vec3 edge = before_[to] - before_[i];
    propose(i, std::min(share, at_once * size_[index_of(i)] / edge.norm()) * edge);
  }

  void propose(NodeIndex i, const Vec3& way) {
    if (groups_[group_of_[i]].size() == 2 && way.norm() > way_[i].norm()) way_[i] = way;
  }

  void put_back_what_crosses() {
    for (bool any = true; any;) {
      any = false;
      for (const auto& pair : voronoi::crossings(cloud_))
        for (const CloudFacetIndex f : pair)
          for (const NodeIndex i : cloud_.facets[f].node) {
            if (cloud_.position[i] == before_[i]) continue;
            any = true;
            for (const NodeIndex k : groups_[group_of_[i]]) cloud_.position[k] = before_[k];
          }
    }
  }

  Cloud<3>& cloud_;
  const IndexedVector<NodeIndex, Vec3> before_;
  const SurfaceRules& rules_;
  const IndexedVector<NodeIndex, char>& held_;
  const Field& size_;
  std::vector<std::vector<NodeIndex>> groups_; ///< of images
  CellLists<CloudFacetIndex> facets_;          ///< [node]
  IndexedVector<NodeIndex, Vec3> way_;
  IndexedVector<NodeIndex, std::size_t> group_of_;
};

} // namespace

int straighten_seams(Cloud<3>& cloud, const PeriodImages& images, const IndexedVector<NodeIndex, char>& held,
                     const Field& size, const SurfaceRules& rules) {
  return images.empty() ? 0 : Straightening(cloud, images, held, size, rules).run();
}

} // namespace cnem::adapt
