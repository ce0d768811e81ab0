#pragma once
// Fields at a crack tip, in its frame: the branch functions of enrichment, and the displacement and stress of
// unit stress intensity (Williams 1957) that the interaction integral pairs with.
#include "core/vec.hpp"

#include <array>

namespace cnem::fracture {

/// Elastic constants of the plane problem.
struct PlaneElasticity {
  double mu = 0.0;        ///< Pa
  double kappa = 0.0;     ///< – Kolosov: 3 − 4ν in plane strain, (3 − ν)/(1 + ν) in plane stress
  double effective = 0.0; ///< Pa  E' = 8μ/(κ + 1)

  static PlaneElasticity plane_strain(double young, double poisson);
  static PlaneElasticity plane_stress(double young, double poisson);
};

/// √r sin(θ/2), √r cos(θ/2), √r sin(θ/2) sin θ, √r cos(θ/2) sin θ: they span the leading displacement of both
/// modes, which √r alone (paper 004, (74)) cannot.
inline constexpr std::size_t branch_count = 4;
std::array<double, branch_count> branch(double r, double theta);
/// Their gradients in the frame of the tip, 1/√m; r > 0.
std::array<Vec2, branch_count> branch_gradient(double r, double theta);

/// Displacement, its gradient and the stress for K_I = 1 (mode 0) or K_II = 1 (mode 1) Pa √m, in the frame.
struct TipField {
  Vec2 displacement{0, 0};      ///< m
  Mat2 gradient = Mat2::Zero(); ///< ∂u_i/∂x_j
  Mat2 stress = Mat2::Zero();   ///< Pa
};
TipField tip_field(int mode, const PlaneElasticity& elasticity, double r, double theta);

} // namespace cnem::fracture
