#include "core/geometry/plane_section.hpp"

#include "core/index.hpp"

#include <algorithm>
#include <map>

namespace cnem {
namespace {

using Edge = std::array<std::int32_t, 2>; ///< lower point first

Edge edge_of(std::int32_t a, std::int32_t b) { return {std::min(a, b), std::max(a, b)}; }

/// From the edge on which the way through a triangle begins to the one on which it ends.
struct Passage {
  Edge end;
  std::int32_t triangle;
  bool taken = false;
};

} // namespace

double SectionLoop::area() const {
  double twice = 0.0;
  for (std::size_t k = 0; k < point.size(); ++k)
    twice += cross(point[k], point[k + 1 < point.size() ? k + 1 : 0]);
  return 0.5 * twice;
}

std::vector<SectionLoop> cut(const TriangleSurface& surface, const CutPlane& plane) {
  const Vec3 towards = plane.towards();
  std::vector<double> height;
  height.reserve(surface.points.size());
  for (const Vec3& x : surface.points) height.push_back(towards.dot(x - plane.at));
  std::map<Edge, Passage> from;
  std::vector<Edge> order;
  for (std::size_t t = 0; t < surface.triangles.size(); ++t) {
    const auto& corner = surface.triangles[t];
    Edge start{-1, -1}, stop{-1, -1};
    for (std::size_t k = 0; k < 3; ++k) {
      const std::int32_t a = corner[k], b = corner[(k + 1) % 3];
      const bool above_a = height[index_of(a)] >= 0.0, above_b = height[index_of(b)] >= 0.0;
      if (above_a && !above_b) start = edge_of(a, b);
      if (!above_a && above_b) stop = edge_of(a, b);
    }
    if (start[0] < 0) continue;
    if (from.try_emplace(start, Passage{stop, as<std::int32_t>(t)}).second) order.push_back(start);
  }
  std::vector<SectionLoop> loops;
  for (const Edge& first : order) {
    SectionLoop loop;
    Edge at = first;
    for (auto next = from.find(at); next != from.end() && !next->second.taken; next = from.find(at)) {
      const double a = height[index_of(at[0])], b = height[index_of(at[1])], share = a / (a - b);
      const Vec3 &x = surface.points[index_of(at[0])], &y = surface.points[index_of(at[1])];
      loop.point.push_back(plane.flat(x + share * (y - x)));
      loop.edge.push_back(at);
      loop.share.push_back(share);
      loop.triangle.push_back(next->second.triangle);
      next->second.taken = true;
      at = next->second.end;
    }
    if (loop.point.size() > 2 && at == first) loops.push_back(std::move(loop));
  }
  return loops;
}

bool inside(std::span<const Vec2> polygon, const Vec2& x) {
  bool odd = false;
  for (std::size_t k = 0; k < polygon.size(); ++k) {
    const Vec2 &a = polygon[k], &b = polygon[k + 1 < polygon.size() ? k + 1 : 0];
    if ((a.y() > x.y()) != (b.y() > x.y()) &&
        x.x() < a.x() + (x.y() - a.y()) / (b.y() - a.y()) * (b.x() - a.x()))
      odd = !odd;
  }
  return odd;
}

std::vector<std::array<std::size_t, 3>> ear_triangles(const std::vector<Vec2>& polygon) {
  std::vector<std::size_t> left;
  for (std::size_t k = 0; k < polygon.size(); ++k)
    if (polygon[k] != polygon[(k + 1) % polygon.size()]) left.push_back(k);
  std::vector<std::array<std::size_t, 3>> triangles;
  while (left.size() > 2) {
    const std::size_t n = left.size();
    std::size_t ear = 0; // where rounding leaves none
    for (std::size_t k = 0; k < n; ++k) {
      const Vec2 &a = polygon[left[(k + n - 1) % n]], &b = polygon[left[k]], &c = polygon[left[(k + 1) % n]];
      if (!(cross(b - a, c - b) > 0.0)) continue;
      const bool free = std::none_of(left.begin(), left.end(), [&](std::size_t i) {
        const Vec2& x = polygon[i];
        if (x == a || x == b || x == c) return false;
        return cross(b - a, x - a) >= 0.0 && cross(c - b, x - b) >= 0.0 && cross(a - c, x - c) >= 0.0;
      });
      if (!free) continue;
      ear = k;
      break;
    }
    triangles.push_back({left[(ear + n - 1) % n], left[ear], left[(ear + 1) % n]});
    left.erase(left.begin() + static_cast<std::ptrdiff_t>(ear));
  }
  return triangles;
}

} // namespace cnem
