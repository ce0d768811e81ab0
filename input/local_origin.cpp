#include "input/local_origin.hpp"

#include "input/curve_checks.hpp"

#include <cmath>
#include <utility>

namespace cnem::input {
namespace {

/// Beside the middle of the outline; a round number in messages.
Vec2 origin_of(const Case& input) {
  const auto [low, high] = bounds(input.domain.outer);
  const double size = (high - low).norm();
  const double unit = std::pow(10.0, std::floor(std::log10(size)));
  Vec2 origin = 0.5 * low + 0.5 * high;
  for (double& x : origin) x = std::abs(x) > size ? std::round(x / unit) * unit : 0.0;
  if (input.analysis.kinematics == Analysis::Kinematics::axisymmetric) origin.x() = 0.0;
  return origin;
}

class Shift {
public:
  explicit Shift(const Vec2& origin) : origin_(origin) {}

  void operator()(Vec2& x) const { x -= origin_; }
  void operator()(std::vector<Vec2>& points) const {
    for (Vec2& x : points) x -= origin_;
  }
  void operator()(Curve& curve) const {
    for (CurvePiece& piece : curve.pieces) {
      for (Vec2* x : {&piece.from, &piece.to}) *x -= origin_;
      if (piece.is_arc()) piece.centre -= origin_;
    }
  }

private:
  Vec2 origin_;
};

} // namespace

void use_local_origin(Case& input) {
  input.origin = origin_of(input);
  if (input.origin == Vec2(0, 0)) return; // leaves every bit as it was written
  const Shift shift(input.origin);
  Domain& domain = input.domain;
  shift(domain.outer);
  for (Hole& hole : domain.holes) shift(hole.outline);
  for (Crack& crack : domain.cracks) shift(crack.path);
  for (Interface& interface : domain.interfaces) shift(interface.path);
  for (Region& region : domain.regions) shift(region.at);
  shift(input.cloud.nodes);
  for (clouds::Refinement& refinement : input.cloud.refinements) shift(refinement.points);
  for (BoundaryCondition& condition : input.boundary) shift(condition.points);
  if (input.initial.spin) shift(input.initial.spin->centre);
  if (input.initial.gradient) shift(input.initial.gradient->centre);
  for (Imperfection& imperfection : input.initial.imperfections) shift(imperfection.points);
  for (Tool& tool : input.tools) shift(tool.outline);
  for (Window& window : input.output.windows)
    for (Vec2* corner : {&window.lower, &window.upper}) shift(*corner);
  for (Probe& probe : input.output.probes) shift(probe.at);
  for (SampleLine& line : input.output.lines)
    for (Vec2* end : {&line.from, &line.to}) shift(*end);
}

} // namespace cnem::input
