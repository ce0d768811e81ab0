#pragma once
// The flank of an edge on the surface that the edge has just made: what it presses in makes a force (Wu 1989;
// Ahmadi and Ismail 2011). Derived in docs/theory.md, "Flanks that plough".
#include "core/fields/archive.hpp"
#include "core/vec.hpp"

#include <cstddef>
#include <span>
#include <vector>

namespace cnem::machining {

/// rad: lands are a small part of a circle. Near the tip of a ball, where they would not be, they end there.
constexpr double widest_land = 0.5;

/// A land behind the edge that is part of a circle about the axis of the cutter, but for its clearance.
struct Flank {
  double land = 0.0;           ///< m behind the edge; 0: there is none
  double clearance = 0.0;      ///< rad, by which the land leaves the circle
  double recovery = 0.0;       ///< m, by which the surface springs back behind the edge
  double specific_force = 0.0; ///< N/m³, normal to the land, per volume that is pressed in
  double friction = 0.0;       ///< of the force against the motion of the edge

  bool presses() const { return land > 0.0 && specific_force > 0.0; }
  /// The same about an axis at a distance, m: near the tip of a ball lands end at `widest_land`.
  Flank about(double radius) const;
  /// m behind the edge as far as the land touches, of an edge whose way leaves the circle outwards by `rise`
  /// per length and does not vibrate.
  double contact(double rise) const;
  /// m², section that it presses in there.
  double pressed(double rise) const;
  /// N s/m², what vibrations outwards meet per length of edge at a speed, m/s, while they leave the contact
  /// as it is and are longer than it.
  double damping(double rise, double speed) const;
};

/// What edges have left behind them: their ways in the last steps, as far back as lands reach.
class FlankTraces {
public:
  /// radius: m, of each layer; step: rad that the cutter turns by.
  FlankTraces(const Flank& flank, std::span<const double> radius, std::size_t teeth, double step);

  struct Way {
    Vec2 along = Vec2::Zero();     ///< m, of the edge relative to the part in a step
    double begin = 1.0, end = 0.0; ///< shares of it between which something was cut
  };
  /// m², section pressed in by an edge, as far from the axis as `arm` says, m, at the end of a way that is
  /// not noted yet.
  double pressed(std::size_t edge, const Vec2& arm, const Way& last) const;
  /// The same of the way noted last.
  double before(std::size_t edge) const { return before_[edge]; }
  void note(std::size_t edge, const Way& last, double pressed);

  /// Throws IoError for what is of other edges.
  void archive(Archive& archive);

private:
  std::size_t edges() const { return first_.size() - 1; }

  Flank flank_;
  std::vector<std::size_t> first_; ///< [edge + 1] of way_
  std::vector<Way> way_;           ///< the last step first
  std::vector<double> before_;     ///< [edge] m²
};

} // namespace cnem::machining
