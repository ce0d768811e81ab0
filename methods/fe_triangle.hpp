#pragma once
// Linear finite-element triangles behind the same contract as C-NEM: the method it is compared with.
#include "core/discretisation.hpp"
#include "core/revolution.hpp"

namespace cnem::methods {

/// Constant-strain triangles on the constrained Delaunay triangulation of the cloud. Stress points are
/// triangles (V = area, N = 1/3 at each corner); there are no stabilisation links, conduction uses the same
/// operators.
class FeTriangles final : public Discretisation<2> {
public:
  static constexpr Promises promised{Promise::interpolating_values, Promise::non_negative_values,
                                     Promise::tiling_cells, Promise::balanced_constant_stress,
                                     Promise::hoop_rows};

  explicit FeTriangles(Space space = Space::plane) : space_(space) {}

  /// Throws GeometryError as voronoi::triangulate and voronoi::linear_triangles do.
  Approximation<2> rebuild(const Cloud<2>& cloud) override;
  std::string name() const override { return "fe_triangle"; }
  Promises promises() const override { return promised; }

private:
  Space space_;
};

} // namespace cnem::methods
