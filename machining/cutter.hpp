#pragma once
// A milling cutter and how it stands in the workpiece. The cutter is fed along +x and turns clockwise seen
// from +z; the angle φ of a tooth counts from +y in that sense: it is at (R sin φ, R cos φ). z goes up from
// the tip along the axis, and the edge lags behind with it.
#include "core/parameter.hpp"
#include "core/vec.hpp"
#include "machining/cutting_edge.hpp"

#include <algorithm>
#include <cmath>
#include <memory>
#include <numbers>
#include <vector>

namespace cnem::machining {

inline constexpr double full_turn = 2.0 * std::numbers::pi; ///< rad

struct Cutter {
  double diameter = 0.0;      ///< m
  std::vector<double> pitch;  ///< rad, from each tooth to the one that cuts after it; 2π together
  double helix = 0.0;         ///< rad
  double run_out = 0.0;       ///< m, of the axis of the cutter beside that of the spindle
  double run_out_angle = 0.0; ///< rad, from tooth 0 to the direction of it, clockwise
  double corner = 0.0;        ///< m, radius between end and side: 0 a flat end, the cutter's radius a ball
  /// Of tooth 0 at the begin, in place of helix and corner.
  std::shared_ptr<const CuttingEdge> edge{};

  std::size_t teeth() const { return pitch.size(); }
  double radius() const { return 0.5 * diameter; }
  /// rad that the edge lags behind its tip at a height, m.
  double lag(double z) const;
  /// rad, mean between two heights, behind where teeth are counted from.
  double mean_lag(double from, double to) const {
    return edge ? edge->lag(from, to) : lag(0.5 * (from + to));
  }
  /// Whether the radius of edges changes over the height.
  bool rounded() const { return corner > 0.0 || edge; }
  /// m over the tip, up to where there are edges.
  double top() const { return edge ? edge->top() : infinite; }
  /// rad from the tip of tooth 0 back to that of another.
  double behind(std::size_t tooth) const;
  /// rad from a tooth to the one that cut before it.
  double pitch_before(std::size_t tooth) const { return pitch[(tooth + teeth() - 1) % teeth()]; }
  /// m, of a tooth round the axis of the spindle.
  double radius_of(std::size_t tooth) const;
  /// How many teeth there are before the pitches repeat themselves.
  std::size_t pattern() const;
  /// rad, after which teeth stand as before, or, where run-out tells them apart, the same ones do.
  double period(bool told_apart) const;
  /// m, mean radius of the edges between two heights; below the tip that of the tip.
  double mean_radius(double from, double to) const;
  /// m, of the edges at a height.
  double radius_at(double z) const;
  /// m, length of the profile between two heights ≥ 0.
  double profile(double from, double to) const;
  /// rad between the axis and the normal of the profile, in the middle of its length between two heights: 90°
  /// at the side, 0 at the tip of a ball; at a height where both are one.
  double lead(double from, double to) const;

private:
  /// rad of the corner's arc from the axis up to a height.
  double arc(double z) const { return std::acos(1.0 - std::clamp(z / corner, 0.0, 1.0)); }
};

/// Teeth at equal angles.
std::vector<double> equal_pitch(std::size_t teeth);

/// Which part of a turn a cutter is in the workpiece.
struct Engagement {
  enum class Side { up, down };
  Side side = Side::down;
  double radial_depth = 0.0; ///< m; the diameter: a slot

  /// Angles at which an edge enters and leaves: 0 … acos(1 − ae/R), or acos(ae/R − 1) … π.
  double entry(const Cutter& cutter) const { return entry(cutter, cutter.radius()); }
  double exit(const Cutter& cutter) const { return exit(cutter, cutter.radius()); }
  /// Of an edge at another radius, m, of the same cutter; the same angle where it does not come to the
  /// workpiece.
  double entry(const Cutter& cutter, double radius) const;
  double exit(const Cutter& cutter, double radius) const;

private:
  /// Cosine of the angle at which a radius meets the free side of the workpiece, in up-milling.
  double side_cosine(const Cutter& cutter, double radius) const;
};

/// How a chip thickness and forces stand at an edge at φ.
inline Vec3 outward(double phi) { return {std::sin(phi), std::cos(phi), 0.0}; }
/// (tangential, radial, axial) per length into the force on the tool (x, y, z).
inline Vec3 on_tool(double phi, const Vec3& force) {
  const double s = std::sin(phi), c = std::cos(phi);
  return {-force[0] * c - force[1] * s, force[0] * s - force[1] * c, -force[2]};
}
/// The same where the normal of the edge leans by `lead` from the axis: radial is along the normal, axial
/// along the profile (Altintas and Lee 1996).
inline Vec3 on_tool(double phi, double lead, const Vec3& force) {
  const double s = std::sin(lead), c = std::cos(lead);
  return on_tool(phi, Vec3(force[0], s * force[1] + c * force[2], s * force[2] - c * force[1]));
}

} // namespace cnem::machining
