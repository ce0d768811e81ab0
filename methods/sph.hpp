#pragma once
// Total-Lagrangian corrected smoothed particle hydrodynamics behind the same contract as C-NEM.
#include "core/operators/discretisation.hpp"

namespace cnem::methods {

/// Radial functions of compact support in the plane, r = 2h at its end.
enum class Kernel {
  cubic_spline, ///< Monaghan, Lattanzio 1985: C², 10/(7π h²) at r = 0
  wendland_c2,  ///< Wendland 1995: C², positive Fourier transform, 7/(4π h²) at r = 0
};

/// dW/dr of a kernel of unit integral over the plane, 1/m³; 0 at r = 0 and for r >= support.
double kernel_slope(Kernel kernel, double r, double support);

/// Stress points are the nodes with their constrained Voronoi cells V_i, N is the identity, and the gradient
/// is the corrected one of a kernel around X_i (Bonet, Lok 1999, (35)–(37); Ganzenmüller 2015, (11)–(13)):
///
///   b_ij = V_j W'(r_ij)/r_ij K_i⁻¹ X_ij,  K_i = Σ_j V_j W'(r_ij)/r_ij X_ij ⊗ X_ij,  b_ii = −Σ_j b_ij,
///
/// X_ij = X_j − X_i. Linear fields are exact whatever the cloud, so that forces −Gᵀ V P carry neither
/// resultant nor, with symmetric Kirchhoff stress, moment; they are the usual −V_i V_j (P_i K_i⁻¹ + P_j
/// K_j⁻¹) ∇W of total-Lagrangian SPH. The transpose is not corrected: constant stress leaves inner forces
/// where K varies, in disordered clouds and within a support of the boundary. Kernels stay on the reference,
/// which frees them of the tensile instability.
///
/// Neighbours lie within the support and are reached along Delaunay edges on a path that is hardly longer
/// than the straight line: kernels do not reach across cracks and gaps. Links of the edge defect, which is
/// the hourglass control, are the Delaunay edges; heat conducts with the linear operators of the Delaunay
/// triangles.
class Sph final : public Discretisation<2> {
public:
  static constexpr Promises promised{Promise::identity_values, Promise::non_negative_values,
                                     Promise::tiling_cells};

  /// `smoothing`: support over the distance to natural neighbours, weighted with the facets between, at each
  /// node. Throws InputError when it is not in [1.5, 5].
  explicit Sph(Kernel kernel = Kernel::cubic_spline, double smoothing = 2.4);

  /// Throws GeometryError as voronoi::triangulate and voronoi::linear_simplices, and with the position of a
  /// node whose neighbours lie in one line. Cost O(N log N).
  Approximation<2> rebuild(const Cloud<2>& cloud) override;
  std::string name() const override;
  Promises promises() const override { return promised; }

private:
  Kernel kernel_;
  double smoothing_;
};

} // namespace cnem::methods
