#include "app/problem/tool_overlap.hpp"

#include "clouds/space/facet_tree.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace cnem::app {
namespace {

/// The deepest place of a tool below the surface of a body.
class DeepestPlace {
public:
  DeepestPlace(const contact::ToolShape<3>& tool, const clouds::FacetTree& body, double allowed)
      : tool_(tool), body_(body), allowed_(allowed) {}

  std::optional<ToolOverlap> in(const Box<3>& box) {
    const Vec3 extent = box.high - box.low;
    search(0.5 * (box.low + box.high), 0.5 * extent.maxCoeff());
    if (deepest_.depth <= allowed_) return std::nullopt;
    return deepest_;
  }

private:
  double depth_at(const Vec3& x) const {
    return body_.nearest(x, std::numeric_limits<double>::max()).distance;
  }
  void search(const Vec3& middle, double half) {
    const double reach = std::sqrt(3.0) * half;
    const contact::SurfacePoint<3> at = tool_.closest(middle);
    if (at.distance > reach) return;
    const double depth = depth_at(middle);
    if (depth + reach <= wanted()) return;
    if (at.distance <= 0.0) take(depth, middle);
    // beyond the medial axis the foot of some shapes is off their surface
    else if (depth + at.distance > wanted() && tool_.closest(at.point).distance <= 1e-9 * half)
      take(depth_at(at.point), at.point);
    if (half < allowed_ / 8.0) return;
    for (int k = 0; k < 8; ++k)
      search(middle + 0.5 * half * Vec3(k & 1 ? 1 : -1, k & 2 ? 1 : -1, k & 4 ? 1 : -1), 0.5 * half);
  }
  double wanted() const { return std::max(allowed_, 1.1 * deepest_.depth); }
  void take(double depth, const Vec3& x) {
    if (depth > wanted()) deepest_ = {depth, x};
  }

  const contact::ToolShape<3>& tool_;
  const clouds::FacetTree& body_;
  double allowed_;
  ToolOverlap deepest_;
};

} // namespace

std::optional<ToolOverlap> overlap_at_start(const contact::ToolShape<3>& tool, const Cloud<3>& cloud,
                                            double allowed) {
  for (const Vec3& x : cloud.position)
    if (const double distance = tool.closest(x).distance; distance < -allowed)
      return ToolOverlap{-distance, x};
  Box<3> box = box_of<3>(cloud.position);
  const Box<3> own = tool.bounds();
  box.low = (box.low.array() + allowed).matrix().cwiseMax(own.low);
  box.high = (box.high.array() - allowed).matrix().cwiseMin(own.high);
  if (!((box.high - box.low).minCoeff() > 0.0)) return std::nullopt;
  return DeepestPlace(tool, clouds::FacetTree(cloud), allowed).in(box);
}

} // namespace cnem::app
