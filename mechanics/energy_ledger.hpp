#pragma once
// Where the energy of a run is, term by term; what does not add up is reported as the residual.

namespace cnem {

/// All terms in J/m^(3−dim), at t_n, counted from the start of the run.
struct EnergyLedger {
  // held by the body
  double kinetic = 0.0;       ///< ½ m v_{n−½}² carried to t_n by the known forces
  double elastic = 0.0;       ///< stored, (31)
  double stabilisation = 0.0; ///< held by the edge-defect penalty
  double tool_kinetic = 0.0;  ///< of tools with a mass of their own
  // dissipated
  double plastic = 0.0;         ///< ∫ σ_eq dε̄p
  double damage = 0.0;          ///< elastic energy of tension let go by breaking points
  double viscosity = 0.0;       ///< bulk viscosity
  double friction = 0.0;        ///< sliding on tools
  double impact = 0.0;          ///< lost where nodes meet tools
  double penalty_release = 0.0; ///< let go by the penalty as moduli fall and at re-references
  double rereference =
      0.0; ///< stored energy lost (gained when negative) as stress-free volumes are re-measured
  double resampling = 0.0; ///< kinetic energy lost where matter of several nodes took one velocity and the
                           ///< forces of a changed cloud replaced those before
  double pressure_exchange = 0.0; ///< given up as flowing neighbours trade volume
  // received
  double tools = 0.0;    ///< work of the tools' forces along the tools' prescribed motion
  double drives = 0.0;   ///< work of the forces on tools with a mass of their own
  double supports = 0.0; ///< work of prescribed boundary motion
  double recovery = 0.0; ///< work of pushing nodes out of tools they were found in
  double loads = 0.0;    ///< work of tractions, pressures and body forces
  // heat: a balance of its own, fed by dissipation
  double heat_content = 0.0;   ///< Σ C (T − T_start)
  double heat_generated = 0.0; ///< from plastic work and friction
  double heat_exchanged = 0.0; ///< received through the boundary

  double inertial = 0.0; ///< Σ ½ m v_{n−½}² of the body: kinetic energy without what known forces add to it
  double initial = 0.0; ///< energy at the start of the run

  double external() const { return tools + drives + recovery + supports + loads; }
  double total() const {
    return kinetic + tool_kinetic + elastic + stabilisation + plastic + damage + viscosity + friction +
           impact + penalty_release + rereference + resampling + pressure_exchange;
  }
  /// Taken by the deformation of the body.
  double deformation() const { return elastic + stabilisation + plastic + penalty_release; }
  /// Kinetic energy over that of deformation: small in slow processes; 0 while nothing is deformed.
  double kinetic_share() const { return deformation() > 0.0 ? inertial / deformation() : 0.0; }
  /// What the scheme made or lost: zero up to the order of central differences.
  double residual() const { return total() - initial - external(); }
  double heat_residual() const { return heat_content - heat_generated - heat_exchanged; }
};

/// What an energy residual is compared with.
struct EnergyScale {
  double energy = 0.0;   ///< J/m, J of revolution; > 0
  const char* what = ""; ///< "the work done"
};

} // namespace cnem
