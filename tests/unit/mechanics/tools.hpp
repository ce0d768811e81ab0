#pragma once
// Rigid tools for tests of the solver.
#include "contact/curve_shape.hpp"
#include "tests/curves.hpp"
#include "tests/unit/mechanics/models.hpp"

namespace cnem::testing {

inline contact::Tool<2> rigid_tool(const std::string& name, const Curve& outline,
                                   const Vec2& velocity = {0, 0}, const contact::Friction& friction = {}) {
  contact::Tool<2> tool;
  tool.name = name;
  tool.shape = std::make_shared<contact::CurveShape>(outline);
  tool.motion.velocity = {TimeTable(velocity.x()), TimeTable(velocity.y())};
  tool.friction = friction;
  return tool;
}

/// The same, a box that takes heat.
inline contact::Tool<2> warm_box(const std::string& name, const Vec2& low, const Vec2& high,
                                 const Vec2& velocity, const contact::Friction& friction) {
  contact::Tool<2> tool = rigid_tool(name, box(low, high), velocity, friction);
  tool.thermal = {.conductance = 1e4, .temperature = 296.0, .effusivity = 1e4};
  return tool;
}

} // namespace cnem::testing
