#include "voronoi/space/crossings.hpp"

#include "core/geometry/box.hpp"
#include "core/geometry/facets.hpp"
#include "core/index.hpp"
#include "voronoi/space/exact.hpp"
#include "voronoi/space/surface.hpp"
#include "voronoi/twins.hpp"

#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/box_intersection_d.h>
#include <CGAL/intersections.h>
#include <Eigen/Geometry>
#include <algorithm>

namespace cnem::voronoi {

namespace {

using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
using Point = Kernel::Point_3;
using Triangle = Kernel::Triangle_3;
using Segment = Kernel::Segment_3;

Point point(const Vec3& x) { return {x.x(), x.y(), x.z()}; }

/// A facet with its number.
struct NumberedBox : CGAL::Box_intersection_d::Box_d<double, 3, CGAL::Box_intersection_d::ID_NONE> {
  using Base = CGAL::Box_intersection_d::Box_d<double, 3, CGAL::Box_intersection_d::ID_NONE>;
  using ID = std::int32_t;
  NumberedBox(double low[3], double high[3], ID number_) : Base(low, high), number(number_) {}
  ID id() const { return number; }
  ID number;
};

class Pairs {
public:
  explicit Pairs(const Cloud<3>& cloud) : cloud_(cloud), group_(twin_groups(cloud)) {}

  bool cross(CloudFacetIndex f, CloudFacetIndex g) const {
    if (!cloud_.one_body(cloud_.facets[f].node[0], cloud_.facets[g].node[0])) return false;
    // corners that are shared come first
    auto a = cloud_.facets[f].node, b = cloud_.facets[g].node;
    std::size_t shared = 0;
    for (std::size_t k = 0; k < 3; ++k)
      for (std::size_t m = shared; m < 3; ++m)
        if (group_of(a[k]) == group_of(b[m])) {
          std::swap(b[m], b[shared]);
          std::swap(a[k], a[shared++]);
          break;
        }
    if (shared == 3 || apart_in_projection(a, b, shared) || beside(a, b, shared) || beside(b, a, shared))
      return false;
    if (shared == 2) {
      if (orientation(at(a[0]), at(a[1]), at(a[2]), at(b[2])) != 0) return false;
      return CGAL::coplanar_orientation(point(at(a[0])), point(at(a[1])), point(at(a[2])), point(at(b[2]))) !=
             CGAL::NEGATIVE;
    }
    const Triangle one = triangle(a), other = triangle(b);
    if (shared == 1)
      return CGAL::do_intersect(Segment(one[1], one[2]), other) ||
             CGAL::do_intersect(Segment(other[1], other[2]), one);
    return CGAL::do_intersect(one, other);
  }

  /// Whether the corners are on one line.
  bool flat(CloudFacetIndex f) const { return triangle(cloud_.facets[f].node).is_degenerate(); }

private:
  const Vec3& at(NodeIndex i) const { return cloud_.position[i]; }
  NodeIndex group_of(NodeIndex i) const { return group_.empty() ? i : group_[i]; }
  Triangle triangle(const std::array<NodeIndex, 3>& node) const {
    return {point(at(node[0])), point(at(node[1])), point(at(node[2]))};
  }
  /// Whether, as seen along an axis, the line of a side of one has the other facet behind it, but for corners
  /// that are shared. True for most neighbours, and quick where they are as good as on one plane.
  bool apart_in_projection(const std::array<NodeIndex, 3>& a, const std::array<NodeIndex, 3>& b,
                           std::size_t shared) const {
    Eigen::Index along = 0;
    (at(a[1]) - at(a[0])).cross(at(a[2]) - at(a[0])).cwiseAbs().maxCoeff(&along);
    const auto seen = [&](NodeIndex i) { return Vec2(at(i)[(along + 1) % 3], at(i)[(along + 2) % 3]); };
    const std::array one{seen(a[0]), seen(a[1]), seen(a[2])}, other{seen(b[0]), seen(b[1]), seen(b[2])};
    const auto behind_a_side = [&](const std::array<Vec2, 3>& of, const std::array<Vec2, 3>& what) {
      const int turn = orientation(of[0], of[1], of[2]);
      if (turn == 0) return false;
      for (std::size_t k = 0; k < 3; ++k) {
        bool behind = true;
        for (std::size_t m = shared; m < 3 && behind; ++m)
          behind = orientation(of[k], of[(k + 1) % 3], what[m]) == -turn;
        for (std::size_t m = 0; m < shared && behind; ++m)
          behind = m == k || m == (k + 1) % 3; // shared corners stand first in both
        if (behind) return true;
      }
      return false;
    };
    return behind_a_side(one, other) || behind_a_side(other, one);
  }
  /// Whether the corners of b that are not shared are all on one side of a.
  bool beside(const std::array<NodeIndex, 3>& a, const std::array<NodeIndex, 3>& b,
              std::size_t shared) const {
    int low = 1, high = -1;
    for (std::size_t m = shared; m < 3; ++m) {
      const int side = orientation(at(a[0]), at(a[1]), at(a[2]), at(b[m]));
      low = std::min(low, side);
      high = std::max(high, side);
    }
    return low > 0 || high < 0;
  }

  const Cloud<3>& cloud_;
  IndexedVector<NodeIndex, NodeIndex> group_;
};

} // namespace

std::vector<std::array<CloudFacetIndex, 2>> crossings(const Cloud<3>& cloud) {
  std::vector<NumberedBox> boxes;
  boxes.reserve(cloud.facets.size());
  for (const CloudFacetIndex f : cloud.facets.indices()) {
    Box<3> box = box_of<3>(corners_of<3>(cloud.facets[f], cloud.position));
    boxes.emplace_back(box.low.data(), box.high.data(), static_cast<std::int32_t>(f));
  }
  const Pairs pairs(cloud);
  std::vector<std::array<CloudFacetIndex, 2>> found;
  std::erase_if(boxes, [&](const NumberedBox& box) {
    const auto f = static_cast<CloudFacetIndex>(box.number);
    if (!pairs.flat(f)) return false;
    found.push_back({f, f});
    return true;
  });
  CGAL::box_self_intersection_d(boxes.begin(), boxes.end(), [&](const NumberedBox& a, const NumberedBox& b) {
    const auto f = static_cast<CloudFacetIndex>(std::min(a.number, b.number)),
               g = static_cast<CloudFacetIndex>(std::max(a.number, b.number));
    if (pairs.cross(f, g)) found.push_back({f, g});
  });
  std::sort(found.begin(), found.end());
  return found;
}

std::vector<std::array<CloudFacetIndex, 2>> crossings(const Cloud<3>& cloud,
                                                      const std::vector<CloudFacetIndex>& suspects) {
  std::vector<std::array<CloudFacetIndex, 2>> found;
  if (suspects.empty()) return found;
  const Pairs pairs(cloud);
  IndexedVector<CloudFacetIndex, Box<3>> box;
  for (const auto& facet : cloud.facets) box.push_back(box_of<3>(corners_of<3>(facet, cloud.position)));
  enum Kind : std::uint8_t { sound, suspect, flat };
  IndexedVector<CloudFacetIndex, std::uint8_t> kind(cloud.facets.size(), Kind::sound);
  for (const CloudFacetIndex f : suspects) kind[f] = pairs.flat(f) ? Kind::flat : Kind::suspect;
  for (const CloudFacetIndex f : suspects) {
    if (kind[f] == Kind::flat) {
      found.push_back({f, f});
      continue;
    }
    for (const CloudFacetIndex g : cloud.facets.indices()) {
      const bool other_pair = kind[g] == Kind::flat || (kind[g] == Kind::suspect && g <= f);
      if (other_pair || !overlap(box[f], box[g])) continue;
      const auto [low, high] = std::minmax(f, g);
      if (pairs.cross(low, high)) found.push_back({low, high});
    }
  }
  std::sort(found.begin(), found.end());
  return found;
}

std::optional<std::string> describe_crossing(const Cloud<3>& cloud) {
  const auto pairs = crossings(cloud);
  if (pairs.empty()) return std::nullopt;
  return describe_facet(cloud, pairs[0][0]) + " and " + describe_facet(cloud, pairs[0][1]);
}

} // namespace cnem::voronoi
