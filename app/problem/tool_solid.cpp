#include "app/problem/tool_solid.hpp"

#include "contact/placed_shape.hpp"
#include "contact/plane_shape.hpp"
#include "contact/swept_shape.hpp"
#include "contact/triangle_shape.hpp"
#include "core/error.hpp"
#include "core/index.hpp"
#include "voronoi/space/crossings.hpp"

#include <algorithm>

namespace cnem::app {
namespace {

using contact::SweptShape;

/// Throws GeometryError where a closed surface crosses or touches itself: there it has no side.
void refuse_crossings(const TriangleSurface& surface) {
  Cloud<3> cloud;
  cloud.position.assign(surface.points.begin(), surface.points.end());
  for (const auto& [a, b, c] : surface.triangles)
    cloud.facets.push_back({{as<NodeIndex>(a), as<NodeIndex>(b), as<NodeIndex>(c)}, PieceIndex{}});
  if (const auto pair = voronoi::describe_crossing(cloud))
    throw GeometryError("the surface crosses itself: " + *pair);
}

double reach_of(const Cloud<3>& cloud, const Vec3& from) {
  constexpr double far = 1e3;
  double reach = 0.0;
  for (const Vec3& x : cloud.position) reach = std::max(reach, (x - from).norm());
  return far * reach;
}

Curve rectangle(const Vec3& low, const Vec3& high) {
  const std::array<Vec2, 4> corner{Vec2(low.x(), low.y()), Vec2(high.x(), low.y()), Vec2(high.x(), high.y()),
                                   Vec2(low.x(), high.y())};
  Curve curve;
  for (std::size_t k = 0; k < 4; ++k)
    curve.pieces.push_back({corner[k], corner[(k + 1) % 4], {0, 0}, 0.0, false, ""});
  return curve;
}

std::shared_ptr<const contact::ToolShape<3>> own_shape(const input::ToolSolid& solid, const Cloud<3>& cloud) {
  using enum input::ToolSolid::Shape;
  const double far = reach_of(cloud, solid.at);
  switch (solid.shape) {
  case box:
    return std::make_shared<SweptShape>(
        SweptShape::extruded(rectangle(solid.box[0], solid.box[1]), solid.box[0].z(), solid.box[1].z()));
  case extruded:
    return std::make_shared<SweptShape>(SweptShape::extruded(solid.outline, solid.low.value_or(-far),
                                                             solid.high.value_or(far), solid.radius_low,
                                                             solid.radius_high));
  case revolved:
    return std::make_shared<SweptShape>(SweptShape::revolved(solid.outline));
  case swept:
    return std::make_shared<SweptShape>(SweptShape::along(solid.outline, solid.profile));
  case stl:
    try {
      const TriangleSurface surface = joined(solid.soup);
      check_closed(surface);
      refuse_crossings(surface);
      return std::make_shared<contact::TriangleShape>(surface);
    } catch (const GeometryError& error) {
      throw InputError(solid.file + ": " + error.what() + ", expected triangles that close around the solid");
    }
  case half_space:
    break;
  }
  return std::make_shared<contact::PlaneShape<3>>(solid.plane.at, solid.plane.normal,
                                                  reach_of(cloud, solid.plane.at));
}

} // namespace

std::shared_ptr<const contact::ToolShape<3>> make_solid(const input::ToolSolid& solid,
                                                        const Cloud<3>& cloud) {
  auto shape = own_shape(solid, cloud);
  const Vec3 axis = solid.axis.normalized();
  const Mat<3> rotation = contact::rotation_of_z(axis) * contact::rotation_about({0, 0, 1}, solid.turn);
  const bool own_place = solid.at == Vec3(0, 0, 0) && rotation == Mat<3>::Identity();
  if (solid.shape == input::ToolSolid::Shape::half_space || own_place) return shape;
  return std::make_shared<contact::PlacedShape>(std::move(shape), rotation, solid.at);
}

} // namespace cnem::app
