#include "input/tool_surface.hpp"

#include "contact/placed_shape.hpp"
#include "core/geometry/plane_section.hpp"
#include "core/index.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace cnem::input {
namespace {

/// A place of an outline: what stands off it by d lies at foot + d · away, inwards (d < 0) or outwards.
struct Stand {
  Vec2 foot, inwards, outwards;

  Vec2 at(double d) const { return foot + d * (d < 0.0 ? inwards : outwards); }
};

/// Sharp corners are rounded on the side that they point to, as distances from an outline are.
std::vector<Stand> stands_of(const std::vector<Vec2>& polygon) {
  constexpr double step = std::numbers::pi / 18.0; // what turns by less is part of an arc
  std::vector<Stand> stands;
  const std::size_t n = polygon.size();
  for (std::size_t k = 0; k < n; ++k) {
    const Vec2 before = right_normal(polygon[k] - polygon[(k + n - 1) % n]).normalized(),
               after = right_normal(polygon[(k + 1) % n] - polygon[k]).normalized();
    const double turn = std::atan2(cross(before, after), before.dot(after));
    const Vec2 mitre = (before + after) / std::max(1.0 + before.dot(after), 1e-3);
    const int fan = std::abs(turn) > step ? static_cast<int>(std::ceil(std::abs(turn) / step)) : 0;
    if (fan == 0) {
      stands.push_back({polygon[k], mitre, mitre});
      continue;
    }
    for (int i = 0; i <= fan; ++i) {
      const double angle = turn * i / fan, c = std::cos(angle), s = std::sin(angle);
      const Vec2 round(c * before.x() - s * before.y(), s * before.x() + c * before.y());
      if (turn > 0.0)
        stands.push_back({polygon[k], mitre, round});
      else
        stands.push_back({polygon[k], round, mitre});
    }
  }
  return stands;
}

class Soup {
public:
  void add(const Vec3& a, const Vec3& b, const Vec3& c) { soup_.triangles.push_back({{a, b, c}, 0}); }
  /// The strip between two rows of points, those of the second to the right of those of the first.
  void strip(const std::vector<Vec3>& one, const std::vector<Vec3>& other) {
    for (std::size_t k = 0; k < one.size(); ++k) {
      const std::size_t next = k + 1 < one.size() ? k + 1 : 0;
      add(one[k], one[next], other[next]);
      add(one[k], other[next], other[k]);
    }
  }
  TriangleSurface joined() const { return cnem::joined(soup_); }

private:
  FacetSoup soup_;
};

std::vector<Vec3> row(const std::vector<Stand>& stands, const Vec2& place) {
  std::vector<Vec3> points;
  points.reserve(stands.size());
  for (const Stand& stand : stands) {
    const Vec2 x = stand.at(place.x());
    points.emplace_back(x.x(), x.y(), place.y());
  }
  return points;
}

void add_end(Soup& soup, const std::vector<Vec3>& points, bool upper) {
  std::vector<Vec2> polygon;
  for (const Vec3& x : points) polygon.emplace_back(x.head<2>());
  for (const auto& [a, b, c] : ear_triangles(polygon))
    soup.add(points[a], points[upper ? b : c], points[upper ? c : b]);
}

/// Quarter of a circle about `centre` from the angle `from` on.
void add_edge(std::vector<Vec2>& section, const Vec2& centre, double radius, double from) {
  constexpr int steps = 16;
  for (int k = 0; k <= (radius > 0.0 ? steps : 0); ++k) {
    const double angle = from + 0.5 * std::numbers::pi * k / steps;
    section.emplace_back(centre + radius * Vec2(std::cos(angle), std::sin(angle)));
  }
}

TriangleSurface extruded(const std::vector<Vec2>& outline, double low, double high, double radius_low,
                         double radius_high) {
  std::vector<Vec2> section;
  add_edge(section, {-radius_low, low + radius_low}, radius_low, -0.5 * std::numbers::pi);
  add_edge(section, {-radius_high, high - radius_high}, radius_high, 0.0);
  const std::vector<Stand> stands = stands_of(outline);
  Soup soup;
  for (std::size_t k = 0; k + 1 < section.size(); ++k)
    soup.strip(row(stands, section[k]), row(stands, section[k + 1]));
  add_end(soup, row(stands, section.front()), false);
  add_end(soup, row(stands, section.back()), true);
  return soup.joined();
}

TriangleSurface swept(const Curve& outline, const Curve& profile) {
  const std::vector<Stand> stands = stands_of(outline.polygon());
  const std::vector<Vec2> section = profile.polygon();
  Soup soup;
  for (std::size_t k = 0; k < section.size(); ++k)
    soup.strip(row(stands, section[k]), row(stands, section[(k + 1) % section.size()]));
  return soup.joined();
}

TriangleSurface revolved(const Curve& outline) {
  constexpr int steps = 360;
  const std::vector<Vec2> section = outline.polygon();
  double size = 0.0;
  for (const Vec2& x : section) size = std::max(size, x.norm());
  const auto ring = [&](const Vec2& x) {
    const double r = x.x() > 1e-9 * size ? x.x() : 0.0; // as contact/swept_shape.cpp
    std::vector<Vec3> points;
    for (int k = 0; k < steps; ++k) {
      const double angle = 2.0 * std::numbers::pi * k / steps;
      points.emplace_back(r > 0.0 ? Vec3(r * std::cos(angle), r * std::sin(angle), x.y())
                                  : Vec3(0, 0, x.y()));
    }
    return points;
  };
  Soup soup;
  for (std::size_t k = 0; k < section.size(); ++k)
    soup.strip(ring(section[k]), ring(section[(k + 1) % section.size()]));
  return soup.joined();
}

std::vector<Vec2> rectangle(const Vec2& low, const Vec2& high) {
  return {low, {high.x(), low.y()}, high, {low.x(), high.y()}};
}

void place(TriangleSurface& surface, const Mat<3>& rotation, const Vec3& shift) {
  for (Vec3& x : surface.points) x = rotation * x + shift;
}

TriangleSurface plate(const Plane& plane, const Box<3>& around) {
  const double size = (around.high - around.low).norm();
  const Vec3 normal = plane.normal.normalized(), middle = 0.5 * (around.low + around.high);
  TriangleSurface surface = extruded(rectangle(Vec2::Constant(-0.75 * size), Vec2::Constant(0.75 * size)),
                                     -0.06 * size, 0.0, 0.0, 0.0);
  place(surface, contact::rotation_of_z(normal), middle - normal.dot(middle - plane.at) * normal);
  return surface;
}

} // namespace

TriangleSurface tool_surface(const ToolSolid& solid, const Box<3>& around) {
  using Shape = ToolSolid::Shape;
  const Vec3 middle = 0.5 * (around.low + around.high);
  const double far = (middle - solid.at).norm() + 1.5 * (around.high - around.low).norm();
  const Vec3 &low = solid.box[0], &high = solid.box[1];
  TriangleSurface surface;
  switch (solid.shape) {
  case Shape::half_space:
    return plate(solid.plane, around);
  case Shape::box:
    surface = extruded(rectangle(low.head<2>(), high.head<2>()), low.z(), high.z(), 0.0, 0.0);
    break;
  case Shape::extruded:
    surface = extruded(solid.outline.polygon(), solid.low.value_or(-far), solid.high.value_or(far),
                       solid.radius_low, solid.radius_high);
    break;
  case Shape::revolved:
    surface = revolved(solid.outline);
    break;
  case Shape::swept:
    surface = swept(solid.outline, solid.profile);
    break;
  case Shape::stl:
    surface = joined(solid.soup);
    break;
  }
  const Vec3 axis = solid.axis.normalized();
  place(surface, contact::rotation_of_z(axis) * contact::rotation_about({0, 0, 1}, solid.turn), solid.at);
  return surface;
}

} // namespace cnem::input
