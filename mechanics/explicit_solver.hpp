#pragma once
// The coupled explicit solver: central differences with a variable step (paper 004, 5.1.4) and staggered
// heat.
#include "contact/contact.hpp"
#include "core/archive.hpp"
#include "core/discretisation.hpp"
#include "core/state.hpp"
#include "mechanics/bulk_viscosity.hpp"
#include "mechanics/energy_ledger.hpp"
#include "mechanics/loads.hpp"
#include "mechanics/mass_scaling.hpp"
#include "mechanics/pressure_exchange.hpp"
#include "mechanics/stabilisation.hpp"
#include "mechanics/stable_step.hpp"
#include "mechanics/supports.hpp"
#include "mechanics/ties.hpp"
#include "plasticity/material.hpp"
#include "thermal/boundaries.hpp"
#include "thermal/conduction.hpp"

#include <memory>
#include <string>
#include <vector>

namespace cnem {

/// What a run is made of and does not change while it runs.
template<int dim> struct Model {
  std::unique_ptr<Discretisation<dim>> method;
  Cloud<dim> cloud; ///< boundary; its positions follow the reference
  std::vector<plasticity::Material> materials;
  std::vector<std::int32_t> node_material; ///< [node] index into materials; empty: the first everywhere
  Field strength;                          ///< [node] – factor on the flow stress; empty: 1 everywhere
  Ties<dim> ties;                          ///< nodes that move as one
  Ties<dim> heat_ties;                     ///< nodes that have one temperature
  Supports<dim> supports;
  Loads<dim> loads;
  ThermalBoundaries<dim> heat_boundaries;
  contact::RigidContact<dim> contact{std::vector<contact::Tool<dim>>{}};
  double stabilisation = 0.05;    ///< α of the edge defect
  double pressure_exchange = 0.0; ///< α of the exchange of volume between flowing neighbours
  BulkViscosity viscosity;
  bool thermal = true;
  bool mechanical = true; ///< false: nothing moves, heat alone
  double safety = 0.9;    ///< factor on the stable step
  MassScaling mass_scaling;
};

/// Advances a State. One object per run.
template<int dim> class ExplicitSolver {
public:
  /// Starts from the cloud's positions with the given velocities [component][node] and temperatures [node].
  ExplicitSolver(Model<dim> model, Fields<dim> velocity, Field temperature);

  /// One step of the algorithm box of 5.1.4, from t_n to t_{n+1} = t_n + dt. Throws DivergenceError.
  void advance(double dt);

  /// Makes the present configuration the reference: cells and functions are rebuilt, b_e is pushed forward,
  /// nodes keep mass, velocity and temperature, and what this changes in energy is booked. Start-up comes
  /// through here too. Throws GeometryError, with everything left as it was, when the cloud has no valid
  /// structure.
  void prepare();

  /// Stable step for the present configuration with the safety factor, and what limits it.
  struct Step {
    double dt;         ///< s
    std::size_t point; ///< where
    std::string limit; ///< by what
  };
  Step stable_step();

  /// max over points of ‖F − 1‖ (Frobenius) since the last reference.
  double strain_since_reference() const;

  EnergyLedger ledger() const;

  /// Carries everything that evolves out or in, so that a solver of the same model goes on with the same
  /// bits. Throws IoError when what is carried in does not fit the model.
  void archive(Archive& archive);

  const State<dim>& state() const { return state_; }
  const Model<dim>& model() const { return model_; }
  const Approximation<dim>& approximation() const { return approximation_; }
  const Field& flow_stress() const { return flow_stress_; }
  /// What resists acceleration, kg/m^(3−dim), [node]: the mass, or more with mass scaling.
  const Field& inertia() const { return inertia_.empty() ? state_.node.mass : inertia_; }
  const Fields<dim>& initial_position() const { return initial_position_; }
  int references() const { return references_; }
  /// log of b_e's J over the geometric one by the pressure exchange, [node]; empty without.
  const Field& volume_drift() const { return exchange_.drift(); }
  /// Extremes over the run of r = ρ0 V/(m J) at nodes: how far geometric volume and carried mass have parted.
  std::array<double, 2> mass_balance() const;

private:
  void start_points();
  void place_reference();
  void scale_masses();
  const plasticity::Material& material_of(std::size_t point) const {
    return model_.materials[static_cast<std::size_t>(state_.point.material[point])];
  }
  const plasticity::Material& material_of_node(std::size_t node) const {
    return model_
        .materials[model_.node_material.empty() ? 0 : static_cast<std::size_t>(model_.node_material[node])];
  }
  void accelerate_and_move(double dt, double dt_mean);
  void correct_contact(double dt, double dt_mean);
  void strain_and_stress(double dt);
  void assemble_forces();
  void set_conduction();
  void reset_exchange();
  void conduct(double dt);
  void measure_conduction_step();
  /// Σ_p V_p s_p w_p: an energy per stress-free volume, J/m³, over the body, J/m^(3−dim).
  double energy_over_body(const Field& density) const;
  [[noreturn]] void diverged(std::size_t point, const std::string& field) const;

  Model<dim> model_;
  State<dim> state_;
  Approximation<dim> approximation_;
  EdgeDefect<dim> edge_defect_;
  PressureExchange<dim> exchange_;
  Conduction<dim> conduction_;
  SpectralBound<dim> bound_;

  Field mass_scale_, inertia_;         ///< [node] –, kg/m^(3−dim); empty without mass scaling
  Fields<dim> initial_position_;       ///< [node] m
  Field initial_temperature_;          ///< [node] K
  Fields<dim> velocity_before_;        ///< [node] v_{n−1/2} while v_{n+1/2} is made
  Field reference_, position_;         ///< [node] m, side by side
  ColumnStress<dim> stress_;           ///< P with viscosity and penalty: what forces are made from
  Field flow_stress_;                  ///< [point] σ_y where and when the point last flowed, Pa
  Field shear_modulus_, wave_modulus_; ///< [point] μ, λ + 2μ, Pa
  Field density_;                      ///< [point] ρ at F = 1, kg/m³
  Field jacobian_, viscous_pressure_;  ///< [point] of the last step, for the bulk viscosity
  Field heat_flow_;                    ///< [node] W/m^(3−dim)
  Field contact_heat_;                 ///< [node] J/m^(3−dim) friction heat of this step
  std::vector<ToolConductance> tool_conductance_;
  EnergyLedger running_;  ///< cumulative terms
  double tie_loss_ = 0.0; ///< J/m^(3−dim) of kinetic energy where contact struck tied nodes differently
  double plastic_offset_ = 0.0;  ///< keeps plastic work continuous over references
  double viscosity_ratio_ = 0.0; ///< largest share of critical damping by the bulk viscosity in the last step
  double conduction_step_ = 0.0; ///< s, stable for heat at the last reference
  int references_ = 0;
};

extern template class ExplicitSolver<2>;

} // namespace cnem
