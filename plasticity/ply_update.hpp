#pragma once
// Stresses of plies: hyperelastic in the strain since the stress-free state, with damage by modes, or with a
// plastic strain.
#include "plasticity/failure.hpp"
#include "plasticity/material.hpp"
#include "plasticity/stress_points.hpp"

namespace cnem::plasticity {

/// Nominal stress and energy of a ply with damage, in its axes.
struct PlyStress {
  double stress[3]; ///< Pa, σ11, σ22, σ12 conjugate to ε11, ε22, γ12
  double energy;    ///< J/m³
  PlyShares left;   ///< of the members that act
};

/// Π (1 − d) over the modes, at least 1e-6.
double shear_left(const double (&damage)[ply_modes]);

/// Of ε11, ε22, γ12 with the damage of all modes. The sign of each nominal stress chooses the mode that acts
/// on it: the complementary energy of the four sectors of sign is convex and continuous, so that one sector
/// fits and the stress is the derivative of an energy that has no jumps.
PlyStress damaged_stress(const PlyConstants& elastic, const double (&strain)[3],
                         const double (&damage)[ply_modes]);

/// update_stress (plasticity/return_map.hpp) of the points [begin, end) of a ply, in the plane: P of
/// F_total = F F₀ with F₀ = earlier_deformation, per stress-free volume (of the initial thickness in plane
/// stress). With a `failure` also its damage, with a hardening law its plastic strain in the axes of the ply,
/// of which T = Q : (½ ln C − E^p); dt in s; at 0 nothing grows.
/// Returns the first point with det F ≤ 0 or no number, which stays as it was, or −1.
std::ptrdiff_t update_plies(const Material& material, const StressPoints<2>& points, std::ptrdiff_t begin,
                            std::ptrdiff_t end, double dt);

/// Lets point p of a ply that flows, on a new reference, flow without work or strain that count until its
/// stress is within `factor` times the flow stress of its strain, rate and temperature.
void draw_back(const Material& material, const StressPoints<2>& points, std::ptrdiff_t p, double factor);

} // namespace cnem::plasticity
