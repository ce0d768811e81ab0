#pragma once
// Stabilised conforming nodal integration on median cells, with linear functions on tetrahedra: the node-based
// smoothed finite-element method (G.R. Liu, T. Nguyen-Thoi and others, Computers & Structures 87, 2009, 14).
#include "core/operators/discretisation.hpp"
#include "voronoi/linear_simplices.hpp"

#include <vector>

namespace cnem::scni {

/// Rows are nodes with their median cells (voronoi/space/median_cells.hpp), N is the identity, and by the
/// divergence theorem on them
///   V_i b_iJ = ¼ Σ_T V_T ∇N_J|_T over the tetrahedra T at node i, V_i = ¼ Σ_T V_T,
/// which area vectors alone give. Linear fields are exact whatever the shape of the tetrahedra. Links are the
/// edges; heat conducts with the linear operators of the tetrahedra.
class MedianCells final : public Discretisation<3> {
public:
  static constexpr Promises promised{Promise::identity_values, Promise::non_negative_values,
                                     Promise::tiling_cells, Promise::balanced_constant_stress};

  /// On these tetrahedra, which tile the domain of every cloud it is given. Throws InputError for none.
  explicit MedianCells(std::vector<voronoi::Simplex<3>> tetrahedra);

  /// Throws GeometryError as voronoi::linear_simplices does, and with its position for a node that belongs to
  /// no tetrahedron. O(N).
  Approximation<3> rebuild(const Cloud<3>& cloud) override;
  std::string name() const override { return "cnem_median"; }
  Promises promises() const override { return promised; }

private:
  std::vector<voronoi::Simplex<3>> tetrahedra_;
};

} // namespace cnem::scni
