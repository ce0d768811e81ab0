#include "core/geometry/triangle_surface.hpp"

#include "core/error.hpp"
#include "core/index.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>
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

/// Numbers of corners, those within `tolerance` of each other the same.
class Merger {
public:
  Merger(const Vec3& low, double tolerance) : low_(low), tolerance_(tolerance) {}

  std::int32_t operator()(const Vec3& x, std::vector<Vec3>& points) {
    const Cell from = cell_of(x, -tolerance_), to = cell_of(x, tolerance_);
    for (std::int64_t i = from[0]; i <= to[0]; ++i)
      for (std::int64_t j = from[1]; j <= to[1]; ++j)
        for (std::int64_t k = from[2]; k <= to[2]; ++k)
          if (const auto found = numbers_.find({i, j, k}); found != numbers_.end())
            for (const std::int32_t n : found->second)
              if ((points[index_of(n)] - x).squaredNorm() <= tolerance_ * tolerance_) return n;
    const auto number = as<std::int32_t>(points.size());
    points.push_back(x);
    numbers_[cell_of(x, 0.0)].push_back(number);
    return number;
  }

private:
  using Cell = std::array<std::int64_t, 3>;

  Cell cell_of(const Vec3& x, double further) const {
    Cell cell{};
    for (int k = 0; k < 3 && tolerance_ > 0.0; ++k)
      cell[index_of(k)] =
          static_cast<std::int64_t>(std::floor((x[k] - low_[k] + further) / (4.0 * tolerance_)));
    return cell;
  }

  Vec3 low_;
  double tolerance_;
  std::map<Cell, std::vector<std::int32_t>> numbers_;
};

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

TriangleSurface numbered_corners(const FacetSoup& soup) {
  Vec3 low = soup.triangles.front().corner[0], high = low;
  for (const FacetSoup::Triangle& facet : soup.triangles)
    for (const Vec3& x : facet.corner) {
      low = low.cwiseMin(x);
      high = high.cwiseMax(x);
    }
  Merger merge(low, 1e-6 * (high - low).norm());
  TriangleSurface surface;
  surface.triangles.reserve(soup.triangles.size());
  for (const FacetSoup::Triangle& facet : soup.triangles) {
    std::array<std::int32_t, 3>& triangle = surface.triangles.emplace_back();
    for (std::size_t k = 0; k < 3; ++k) triangle[k] = merge(facet.corner[k], surface.points);
  }
  return surface;
}

FacetSoup welded(FacetSoup soup) {
  const TriangleSurface surface = numbered_corners(soup);
  for (std::size_t t = 0; t < soup.triangles.size(); ++t) soup.triangles[t].corner = surface.corners(t);
  return soup;
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
