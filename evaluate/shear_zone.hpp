#pragma once
// An orthogonal cut in closed form: Oxley's parallel-sided shear zone.
#include "plasticity/material.hpp"

#include <optional>

namespace cnem::evaluate {

/// A sharp edge in plane strain.
struct ShearZoneCut {
  double feed = 0.0, speed = 0.0, rake = 0.0; ///< m, m/s, rad
  double friction = 0.0;                      ///< –, Coulomb's coefficient on the rake face
  double temperature = 293.15;                ///< K, of the workpiece
};

struct ShearZone {
  double Fc = 0.0, Ft = 0.0;                             ///< N/m: along the cut, into the workpiece
  double shear_angle = 0.0, chip_thickness = 0.0;        ///< rad, m
  double strain = 0.0, rate = 0.0, temperature = 293.15; ///< –, 1/s, K: equivalent ones in the shear plane
  double flow_stress = 0.0;                              ///< Pa, there
};

/// Oxley, The Mechanics of Machining (1989), with any flow law after Lalwani, Mehta and Jain, J. Mater.
/// Process. Technol. 209 (2009) 5305. In the shear plane at φ
///   γ = cos α/(2 sin φ cos(φ − α)), γ̇ = C0 Vs sin φ/f, C0 = 5.9, and γ/√3, γ̇/√3, σ/√3 = k,
///   T = T0 + (1 − b) χ k cos α/(ρ c sin φ cos(φ − α)), χ the share of the work that heats,
/// b = 0.5 − 0.35 lg(R tan φ), 0.3 − 0.15 lg(R tan φ) above 10, the share that goes into the workpiece,
/// within 0 and 1, R = ρ c V f/K (b = 0 without conduction). The angle θ of the force to the plane and the
/// friction angle λ = atan μ give φ:
///   tan θ = 1 + 2(π/4 − φ) − C0 n, n = (ε/σ) ∂σ/∂ε, θ = φ + λ − α.
/// Of several the largest one is taken, between 1° and that of a chip which does not flow; none where none
/// fits. Damage and the edge play no part.
std::optional<ShearZone> shear_zone(const plasticity::Material& material, const ShearZoneCut& cut);

} // namespace cnem::evaluate
