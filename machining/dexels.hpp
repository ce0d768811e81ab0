#pragma once
// The workpiece as dexels: lines of matter in layers across the axis of the cutter, along y and along x.
#include "core/vec.hpp"

#include <array>
#include <optional>
#include <span>
#include <vector>

namespace cnem::machining {

struct Interval {
  double low = 0.0, high = 0.0; ///< m
};

/// Matter of one layer of a box: lines in both directions, each with any number of intervals.
class DexelLayer {
public:
  /// pitch: m, of lines along y, which stand beside each other in x, and of lines along x; the sides of the
  /// box are divided into whole lines no farther apart.
  DexelLayer(const Vec2& low, const Vec2& high, const Vec2& pitch);

  /// What an edge sweeps in a step: its path from a to b, the normal out of the cutter in the middle of it,
  /// of length 1, how far behind the path lines along x and lines along y are taken, and the radius of the
  /// edge round the axis. m
  struct Sweep {
    Vec2 a, b, normal, reach;
    double radius = 0.0;
  };

  /// The chip of the edge, m: removed area over the length of its path, from the lines that the path meets,
  /// of those along the axis that the normal is nearer to, because it meets more of these. What lies on a
  /// line is cut while the rake goes along it; where the lines tell how the chip changes with the angle, it
  /// is that of the moment in which the edge meets the line. None where it meets no line.
  std::optional<double> chip(const Sweep& sweep) const;
  /// Takes it away, of lines along both axes.
  void erase(const Sweep& sweep);
  /// Takes away all within a disc, and within a rectangle.
  void erase_disc(const Vec2& centre, double radius);
  void erase_box(const Vec2& low, const Vec2& high);

  /// Area of matter as lines along an axis see it, m².
  double area(int axis) const;
  /// Lines along an axis: their places across it, and the matter of one of them in order.
  std::size_t lines(int axis) const { return set_[index(axis)].line.size(); }
  double place(int axis, std::size_t line) const {
    return set_[index(axis)].begin + (static_cast<double>(line) + 0.5) * set_[index(axis)].pitch;
  }
  std::span<const Interval> matter(int axis, std::size_t line) const { return set_[index(axis)].line[line]; }

private:
  struct Lines {
    double begin = 0.0, pitch = 0.0; ///< m, across
    std::vector<std::vector<Interval>> line;
  };
  static std::size_t index(int axis) { return static_cast<std::size_t>(axis); }
  /// What one line tells of a chip: where the edge meets it and where the rake leaves its matter, m along the
  /// path from the middle of the step, and the chip there.
  struct Sample {
    double edge = 0.0, end = 0.0, chip = 0.0;
  };
  Sample sample(int axis, double line, const Sweep& sweep) const;
  template<class Visit> void meet(int axis, const Sweep& sweep, Visit&& visit) const;
  template<class Ends> void erase_between(int axis, const Ends& ends);

  std::array<Lines, 2> set_; ///< along x, along y
};

} // namespace cnem::machining
