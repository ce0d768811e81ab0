#pragma once
// The element-free Galerkin method behind the same contract as C-NEM.
#include "core/operators/discretisation.hpp"

namespace cnem::methods {

/// Rows are Gauss points with moving least squares (cnem/moving_least_squares.hpp), as paper 000 integrates,
/// (27)–(30), (54): N = φ(x_p), b = ∇φ(x_p), V_p the weight of the point. The background cells are the
/// constrained Delaunay triangles, with three inner points each, exact for quadratic functions; the paper's
/// are quadrilaterals with 2 × 2.
///
/// Linear fields are exact, so that forces −Gᵀ V P carry neither resultant nor, with symmetric Kirchhoff
/// stress, moment. Gauss points do not integrate the rational ∇φ exactly: constant stress loads inner nodes,
/// by 1% of stress times spacing in a square lattice and 20% where it is jittered by a fifth
/// (docs/methods.md). φ, and with it N, may be negative; the masses Σ V_p N_pJ may not. History is at points
/// that no cell moves with: references stay.
///
/// Each point has the third of its triangle that is nearest to its corner. No links, as Gauss points leave no
/// weak modes; heat conducts with the linear operators of the triangles.
class Efg final : public Discretisation<2> {
public:
  static constexpr Promises promised{Promise::interpolating_values, Promise::tiling_cells};

  /// `support`: of functions, in mean distances to Delaunay neighbours. Throws InputError when it is not in
  /// [1.5, 5].
  explicit Efg(double support = 2.5);

  /// Throws GeometryError as voronoi::triangulate, voronoi::linear_simplices and scni::MovingLeastSquares do,
  /// and with its position for a node without mass. Cost O(N log N).
  Approximation<2> rebuild(const Cloud<2>& cloud) override;
  std::string name() const override { return "efg"; }
  Promises promises() const override { return promised; }

private:
  double support_;
};

} // namespace cnem::methods
