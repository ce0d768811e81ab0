// Triangles of tools in space lie on the surfaces that contact sees.
#include "input/tool_surface.hpp"

#include "contact/placed_shape.hpp"
#include "contact/swept_shape.hpp"

#include <gtest/gtest.h>
#include <numbers>

namespace cnem::input {
namespace {

const Box<3> unit_box{Vec3(0, 0, 0), Vec3(1, 1, 1)};

Curve polygon(const std::vector<Vec2>& corners) {
  Curve curve;
  for (std::size_t k = 0; k < corners.size(); ++k)
    curve.pieces.push_back({corners[k], corners[(k + 1) % corners.size()], {0, 0}, 0.0, false, ""});
  return curve;
}

/// A rectangle with one corner on an arc.
Curve rounded() {
  Curve curve = polygon({{0, 0}, {2, 0}, {2, 0.5}, {1.5, 1}, {0, 1}});
  curve.pieces[2] = {{2, 0.5}, {1.5, 1}, {1.5, 0.5}, 0.5, false, ""};
  return curve;
}

/// A rectangle with all corners on arcs.
Curve all_rounded() {
  constexpr double r = 0.3;
  Curve curve = polygon({{r, 0}, {2 - r, 0}, {2, r}, {2, 1 - r}, {2 - r, 1}, {r, 1}, {0, 1 - r}, {0, r}});
  const std::array<Vec2, 4> centre{Vec2(2 - r, r), Vec2(2 - r, 1 - r), Vec2(r, 1 - r), Vec2(r, r)};
  for (std::size_t k = 0; k < 4; ++k) {
    curve.pieces[2 * k + 1].centre = centre[k];
    curve.pieces[2 * k + 1].radius = r;
  }
  return curve;
}

/// Corners and middles of triangles are on the surface: the former to rounding, the latter to a chord.
void expect_on(const TriangleSurface& surface, const contact::ToolShape<3>& shape, double chord) {
  check_closed(surface);
  for (const Vec3& x : surface.points) EXPECT_LT(std::abs(shape.closest(x).distance), chord) << x.transpose();
  for (std::size_t t = 0; t < surface.triangles.size(); ++t) {
    const auto [a, b, c] = surface.corners(t);
    const auto at = shape.closest((a + b + c) / 3.0);
    EXPECT_LT(std::abs(at.distance), chord);
  }
}

TEST(ToolSurface, of_extruded_outlines_with_round_edges_and_notches) {
  ToolSolid solid;
  solid.shape = ToolSolid::Shape::extruded;
  solid.outline = all_rounded();
  solid.low = 0.0;
  solid.high = 1.0;
  solid.radius_high = 0.2;
  expect_on(tool_surface(solid, unit_box), contact::SweptShape::extruded(solid.outline, 0, 1, 0, 0.2),
            1.3e-3 * 0.2 + 0.3 / 4600);
  solid.outline = polygon({{0, 0}, {3, 0}, {3, 1}, {1, 1}, {1, 3}, {0, 3}}); // an L
  solid.radius_high = 0.0;
  const TriangleSurface el = tool_surface(solid, unit_box);
  expect_on(el, contact::SweptShape::extruded(solid.outline, 0, 1), 1e-12);
  EXPECT_NEAR(el.volume(), 5.0, 1e-12);
  solid.low.reset();
  const TriangleSurface endless = tool_surface(solid, unit_box);
  double lowest = 0.0;
  for (const Vec3& x : endless.points) lowest = std::min(lowest, x.z());
  EXPECT_LT(lowest, -1.0);
}

TEST(ToolSurface, of_boxes_and_solids_of_revolution_in_their_places) {
  ToolSolid solid;
  solid.shape = ToolSolid::Shape::box;
  solid.box = {Vec3(0, 0, 0), Vec3(1, 2, 3)};
  solid.at = {5, 6, 7};
  solid.axis = {1, 0, 0};
  const TriangleSurface box = tool_surface(solid, unit_box);
  check_closed(box);
  EXPECT_NEAR(box.volume(), 6.0, 1e-12);
  double highest = 0.0;
  for (const Vec3& x : box.points) highest = std::max(highest, x.x());
  EXPECT_NEAR(highest, 8.0, 1e-12); // its z axis lies along x

  solid = {};
  solid.shape = ToolSolid::Shape::revolved;
  solid.outline = rounded();
  const TriangleSurface full = tool_surface(solid, unit_box);
  expect_on(full, contact::SweptShape::revolved(solid.outline), 2e-4);
  solid.outline = polygon({{1, 0}, {2, 0}, {2, 1}, {1, 1}});
  const TriangleSurface ring = tool_surface(solid, unit_box);
  check_closed(ring);
  EXPECT_NEAR(ring.volume(), 3.0 * std::numbers::pi, 1e-3);
}

// A die round an opening: its outline points outwards, where corners are round by distance.
TEST(ToolSurface, of_sections_along_outlines) {
  ToolSolid solid;
  solid.shape = ToolSolid::Shape::swept;
  solid.outline = polygon({{0, 0}, {2, 0}, {2, 2}, {0, 2}});
  solid.profile = polygon({{0, 0}, {0, -1}, {0.5, -1}, {0.5, 0}});
  const TriangleSurface die = tool_surface(solid, unit_box);
  expect_on(die, contact::SweptShape::along(solid.outline, solid.profile), 3.9e-3 * 0.5);
  EXPECT_NEAR(die.volume(), 4.0 + 0.25 * std::numbers::pi, 5e-3);
}

TEST(ToolSurface, of_half_spaces_is_a_plate_larger_than_the_body) {
  ToolSolid solid;
  solid.plane = {{0.3, 0.2, 1}, {0, 0, -2}};
  const TriangleSurface plate = tool_surface(solid, unit_box);
  check_closed(plate);
  for (const Vec3& x : plate.points) {
    EXPECT_GT(x.z(), 1.0 - 1e-12); // the solid is where the normal does not point
    EXPECT_GT((x - Vec3(0.5, 0.5, x.z())).cwiseAbs().maxCoeff(), 1.0);
  }
}

} // namespace
} // namespace cnem::input
