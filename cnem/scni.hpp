#pragma once
// The constrained natural element method: smoothed gradients on constrained Voronoi cells by stabilised
// conforming nodal integration (paper 004, section 5.3 and (75)–(79)).
#include "cnem/quadrature.hpp"
#include "core/geometry/revolution.hpp"
#include "core/operators/discretisation.hpp"
#include "voronoi/plane/natural_neighbours.hpp"

#include <optional>
#include <string>

namespace cnem::scni {

using voronoi::Functions;

struct Options {
  Functions functions = Functions::sibson;
  /// Per Voronoi edge, 1 to 3; linear fields are exact with each. One point is the cheapest, two are the most
  /// accurate in elasticity (cases/verification/convergence).
  int gauss_points = 2;
  Space space = Space::plane; ///< of revolution at least 2 Gauss points are taken
  /// Moving least squares in the place of `functions`, with supports of so many spacings, 1.5 to 5
  /// (cnem/moving_least_squares.hpp).
  std::optional<double> support{};
};

/// Throws InputError unless there are 1, 2 or 3.
void check_gauss_points(int gauss_points);

/// The constrained Voronoi diagram of a cloud. Throws GeometryError as voronoi::triangulate does.
struct Diagram {
  voronoi::Triangulation triangulation;
  voronoi::Circumcircles circles;
  voronoi::Cells cells;

  explicit Diagram(const Cloud<2>& cloud);
};

/// Everything that nodal integration on the cells of a diagram makes of the means of functions on their inner
/// faces (face_means); of revolution also of functions at the centroids of cells.
Approximation<2> integrate_at_nodes(const Cloud<2>& cloud, const Diagram& diagram, FaceMeans means,
                                    Functions at_centroids, Space space);

/// C-NEM: rows are nodes with their constrained Voronoi cells, N is the identity, and
///   b_iJ = 1/V_i ∮ φ_J n dΓ
/// over the boundary of cell i. Every Voronoi edge is integrated once and serves its two cells with either
/// sign; on the boundary of the domain φ is linear between the ends of each facet and integrated exactly.
/// Of revolution integrals are weighted with the radius (core/operators/operators.hpp), and values at
/// centroids are those of natural neighbours with moving least squares too: none is negative. Links are the
/// Delaunay edges; heat conducts with the linear operators of the Delaunay triangles.
class Cnem final : public Discretisation<2> {
public:
  static constexpr Promises promised{Promise::identity_values, Promise::non_negative_values,
                                     Promise::tiling_cells, Promise::balanced_constant_stress,
                                     Promise::hoop_rows};

  /// Throws InputError when gauss_points is not 1, 2 or 3, or a support out of range.
  explicit Cnem(Options options = {});

  /// Throws GeometryError as voronoi::triangulate, voronoi::linear_simplices and face_means do. Cost O(N log
  /// N).
  Approximation<2> rebuild(const Cloud<2>& cloud) override;
  std::string name() const override;
  Promises promises() const override { return promised; }

private:
  Options options_;
};

} // namespace cnem::scni
