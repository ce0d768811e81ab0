#include "input/local_origin.hpp"

#include "input/curve_checks.hpp"
#include "input/space_domain.hpp"

#include <cmath>
#include <utility>

namespace cnem::input {
namespace {

std::array<Vec3, 2> bounds_of(const Domain& domain) {
  if (domain.in_space()) return space_bounds(domain);
  const auto [low, high] = bounds(domain.outer);
  return {Vec3(low.x(), low.y(), 0.0), Vec3(high.x(), high.y(), 0.0)};
}

/// Beside the middle of the workpiece; a round number in messages.
Vec3 origin_of(const Case& input) {
  const auto [low, high] = bounds_of(input.domain);
  const double size = (high - low).norm();
  const double unit = std::pow(10.0, std::floor(std::log10(size)));
  Vec3 origin = 0.5 * low + 0.5 * high;
  for (double& x : origin) x = std::abs(x) > size ? std::round(x / unit) * unit : 0.0;
  if (input.analysis.kinematics == Analysis::Kinematics::axisymmetric) origin.x() = 0.0;
  return origin;
}

class Shift {
public:
  explicit Shift(const Vec3& origin) : origin_(origin), in_plane_(origin.head<2>()) {}

  void operator()(Vec2& x) const { x -= in_plane_; }
  void operator()(Vec3& x) const { x -= origin_; }
  template<int dim> void operator()(std::vector<Vec<dim>>& points) const {
    for (Vec<dim>& x : points) (*this)(x);
  }
  void operator()(Curve& curve) const {
    for (CurvePiece& piece : curve.pieces) {
      for (Vec2* x : {&piece.from, &piece.to}) *x -= in_plane_;
      if (piece.is_arc()) piece.centre -= in_plane_;
    }
  }

private:
  Vec3 origin_;
  Vec2 in_plane_;
};

} // namespace

void use_local_origin(Case& input) {
  input.origin = origin_of(input);
  if (input.origin == Vec3(0, 0, 0)) return; // leaves every bit as it was written
  const Shift shift(input.origin);
  Domain& domain = input.domain;
  if (domain.block)
    for (Vec3* x : {&domain.block->from, &domain.block->to, &domain.block->centre}) shift(*x);
  if (domain.faceted) {
    for (auto& triangle : domain.faceted->soup.triangles)
      for (Vec3& x : triangle.corner) shift(x);
    for (auto& name : domain.faceted->names) shift(name.at);
  }
  if (domain.sweep && domain.sweep->turned) {
    shift(domain.sweep->origin);
  } else {
    shift(domain.outer);
    for (Hole& hole : domain.holes) shift(hole.outline);
  }
  if (domain.sweep)
    for (double* z : {&domain.sweep->from, &domain.sweep->to}) *z -= input.origin.z();
  for (Crack& crack : domain.cracks) shift(crack.path);
  for (Interface& interface : domain.interfaces) {
    shift(interface.path);
    shift(interface.open);
  }
  for (Region& region : domain.regions) shift(region.at);
  shift(input.cloud.nodes);
  for (clouds::Refinement& refinement : input.cloud.refinements) shift(refinement.points);
  for (clouds::SpaceRefinement& refinement : input.cloud.space_refinements) shift(refinement.points);
  for (BoundaryCondition& condition : input.boundary) shift(condition.points);
  for (Coolant& coolant : input.coolants)
    if (coolant.box)
      for (Vec2& corner : *coolant.box) shift(corner);
  if (input.initial.spin) shift(input.initial.spin->centre);
  if (input.initial.gradient) shift(input.initial.gradient->centre);
  for (Imperfection& imperfection : input.initial.imperfections) shift(imperfection.points);
  for (Tool& tool : input.tools) {
    shift(tool.outline);
    if (tool.section)
      for (clouds::Refinement& refinement : tool.section->spacing.refinements) shift(refinement.points);
    if (tool.solid) shift(tool.solid->at), shift(tool.solid->plane.at);
  }
  for (Window& window : input.output.windows)
    for (Vec2* corner : {&window.lower, &window.upper}) shift(*corner);
  if (input.output.drawing.view)
    for (Vec2& corner : *input.output.drawing.view) shift(corner);
  for (Section& section : input.output.sections) shift(section.at);
  if (input.report.blanking && input.report.blanking->centre) shift(*input.report.blanking->centre);
  for (Probe& probe : input.output.probes) shift(probe.at);
  for (SampleLine& line : input.output.lines)
    for (Vec3* end : {&line.from, &line.to}) shift(*end);
}

} // namespace cnem::input
