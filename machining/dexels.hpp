#pragma once
// The workpiece as dexels: bars of matter in layers across the axis of the cutter (paper 004, 3.2). The ends
// of a dexel are as oblique as the rakes that cut it: what rakes sweep is taken exactly, however wide it is.
#include "core/fields/archive.hpp"
#include "core/vec.hpp"

#include <array>
#include <cstdint>
#include <span>
#include <string>
#include <utility>
#include <vector>

namespace cnem::machining {

struct Interval {
  double low = 0.0, high = 0.0; ///< m
};

/// A rake face where a layer crosses it, from the edge to as deep as chips are. m
struct Rake {
  Vec2 edge, inner;
};

/// What a rake sweeps in a step, (6): the region between its first and last place, whose outer side is the
/// way of the edge. The rake goes forward, clockwise round its inner end.
struct Sweep {
  Rake from, to;
  double path() const { return (to.edge - from.edge).norm(); } ///< m
};

/// What a rake takes of a layer, (5).
struct Bite {
  double area = 0.0;             ///< m²
  double begin = 1.0, end = 0.0; ///< shares of the way of the edge between which something is cut
  double share() const { return begin < end ? end - begin : 0.0; }
};

class Region;

/// Matter of one layer of a box. Dexels lie along y beside each other and are divided into cells; a cell is
/// full, empty, or holds convex pieces.
class DexelLayer {
public:
  /// pitch: m, the most that cells measure along x and y.
  DexelLayer(const Vec2& low, const Vec2& high, const Vec2& pitch);
  /// Matter of convex quadrilaterals alone, counter-clockwise, that share no area.
  DexelLayer(const Vec2& low, const Vec2& high, const Vec2& pitch,
             const std::vector<std::array<Vec2, 4>>& pieces);
  /// One that was archived as a whole. Throws IoError for what is none.
  DexelLayer(Archive& archive, const std::string& path);

  /// What a rake would take.
  Bite ask(const Sweep& sweep) const;
  /// Takes it: afterwards the area is less by that of the bite.
  Bite erase(const Sweep& sweep);
  /// Takes away all within a polygon of as large an area as a disc, and within a rectangle. The area that
  /// was there, m².
  double erase_disc(const Vec2& centre, double radius);
  void erase_box(const Vec2& low, const Vec2& high);

  double area() const; ///< m² of matter

  /// What evolves, under a path of names that ends with "/". Throws IoError for what is no such layer.
  void archive(Archive& archive, const std::string& path);
  /// The same with the cells themselves.
  void archive_whole(Archive& archive, const std::string& path);
  const Vec2& low() const { return low_; } ///< m, corners of the box
  Vec2 high() const {
    return low_ + size_.cwiseProduct(Vec2(static_cast<double>(count_[0]), static_cast<double>(count_[1])));
  }
  /// Matter on the line along an axis that crosses the other one at a place, m, in order; none beside the
  /// box.
  std::vector<Interval> matter(int axis, double place) const;
  /// Matter on a line of a length, m, from a place along a unit vector: distances from there, m, in order.
  std::vector<Interval> matter(const Vec2& from, const Vec2& along, double length) const;

private:
  /// Pieces of a cell, one behind the other, with their numbers of corners.
  struct Pieces {
    std::vector<Vec2> corner; ///< m
    std::vector<std::int32_t> size;
    std::span<const Vec2> next(std::size_t piece, std::size_t& begin) const;
    void add(std::span<const Vec2> polygon);
  };
  static constexpr std::int32_t empty = -1, full = -2;

  bool misses(const Sweep& sweep) const; ///< for want of any matter where it is
  std::pair<std::size_t, std::size_t> range(int axis, double from, double to) const;
  template<class Visit> void meet(const Region& region, Visit&& visit) const;
  void erase(const Region& region, const Sweep* sweep, Bite& bite);
  std::array<Vec2, 4> square(std::size_t i, std::size_t j) const;
  std::size_t cell(std::size_t i, std::size_t j) const { return i * count_[1] + j; }

  Vec2 low_ = Vec2::Zero(), size_ = Vec2::Zero(); ///< m, of the box, of a cell
  std::array<std::size_t, 2> count_{};
  std::vector<std::int32_t> cell_; ///< [along x × along y] empty, full, or an index of cut_
  std::vector<Pieces> cut_;
  std::vector<std::int32_t> free_; ///< indices of cut_ that no cell has
};

} // namespace cnem::machining
