#pragma once
// The coupled explicit solver: central differences with a variable step (paper 004, 5.1.4) and staggered
// heat.
#include "contact/contact.hpp"
#include "core/archive.hpp"
#include "core/discretisation.hpp"
#include "core/resampling.hpp"
#include "core/state.hpp"
#include "mechanics/energy_ledger.hpp"
#include "mechanics/local_steps.hpp"
#include "mechanics/mass_scaling.hpp"
#include "mechanics/stable_step.hpp"
#include "mechanics/supports.hpp"
#include "mechanics/terms/bulk_viscosity.hpp"
#include "mechanics/terms/edge_defect.hpp"
#include "mechanics/terms/loads.hpp"
#include "mechanics/terms/point_damage.hpp"
#include "mechanics/terms/pressure_exchange.hpp"
#include "mechanics/ties.hpp"
#include "plasticity/material.hpp"
#include "plasticity/stress_points.hpp"
#include "thermal/boundaries.hpp"
#include "thermal/conduction.hpp"

#include <memory>
#include <span>
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
  LocalStepControl local; ///< local time steps
  MassScaling mass_scaling;
};

/// Wall time spent in the parts of advance(), s.
struct StepTimes {
  double motion = 0.0, contact = 0.0, stress = 0.0, forces = 0.0, heat = 0.0;
};

/// Advances a State. One object per run.
template<int dim> class ExplicitSolver {
public:
  /// Starts from the cloud's positions with the given velocities [component][node] and temperatures [node].
  ExplicitSolver(Model<dim> model, Fields<dim> velocity, Field temperature);

  /// The algorithm box of 5.1.4 from t_n to t_{n+1} = t_n + dt, in `sub_steps()` finest steps. Throws
  /// DivergenceError.
  void advance(double dt);
  /// Finest steps in the next call of `advance`; 1 without local time steps.
  int sub_steps() const;
  /// Updates of nodes (and their stress points) in the last call of `advance`.
  double updates() const;
  const LocalSteps<dim>& local_steps() const { return local_; }

  /// Makes the present configuration the reference: cells and functions are rebuilt, b_e is pushed forward,
  /// nodes keep mass, velocity and temperature, and what this changes in energy is booked. Start-up comes
  /// through here too. Throws, with everything left as it was, GeometryError when the cloud has no valid
  /// structure, InputError at a renewal of a method that does not promise one point per node.
  void prepare();

  /// prepare() on a resampled cloud: nodes keep mass, momentum and heat in parcels, b_e is averaged as its
  /// logarithm, and the kinetic energy that averaging loses is booked. Throws as the other, with everything
  /// left as it was.
  void prepare(const Resampling<dim>& change);

  /// Stable step for the present configuration with the safety factor, and what limits it. With local time
  /// steps it chooses the levels of the next macro steps, and this is the stable macro step.
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

  /// The cloud with its nodes where they are now.
  Cloud<dim> present_cloud() const;
  const State<dim>& state() const { return state_; }
  const Model<dim>& model() const { return model_; }
  const Approximation<dim>& approximation() const { return approximation_; }
  const Field& flow_stress() const { return flow_stress_; }
  /// What resists acceleration, kg/m^(3−dim), [node]: the mass, or more with mass scaling.
  const Field& inertia() const { return inertia_.empty() ? state_.node.mass : inertia_; }
  const Fields<dim>& initial_position() const { return initial_position_; }
  int references() const { return references_; }
  int resamplings() const { return resamplings_; } ///< how many of them changed the nodes
  const StepTimes& times() const { return times_; }
  /// log of b_e's J over the geometric one by the pressure exchange, [node]; empty without.
  const Field& volume_drift() const { return exchange_.drift(); }
  /// Extremes over the run of r = ρ0 V/(m J) at nodes: how far geometric volume and carried mass have parted.
  std::array<double, 2> mass_balance() const;

private:
  void renew(Cloud<dim> cloud, const Resampling<dim>* change);
  void carry_over(const Resampling<dim>& change);
  Field held_tension();
  void mix_elastic(const Resampling<dim>& change, const Field& mass, const Field& tension);
  void resize_fields(std::size_t n);
  void resize_state(std::size_t n);
  void archive_cloud(Archive& archive);
  double kinetic_energy() const;
  void start_points();
  /// What the return map works on: damaged points flow at a lower stress.
  plasticity::StressPoints<dim> points_to_stress();
  void set_moduli();
  void place_reference();
  void scale_masses();
  const plasticity::Material& material_of(std::size_t point) const {
    return model_.materials[static_cast<std::size_t>(state_.point.material[point])];
  }
  const plasticity::Material& material_of_node(std::size_t node) const {
    return model_
        .materials[model_.node_material.empty() ? 0 : static_cast<std::size_t>(model_.node_material[node])];
  }
  /// Mean reactions of a macro step.
  class Reactions {
  public:
    Reactions(ExplicitSolver& solver, double duration, int count);
    void add(double dt_mean);
    void report();

  private:
    bool several() const;
    ExplicitSolver& solver_;
    double duration_;
    int count_;
    std::vector<Vec<dim>> mean_;
  };
  // The parts of a step, for what is due at an activity (mechanics/local_steps.hpp).
  void move(int activity, double dt, double dt_mean);
  void correct_contact(double dt, double dt_mean, std::span<const double> window);
  void collect_contact_heat();
  void update_stress(int activity, int before, double dt);
  void assemble_forces(int activity);
  // Levels of steps (mechanics/explicit_levels.cpp).
  void rebuild_levels();
  void set_levels(typename LocalSteps<dim>::Levels level);
  void change_levels(double finest);
  void restore_columns();
  double load_weight(std::size_t node) const;

  void set_conduction();
  void heat_plastically();
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
  PointDamage<dim> damage_;
  PressureExchange<dim> exchange_;
  Conduction<dim> conduction_;
  SpectralBound<dim> bound_;
  LocalSteps<dim> local_;
  typename LocalSteps<dim>::Levels next_levels_; ///< to be taken with the next step; empty: as they are
  double finest_before_ = 0.0;                   ///< s, the finest step that led to t_n
  bool on_new_reference_ = false;                ///< no step has been made on it
  std::vector<std::vector<double>> window_;      ///< [activity][boundary node], as contact takes it
  std::vector<double>
      start_load_weight_; ///< [block] in the first sub-step after a change of levels, else empty

  Field mass_scale_, inertia_;         ///< [node] –, kg/m^(3−dim); empty without mass scaling
  Fields<dim> initial_position_;       ///< [node] m
  Field initial_temperature_;          ///< [node] K
  Fields<dim> velocity_before_;        ///< [node] v_{n−1/2} while v_{n+1/2} is made
  Field reference_, position_;         ///< [node] m, side by side
  ColumnStress<dim> stress_;           ///< P with viscosity and penalty: what forces are made from
  Field flow_stress_;                  ///< [point] σ_y where and when the point last flowed, Pa
  Field shear_modulus_, wave_modulus_; ///< [point] μ, λ + 2μ (less where broken: PointDamage), Pa
  Field density_;                      ///< [point] ρ at F = 1, kg/m³
  Field jacobian_, viscous_pressure_;  ///< [point] of the last step, for the bulk viscosity
  Field heat_flow_;                    ///< [node] W/m^(3−dim)
  Field contact_heat_;                 ///< [node] J/m^(3−dim) friction heat of this step
  HeatContacts<dim> heat_contacts_;    ///< of this step
  EnergyLedger running_;               ///< cumulative terms
  double tie_loss_ = 0.0; ///< J/m^(3−dim) of kinetic energy where contact struck tied nodes differently
  double plastic_offset_ = 0.0;  ///< keeps plastic work continuous over references
  double viscosity_ratio_ = 0.0; ///< largest share of critical damping by the bulk viscosity in the last step
  double conduction_step_ = 0.0; ///< s, stable for heat at the last reference
  int references_ = 0;
  int resamplings_ = 0;
  StepTimes times_;
};

extern template class ExplicitSolver<2>;

} // namespace cnem
