#pragma once
// How thick the solid inside an outline is where a straight path goes through it: in a step longer than that
// a node passes a tool unseen.
#include "core/geometry/curve.hpp"

#include <vector>

namespace cnem::contact {

/// Arcs are taken as chords. A path goes through where it leaves by a face whose outward normal is turned by
/// more than 114° (cosine below −0.4) from that of the face it entered by; where it is turned less the path
/// cuts a corner, which is contact of a ridge.
class Thickness {
public:
  /// Of a closed curve that runs counter-clockwise round the solid.
  explicit Thickness(const Curve& outline);

  /// m; no shorter path goes through.
  double least() const { return least_; }
  /// m, of the shortest way through along a unit vector, of those at the middle of each chord; infinite where
  /// there is none.
  double along(const Vec2& direction) const;
  /// m, how much of the straight path lies inside where it goes through; 0 where it does not. What begins
  /// inside has entered by the face next to it.
  double passed(const Vec2& from, const Vec2& to) const;

private:
  struct Chord {
    Vec2 from, to;
    Vec2 along, normal; ///< –, unit; outward normal
    double length;      ///< m
  };
  struct Crossing {
    double at;    ///< fraction of the path
    Vec2 normal;  ///< of the chord
    bool leaving; ///< the solid
  };

  double distance(const Chord& chord, const Vec2& x) const;
  /// In their order along the path.
  std::vector<Crossing> crossings(const Vec2& from, const Vec2& to) const;
  const Chord& nearest(const Vec2& x) const;

  std::vector<Chord> chords_;
  double size_ = 0.0; ///< m, length of the outline
  double least_;
};

} // namespace cnem::contact
