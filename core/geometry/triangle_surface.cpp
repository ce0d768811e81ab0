#include "core/geometry/triangle_surface.hpp"

#include "core/error.hpp"
#include "core/index.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <fmt/format.h>
#include <map>
#include <tuple>

namespace cnem {
namespace {

/// An edge of a triangle, from the point with the lower number to that with the higher.
struct Side {
  std::int32_t low, high;
  bool upwards;
  std::size_t triangle;
};

std::string describe(const TriangleSurface& surface, std::size_t t) {
  const auto corner = surface.corners(t);
  const Vec3 middle = (corner[0] + corner[1] + corner[2]) / 3.0;
  return fmt::format("{} at ({:.6g}, {:.6g}, {:.6g}) m", t + 1, middle.x(), middle.y(), middle.z());
}

std::string list(const TriangleSurface& surface, std::vector<std::size_t> triangles) {
  std::sort(triangles.begin(), triangles.end());
  triangles.erase(std::unique(triangles.begin(), triangles.end()), triangles.end());
  std::string text;
  for (std::size_t k = 0; k < std::min<std::size_t>(3, triangles.size()); ++k)
    text += (k > 0 ? ", " : "") + describe(surface, triangles[k]);
  return text + (triangles.size() > 3 ? fmt::format(" and {} more", triangles.size() - 3) : "");
}

} // namespace

double TriangleSurface::volume() const {
  double sum = 0.0;
  for (std::size_t t = 0; t < triangles.size(); ++t) {
    const auto corner = corners(t);
    sum += (corner[0] - points[0]).dot((corner[1] - points[0]).cross(corner[2] - points[0]));
  }
  return sum / 6.0;
}

void check_closed(const TriangleSurface& surface) {
  if (surface.triangles.empty()) throw GeometryError("a surface without triangles encloses nothing");
  std::vector<Side> sides;
  std::vector<std::size_t> flat, open, crowded, turned;
  for (std::size_t t = 0; t < surface.triangles.size(); ++t) {
    const auto corner = surface.corners(t);
    const Vec3 e = corner[1] - corner[0], f = corner[2] - corner[0];
    const double longest2 = std::max({e.squaredNorm(), f.squaredNorm(), (f - e).squaredNorm()});
    if (!(e.cross(f).norm() > 1e-10 * longest2)) flat.push_back(t);
    for (std::size_t k = 0; k < 3; ++k) {
      const std::int32_t a = surface.triangles[t][k], b = surface.triangles[t][(k + 1) % 3];
      sides.push_back({std::min(a, b), std::max(a, b), a < b, t});
    }
  }
  std::sort(sides.begin(), sides.end(), [](const Side& a, const Side& b) {
    return std::tie(a.low, a.high, a.triangle) < std::tie(b.low, b.high, b.triangle);
  });
  for (std::size_t k = 0; k < sides.size();) {
    std::size_t end = k;
    while (end < sides.size() && sides[end].low == sides[k].low && sides[end].high == sides[k].high) ++end;
    auto& fault = end - k == 1 ? open : end - k > 2 ? crowded : turned;
    if (end - k != 2 || sides[k].upwards == sides[k + 1].upwards)
      for (std::size_t s = k; s < end; ++s) fault.push_back(sides[s].triangle);
    k = end;
  }
  if (!open.empty())
    throw GeometryError(fmt::format("the surface is open: triangles with an edge that no other one has: {}",
                                    list(surface, open)));
  if (!crowded.empty())
    throw GeometryError(fmt::format("more than two triangles meet at an edge: {}", list(surface, crowded)));
  if (!turned.empty())
    throw GeometryError(fmt::format("neighbouring triangles face opposite sides: {}", list(surface, turned)));
  if (!flat.empty()) throw GeometryError(fmt::format("triangles without area: {}", list(surface, flat)));
  if (!(surface.volume() > 0.0))
    throw GeometryError(fmt::format("the surface is inside out: its normals enclose {:.6g} m³, triangle {}",
                                    surface.volume(), describe(surface, 0)));
}

TriangleSurface joined(const FacetSoup& soup) {
  TriangleSurface surface;
  std::map<std::array<double, 3>, std::int32_t> number;
  for (const FacetSoup::Triangle& facet : soup.triangles) {
    std::array<std::int32_t, 3> triangle{};
    for (std::size_t k = 0; k < 3; ++k) {
      const Vec3 x = facet.corner[k] + Vec3::Zero(); // −0 is 0
      const auto [found, is_new] =
          number.try_emplace({x.x(), x.y(), x.z()}, as<std::int32_t>(surface.points.size()));
      if (is_new) surface.points.push_back(x);
      triangle[k] = found->second;
    }
    if (triangle[0] != triangle[1] && triangle[1] != triangle[2] && triangle[2] != triangle[0])
      surface.triangles.push_back(triangle);
  }
  return surface;
}

} // namespace cnem
