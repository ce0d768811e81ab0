#pragma once
// A tool in space bounded by triangles, as STL files hold it.
#include "contact/box_tree.hpp"
#include "contact/tool_shape.hpp"
#include "core/geometry/triangle_surface.hpp"

#include <vector>

namespace cnem::contact {

/// Closest points by a tree of boxes. What is nearest to an edge or a corner is inside where it lies behind
/// the sum of the normals there, weighted by the angles of the triangles (Bærentzen and Aanæs 2005). Edges
/// that turn by more than 5° are ridges, and points where three such meet are corners; finer ones are those
/// of a curved face in triangles.
class TriangleShape final : public ToolShape<3> {
public:
  /// Throws GeometryError, with triangles, where the surface is not closed or inside out (check_closed).
  explicit TriangleShape(TriangleSurface surface);

  SurfacePoint<3> closest(const Vec3& x) const override;
  void entries(std::span<const Vec3> from, std::span<const Vec3> to,
               std::vector<Entry<3>>& found) const override;
  const std::vector<Ridge<3>>& ridges() const override { return ridges_; }
  Box<3> bounds() const override { return bounds_; }
  double least_thickness() const override { return least_thickness_; }
  double thickness_along(const Vec3& direction) const override;
  double passed(const Vec3& from, const Vec3& to) const override;

private:
  struct Foot {
    Vec3 point{0, 0, 0};
    std::array<double, 3> weight{}; ///< of the corners; zeros where it is on an edge or a corner
  };
  Foot foot(std::size_t triangle, const Vec3& x) const;
  Vec3 normal_at(std::size_t triangle, const std::array<double, 3>& weight) const;
  void find_ridges();
  void find_thickness();

  TriangleSurface surface_;
  BoxTree tree_;
  std::vector<Vec3> normal_;                      ///< [triangle]
  std::vector<Vec3> at_point_;                    ///< [point] weighted by angles, unit
  std::vector<std::array<std::int32_t, 3>> next_; ///< [triangle][k] across the edge from its corner k on
  std::vector<Ridge<3>> ridges_;
  Box<3> bounds_;
  double tolerance_ = 0.0; ///< m, below it two lengths are one
  double least_thickness_ = 0.0;
};

} // namespace cnem::contact
