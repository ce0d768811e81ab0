#pragma once
// Where a point stands to a closed surface of triangles: how far away, and on which side.
#include "core/geometry/box_tree.hpp"
#include "core/geometry/triangle_foot.hpp"
#include "core/geometry/triangle_surface.hpp"

#include <array>
#include <limits>
#include <vector>

namespace cnem {

/// Closest points by a tree of boxes. What is nearest to an edge or a corner is inside where it lies behind
/// the sum of the normals there, weighted by the angles of the triangles (Bærentzen and Aanæs 2005).
class SurfaceDistance {
public:
  /// The surface is closed (check_closed). O(n log n).
  explicit SurfaceDistance(TriangleSurface surface);

  TriangleFoot foot(std::size_t triangle, const Vec3& x) const {
    return foot_on_triangle(surface_.corners(triangle), x);
  }

  struct Nearest {
    double distance = 0.0;      ///< m; negative inside
    Vec3 point{0, 0, 0};        ///< m
    Vec3 normal{0, 0, 0};       ///< –, unit, outwards: of the triangle, the edge or the corner
    std::int32_t triangle = -1; ///< the first of equally near ones; −1: none is nearer than the bound
  };
  /// O(log n).
  Nearest nearest(const Vec3& x, double bound = std::numeric_limits<double>::infinity()) const;

  const TriangleSurface& surface() const { return surface_; }
  const BoxTree& tree() const { return tree_; } ///< of the triangles
  const Box<3>& bounds() const { return bounds_; }
  std::size_t triangles() const { return normal_.size(); }
  const Vec3& normal(std::size_t triangle) const { return normal_[triangle]; } ///< –, unit, outwards
  /// The triangle across the edge from corner k to the next.
  std::size_t across(std::size_t triangle, std::size_t k) const {
    return static_cast<std::size_t>(across_[triangle][k]);
  }

private:
  Vec3 normal_at(std::size_t triangle, const std::array<double, 3>& weight) const;

  TriangleSurface surface_;
  BoxTree tree_;
  Box<3> bounds_;
  std::vector<Vec3> normal_;                        ///< [triangle]
  std::vector<Vec3> at_point_;                      ///< [point] weighted by angles, unit
  std::vector<std::array<std::int32_t, 3>> across_; ///< [triangle][k]
};

} // namespace cnem
