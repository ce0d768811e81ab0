#include "input/cutting_tool.hpp"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <numbers>

namespace cnem::input {
namespace {

/// m, of the point of a piece that reaches furthest along the unit vector d, along it.
double reach(const CurvePiece& piece, const Vec2& d) {
  double most = std::max(piece.from.dot(d), piece.to.dot(d));
  if (!piece.is_arc()) return most;
  const double sweep = piece.sweep(), sense = sweep < 0.0 ? -1.0 : 1.0;
  const Vec2 first = piece.from - piece.centre;
  double turn = sense * std::atan2(cross(first, d), first.dot(d)); // from the beginning to d
  if (turn < 0.0) turn += 2.0 * std::numbers::pi;
  if (turn <= std::abs(sweep)) most = std::max(most, piece.centre.dot(d) + piece.radius);
  return most;
}
double reach(const Curve& curve, const Vec2& d) {
  double most = -infinite;
  for (const CurvePiece& piece : curve.pieces) most = std::max(most, reach(piece, d));
  return most;
}

Vec2 motion_of(const Tool& tool, double end) {
  Vec2 way = tool.drive ? Vec2(end * tool.drive->initial_velocity.head<2>()) : Vec2(0, 0);
  for (std::size_t k = 0; k < 2; ++k)
    if (tool.velocity[k]) way[static_cast<int>(k)] = tool.velocity[k]->integral(end);
  return way;
}

/// The longest straight side whose normal leans less than 80 degrees from the motion; null: there is none.
const CurvePiece* rake_face(const Curve& outline, const Vec2& along) {
  const double least = std::cos(80.0 * std::numbers::pi / 180.0);
  const CurvePiece* longest = nullptr;
  for (const CurvePiece& piece : outline.pieces) {
    if (piece.is_arc() || right_normal(piece.tangent(0.0)).dot(along) < least) continue;
    if (!longest || piece.length() > longest->length()) longest = &piece;
  }
  return longest;
}

} // namespace

Vec2 CuttingTool::face() const { return {-std::sin(rake), std::cos(rake)}; }
Vec2 CuttingTool::normal() const { return {std::cos(rake), std::sin(rake)}; }

CuttingTool cutting_tool(const Case& input, std::size_t index) {
  const Tool& tool = input.tools[index];
  const Vec2 motion = motion_of(tool, input.time.end);
  if (!(motion.norm() > 0.0))
    throw InputError(
        fmt::format("found the tool '{}', which stays where it is, expected one that moves through the "
                    "workpiece",
                    tool.name));
  CuttingTool cut;
  cut.along = motion.normalized();
  cut.away = left_normal(cut.along);
  const auto beyond = [&](const Vec2& d) { return reach(tool.outline, d) - reach(input.domain.outer, d); };
  if (beyond(cut.away) < beyond(-cut.away)) cut.away = -cut.away; // a tool stands out of the workpiece
  const CurvePiece* face = rake_face(tool.outline, cut.along);
  if (!face)
    throw InputError(fmt::format("found the tool '{}', none of whose straight sides faces the way that it "
                                 "moves, expected one with a rake face",
                                 tool.name));
  const Vec2 normal = cut.turned(right_normal(face->tangent(0.0)));
  cut.rake = std::atan2(normal.y(), normal.x());
  const double lowest = -reach(tool.outline, -cut.away);
  const bool upwards = face->to.dot(cut.away) > face->from.dot(cut.away);
  const Vec2 &low = upwards ? face->from : face->to, &high = upwards ? face->to : face->from;
  const Vec2 side = (high - low).normalized();
  cut.begin = (low.dot(cut.away) - lowest) / side.dot(cut.away);
  cut.end = cut.begin + face->length();
  cut.tip = low - cut.begin * side;
  cut.depth = reach(input.domain.outer, cut.away) - lowest;
  if (!(cut.depth > 0.0))
    throw InputError(fmt::format("found the tool '{}', which passes the workpiece at a distance of {:.3g} m, "
                                 "expected one that reaches into it",
                                 tool.name, -cut.depth));
  return cut;
}

} // namespace cnem::input
