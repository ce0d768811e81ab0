#pragma once
// Graded bodies for tests of local time steps.
#include "contact/curve_shape.hpp"
#include "tests/unit/mechanics/models.hpp"
#include "voronoi/generate.hpp"

namespace cnem::testing {

/// Rectangle [0, a] × [0, b] with sides 0 bottom, 1 right, 2 top, 3 left; `fine` along the polyline,
/// growing to `coarse`.
inline Cloud<2> graded_rectangle(double a, double b, double coarse, double fine, std::vector<Vec2> along,
                                 double growth = 0.3) {
  voronoi::DomainShape domain;
  const Vec2 corner[4] = {{0, 0}, {a, 0}, {a, b}, {0, b}};
  const char* name[4] = {"bottom", "right", "top", "left"};
  for (int i = 0; i < 4; ++i) {
    CurvePiece piece;
    piece.from = corner[i];
    piece.to = corner[(i + 1) % 4];
    piece.name = name[i];
    domain.outer.pieces.push_back(piece);
  }
  voronoi::SpacingField spacing;
  spacing.spacing = coarse;
  spacing.refinements = {{.points = std::move(along), .spacing = fine, .growth = growth}};
  return voronoi::generate_cloud(domain, spacing, {}).cloud;
}

inline contact::Tool<2> box_tool(const std::string& name, Vec2 low, Vec2 high, Vec2 velocity,
                                 contact::Friction friction) {
  Curve curve;
  const Vec2 corner[4] = {low, {high.x(), low.y()}, high, {low.x(), high.y()}};
  for (int i = 0; i < 4; ++i) {
    CurvePiece piece;
    piece.from = corner[i];
    piece.to = corner[(i + 1) % 4];
    curve.pieces.push_back(piece);
  }
  contact::Tool<2> tool;
  tool.name = name;
  tool.shape = std::make_shared<contact::CurveShape>(curve);
  tool.motion.velocity = {TimeTable(velocity.x()), TimeTable(velocity.y())};
  tool.friction = friction;
  tool.thermal = {.effusivity = 1e4, .conductance = 1e4, .temperature = 296.0};
  return tool;
}

/// A half blank between punch and die, refined where it will shear, with friction and heat: spacings differ
/// by a factor of 8.
inline Model<2> graded_shearing(double speed, double coarse = 4e-4) {
  const double fine = coarse / 8.0, clearance = 1e-4, edge = 4e-3;
  Cloud<2> cloud = graded_rectangle(10e-3, 4e-3, coarse, fine, {{edge, 0}, {edge, 4e-3}});
  std::vector<Support<2>> axis{{"axis", Support<2>::Kind::symmetry, Vec2(-1, 0), {}, nodes_on(cloud, 3)}};
  Model<2> model = model_of(cloud, Method::cnem, steel_304L());
  model.supports = Supports<2>(std::move(axis), static_cast<std::size_t>(cloud.nodes()));
  const contact::Friction friction{.coulomb = 0.1, .shear_factor = 0.5};
  model.contact = contact::RigidContact<2>(
      {box_tool("punch", {-1e-3, 4e-3}, {edge - clearance, 8e-3}, {0, -speed}, friction),
       box_tool("die", {edge + clearance, -4e-3}, {12e-3, 0}, {0, 0}, friction),
       box_tool("holder", {edge + clearance, 4e-3}, {12e-3, 8e-3}, {0, 0}, friction)});
  model.viscosity = {1.2, 0.06};
  model.thermal = true;
  return model;
}

} // namespace cnem::testing
