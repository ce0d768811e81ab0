#pragma once
// Linear finite elements behind the same contract as C-NEM, the method it is compared with: triangles in the
// plane, tetrahedra in space.
#include "core/geometry/revolution.hpp"
#include "core/operators/discretisation.hpp"
#include "voronoi/linear_simplices.hpp"

#include <vector>

namespace cnem::methods {

/// Simplices of constant strain. Stress points are the simplices (N = 1/(dim + 1) at each corner); there are
/// no stabilisation links, conduction uses the same operators.
template<int dim> class FeSimplices final : public Discretisation<dim> {
public:
  static constexpr Promises promised =
      dim == 2 ? Promises{Promise::carried_history,          Promise::interpolating_values,
                          Promise::non_negative_values,      Promise::tiling_cells,
                          Promise::balanced_constant_stress, Promise::hoop_rows}
               : Promises{Promise::interpolating_values, Promise::non_negative_values, Promise::tiling_cells,
                          Promise::balanced_constant_stress};

  /// On the constrained Delaunay triangulation of the cloud.
  explicit FeSimplices(Space space = Space::plane) requires(dim == 2) : space_(space) {}
  /// On these simplices, which tile the domain of every cloud it is given. Throws InputError for none.
  explicit FeSimplices(std::vector<voronoi::Simplex<dim>> simplices) requires(dim == 3);

  /// Throws GeometryError as voronoi::triangulate and voronoi::linear_simplices do, and with its position for
  /// a node that belongs to no simplex.
  Approximation<dim> rebuild(const Cloud<dim>& cloud) override;
  /// In the plane: by what new triangles cover of old ones (voronoi/plane/overlaps.hpp).
  std::optional<PointRows> point_parcels(const DiscreteOperators<dim>& old, const DiscreteOperators<dim>& now,
                                         const Cloud<dim>& cloud) const override;
  std::string name() const override { return dim == 2 ? "fe_triangle" : "fe_tetrahedron"; }
  Promises promises() const override { return promised; }

private:
  Space space_ = Space::plane;
  std::vector<voronoi::Simplex<dim>> simplices_; ///< in space; in the plane each cloud is triangulated
};

using FeTriangles = FeSimplices<2>;
using FeTetrahedra = FeSimplices<3>;

} // namespace cnem::methods
