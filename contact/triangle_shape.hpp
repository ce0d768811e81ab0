#pragma once
// A tool in space bounded by triangles, as STL files hold it.
#include "contact/tool_shape.hpp"
#include "core/geometry/surface_distance.hpp"

#include <vector>

namespace cnem::contact {

/// Closest points as SurfaceDistance finds them. Edges that turn by more than 5° are ridges, and points where
/// three such meet are corners; finer ones are those of a curved face in triangles.
class TriangleShape final : public ToolShape<3> {
public:
  /// Throws GeometryError, with triangles, where the surface is not closed or inside out (check_closed).
  explicit TriangleShape(TriangleSurface surface);

  SurfacePoint<3> closest(const Vec3& x) const override;
  void entries(std::span<const Vec3> from, std::span<const Vec3> to,
               std::vector<Entry<3>>& found) const override;
  const std::vector<Ridge<3>>& ridges() const override { return ridges_; }
  Box<3> bounds() const override { return distance_.bounds(); }
  double least_thickness() const override { return least_thickness_; }
  double thickness_along(const Vec3& direction) const override;
  double passed(const Vec3& from, const Vec3& to) const override;

private:
  void find_ridges();
  void find_thickness();

  SurfaceDistance distance_;
  std::vector<Ridge<3>> ridges_;
  double tolerance_ = 0.0; ///< m, below it two lengths are one
  double least_thickness_ = 0.0;
};

} // namespace cnem::contact
