#pragma once
// The coupled explicit solver: central differences with a variable step (paper 004, 5.1.4) and staggered
// heat.
#include "core/fields/archive.hpp"
#include "core/fields/state.hpp"
#include "core/operators/resampling.hpp"
#include "mechanics/energy_ledger.hpp"
#include "mechanics/model.hpp"
#include "mechanics/stable_step.hpp"
#include "mechanics/terms/list.hpp"

#include <array>
#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace cnem {

/// Wall time spent in the parts of advance(), s.
struct StepTimes {
  double motion = 0.0, contact = 0.0, stress = 0.0, forces = 0.0, heat = 0.0;
};

/// Advances a State. One object per run. What acts in a step is a list of terms (mechanics/terms/list.hpp).
template<int dim> class ExplicitSolver {
public:
  /// Starts from the cloud's positions with the given velocities [component][node] and temperatures [node].
  ExplicitSolver(Problem<dim> problem, Fields<dim> velocity, Field temperature);

  /// The algorithm box of 5.1.4 from t_n to t_{n+1} = t_n + dt, in `sub_steps()` finest steps. Throws
  /// DivergenceError.
  void advance(double dt);
  /// Finest steps in the next call of `advance`; 1 without local time steps.
  int sub_steps() const;
  /// Updates of nodes (and their stress points) in the last call of `advance`.
  double updates() const { return local_.updates(); }
  const LocalSteps<dim>& local_steps() const { return local_; }

  /// Makes the present configuration the reference: cells and functions are rebuilt, b_e is pushed forward,
  /// nodes keep mass, velocity and temperature, new points take what those before them have undergone in
  /// parcels, and what this changes in energy is booked. Start-up comes through here too. Throws, with
  /// everything left as it was, GeometryError when the cloud has no valid structure, InputError at a renewal
  /// of a method that does not promise carried history.
  void prepare();

  /// prepare() on a resampled cloud: nodes keep mass, momentum and heat in parcels, b_e is averaged as its
  /// logarithm, and the kinetic energy that averaging loses is booked. Throws as the other, with everything
  /// left as it was, and InputError where nodes come or go with a method that does not promise one point per
  /// node.
  void prepare(const Resampling<dim>& change);

  /// Before a cloud is made of the present configuration of a body with cohesive interfaces: tells the bodies
  /// that it is of (Cloud::body), and sets faces that are pressed into each other apart; what they bear
  /// stays. Returns the name of an interface where that was not possible; empty: none.
  std::string part_faces() requires(dim == 2);

  /// Replaces the supports from the next step on; the work of those before stays in the ledger. For motion
  /// that differs from node to node, which a change of the cloud does not carry. Throws InputError as
  /// Supports.
  void hold(std::vector<Support<dim>> supports);

  /// Stable step for the present configuration with the safety factor, and what limits it. With local time
  /// steps it chooses the levels of the next macro steps, and this is the stable macro step.
  struct Step {
    double dt;         ///< s
    std::size_t point; ///< where, of elastic waves
    std::string limit; ///< by what
  };
  static constexpr const char* elastic_waves = "elastic waves"; ///< what limits at a point
  Step stable_step();
  /// –, ξ, the largest share of critical damping in the last step, by which the stable one is shorter.
  double critical_damping() const;
  /// Step that mass scaling asks for, s; 0: none. That of cells of width h is one of ω = c/h, the largest
  /// frequency of natural elements on a square lattice, c the speed of waves in the fastest material.
  double wanted_step() const;

  /// max over points of ‖F − 1‖ (Frobenius) since the last reference.
  double strain_since_reference() const;

  EnergyLedger ledger() const;
  /// N s/m^(3−dim), that inertia came with where the mass scaling of a changed cloud added it to moving
  /// nodes.
  const Vec<dim>& momentum_of_scaling() const { return scaling_momentum_; }
  /// What the terms tell of the present state.
  std::vector<Metric> metrics() const;

  /// Carries everything that evolves out or in, so that a solver of the same model goes on with the same
  /// bits. Throws IoError when what is carried in does not fit the model.
  void archive(Archive& archive);

  /// The cloud with its nodes where they are now.
  Cloud<dim> present_cloud() const;
  const State<dim>& state() const { return state_; }
  const Model<dim>& model() const { return model_; }
  const Conditions<dim>& conditions() const { return conditions_; }
  const Approximation<dim>& approximation() const { return *approximation_; }
  int references() const { return references_; }
  int resamplings() const { return resamplings_; } ///< how many of them changed the nodes
  const StepTimes& times() const { return times_; }
  /// r of a node: the matter in its cell, or its share of that in its points, over its mass; ρ0 V/(m J).
  double volume_ratio(std::size_t node) const;
  /// Extremes of r: how far geometric volume and carried mass have parted.
  std::array<double, 2> mass_balance() const;

private:
  // The parts of a step, for what is due at an activity (mechanics/local_steps.hpp).
  void move(int activity, double dt, double dt_mean);
  void update_stress(int activity, int before, double dt);
  void assemble_forces(int activity);
  void scale_to_impulses(const LevelRange& range);
  // Levels of steps.
  void rebuild_levels();
  void set_levels(typename LocalSteps<dim>::Levels level);
  void change_levels(double finest);
  void restore_columns();
  // References.
  void renew(Cloud<dim> cloud, const Resampling<dim>* change);
  void release();
  void regain();
  void share_velocities();
  void start_points();
  void start_flow_stress(std::size_t p);
  void set_moduli();
  void place_reference();
  void choose_mass_factors();
  void scale_masses();
  /// How points go over: their rows, and those of their labels.
  struct PointChange {
    PointRows parcels, labels;
  };
  std::optional<PointChange> change_of_points(const Resampling<dim>* change, const Cloud<dim>& cloud,
                                              const DiscreteOperators<dim>& now) const;
  double point_mass(std::size_t p) const;
  void carry_nodes(const Resampling<dim>& change);
  void rest_virgin(const Resampling<dim>& change);
  void carry_over(const Resampling<dim>* change, const std::optional<PointChange>& points,
                  const DiscreteOperators<dim>& now);
  // Checkpoints.
  void archive_cloud(Archive& archive);
  void archive_energies(Archive& archive);
  std::vector<FieldTable*> node_tables();
  std::vector<FieldTable*> point_tables();

  Body<dim> body();
  BodyView<dim> body() const;
  template<class Act> void each(Act&& act) const {
    for (const auto& term : terms_) act(*term);
  }
  [[noreturn]] void diverged(std::size_t point, const std::string& field) const;

  Model<dim> model_;
  Conditions<dim> conditions_;
  State<dim> state_;
  /// On the heap: terms keep its address, which a solver that is moved takes along.
  std::unique_ptr<Approximation<dim>> approximation_ = std::make_unique<Approximation<dim>>();
  std::vector<std::unique_ptr<Term<dim>>> terms_;
  SpectralBound<dim> bound_;

  LocalSteps<dim> local_;
  typename LocalSteps<dim>::Levels next_levels_; ///< to be taken with the next step; empty: as they are
  double finest_before_ = 0.0;                   ///< s, the finest step that led to t_n
  bool on_new_reference_ = false;                ///< no step has been made on it
  std::vector<double> start_weight_; ///< [block] of loads in the first sub-step after a change of levels

  Field reference_, position_; ///< [node] m, side by side
  ColumnStress<dim> stress_;   ///< P with viscosity and penalty: what forces are made from
  EdgePoints edge_{};
  double plastic_offset_ = 0.0; ///< J/m^(3−dim), keeps plastic work continuous over references
  double initial_energy_ = 0.0; ///< J/m^(3−dim)
  Vec<dim> scaling_momentum_ = Vec<dim>::Zero();
  int references_ = 0;
  int resamplings_ = 0;
  StepTimes times_;
};

extern template class ExplicitSolver<2>;
extern template class ExplicitSolver<3>;

} // namespace cnem
