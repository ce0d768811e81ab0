#pragma once
// What acts in a step: each term gives its stress or force, its share in the stable step, its energies to the
// ledger, and keeps its own state. The solver calls it once per range of points (mechanics/explicit_*.cpp).
#include "core/index.hpp"
#include "mechanics/energy_ledger.hpp"
#include "mechanics/kinematics.hpp"
#include "mechanics/local_steps.hpp"
#include "mechanics/model.hpp"
#include "mechanics/step_kernels.hpp"

#include <string>
#include <type_traits>
#include <vector>

namespace cnem {

/// The body as terms see it; `constant`: to look at alone.
template<int dim, bool constant> struct BodyOf {
  template<class T> using Seen = std::conditional_t<constant, const T, T>;

  const Model<dim>& model;
  Seen<Conditions<dim>>& conditions;
  Seen<State<dim>>& state;
  const Approximation<dim>& approximation;
  const LocalSteps<dim>& levels;
  const Field& reference;          ///< [node] m, side by side (core/operators/side_by_side.hpp)
  const Field& position;           ///< [node] m, side by side
  Seen<ColumnStress<dim>>& stress; ///< P with viscosity and penalty: what forces are made from
  Seen<EdgePoints>& edge;          ///< what the edge defect has renewed with each stress
  Seen<double>& plastic_offset; ///< J/m^(3−dim), keeps plastic work continuous as volumes are measured anew
  double half_step;             ///< s, half the finest step that led to t_n
  const std::vector<double>& start_weight; ///< [block] of loads after a change of levels, else empty

  operator BodyOf<dim, true>() const requires(!constant) {
    return {model,    conditions, state, approximation,  levels,    reference,
            position, stress,     edge,  plastic_offset, half_step, start_weight};
  }

  const DiscreteOperators<dim>& operators() const { return approximation.mechanics; }
  const plasticity::Material& material_of(std::size_t point) const {
    return model.materials[index_of(state.point.material[point])];
  }
  const plasticity::Material& material_of_node(NodeIndex node) const {
    return model.materials[index_of(state.node.material[index_of(node)])];
  }
  /// Finest steps over which the loads on a node act.
  double load_weight(std::size_t node) const {
    return start_weight.empty() ? levels.weight(node) : start_weight[node / LocalSteps<dim>::block];
  }
};
template<int dim> using Body = BodyOf<dim, false>;
template<int dim> using BodyView = BodyOf<dim, true>;

/// Σ_p V_p s_p w_p: an energy per stress-free volume, J/m³, over the body, J/m^(3−dim).
template<int dim> double integral(const BodyView<dim>& body, const Field& density);
/// Of v_n = v_{n−½} + ½ Δt f_n/m, to first order in Δt, J/m^(3−dim).
template<int dim> double kinetic_energy(const BodyView<dim>& body);

/// The points that are due.
struct DuePoints {
  const std::vector<LevelRange>& ranges;
  int activity; ///< mechanics/local_steps.hpp
  bool whole;   ///< all points of the body are due
  double dt;    ///< s, the finest step

  /// s, of a range.
  double own(const LevelRange& range) const { return dt * (1 << range.level); }
  std::size_t index(const LevelRange& range) const { return index_of(&range - ranges.data()); }
};

/// What limits the step beside the elastic waves of the cells.
struct StepLimit {
  double stabilisation = 0.0;    ///< α of the penalties: they raise the highest frequency by √(1 + α)
  double critical_damping = 0.0; ///< share ξ of it: the step shortens by √(1 + ξ²) − ξ
  double heat = 0.0;             ///< s, of heat where nothing moves
  double springs = 0.0;          ///< 1/s², of bonds: what they add to the squares of the body's frequencies
  double tools = infinite;       ///< s, of the finest step: of tools on springs
};

/// What terms have booked of a change of the reference, so that nobody books it again, J/m^(3−dim).
struct Booked {
  double elastic = 0.0, kinetic = 0.0; ///< of these energies, that is gone
};

/// Which value of a run its status keeps.
enum class Keep { last, largest };

/// A number that is told of the present state: a column of histories, and what the status keeps of it.
struct Metric {
  std::string name; ///< of the column, with its unit: "area[m^2]"; "": no column
  double value;
  std::string kept_as = {}; ///< in the status, with its unit; "": not kept
  Keep keep = Keep::last;
};

/// Nothing, but for what a term overrides. Hooks that get a range may write to its points and nodes alone;
/// sums over ranges are added up in their order, so that they do not depend on the threads.
template<int dim> class Term {
public:
  virtual ~Term() = default;

  /// Fields of its own; null: none. The solver sizes, carries and archives them.
  virtual FieldTable* fields() { return nullptr; }
  /// Its entries of the ledger; checkpoints hold them.
  virtual std::vector<Energy*> energies() { return {}; }
  /// Brings entries up to date that are of this instant.
  virtual void audit(const BodyView<dim>&) {}
  /// Its columns of histories.
  virtual std::vector<Metric> metrics(const BodyView<dim>&) const { return {}; }
  /// Its part in the limit of the step; it may change the wave moduli of points.
  virtual void limit(const Body<dim>&, StepLimit&) {}
  /// What it adds to StepLimit::critical_damping, as the last step has left it.
  virtual double critical_damping() const { return 0.0; }
  /// Adds rows of the stiffness of its bonds between nodes, [node] N/m^(3−dim) per m.
  virtual void stiffen(const Body<dim>&, Field&) {}
  /// Whatever else a checkpoint holds.
  virtual void archive(Archive&) {}

  // References
  /// Points are at rest, and fields have their size.
  virtual void start(const Body<dim>&) {}
  /// A rebuild needs memory: lets go of what `attach` makes again. Until then no other hook reads it.
  virtual void release() {}
  /// The old reference is about to be left.
  virtual void leave(const Body<dim>&) {}
  /// Matter comes and goes with a change of the cloud (Resampling::open); the fields are those before it.
  virtual void exchange(const Body<dim>&, const Resampling<dim>&, Booked&) {}
  /// Fields went over to the nodes of a resampled cloud.
  virtual void carried(const Body<dim>&) {}
  /// Stresses are those of a new reference, and nothing else has been made of them yet.
  virtual void stressed(const Body<dim>&, Booked&) {}
  /// Operators and stresses are those of a new reference.
  virtual void renew(const Body<dim>&) {}
  /// The same, or a checkpoint has been read, or there is no new reference after `release`.
  virtual void attach(const Body<dim>&) {}
  /// The levels of points are set.
  virtual void set_levels(const Body<dim>&) {}
  /// The new reference is complete with its forces.
  virtual void settle(const Body<dim>&, bool /*resampled*/, const Booked&) {}
  /// Stresses are about to be taken back to what they were before impulses were made of them.
  virtual void restore(const Body<dim>&) {}

  /// A macro step begins.
  virtual void begin_step(const Body<dim>&) {}

  // (i) motion in a finest step of dt; dt_mean is the time over which velocities changed, s
  /// Nodes have their new velocities.
  virtual void guide(const Body<dim>&, double /*dt*/, double /*dt_mean*/) {}
  /// Nodes are where these took them.
  virtual void correct(const Body<dim>&, int /*activity*/, double /*dt*/, double /*dt_mean*/) {}
  /// Motion is final.
  virtual void moved(const Body<dim>&, int /*activity*/, double /*dt_mean*/) {}

  // (ii) stresses at t_{n+1}
  virtual void begin_stress(const Body<dim>&, const DuePoints&) {}
  virtual void before_stress(const Body<dim>&, const LevelRange&) {}
  virtual void after_stress(const Body<dim>&, const DuePoints&, const LevelRange&) {}
  virtual void end_stress(const Body<dim>&, const DuePoints&) {}

  // (iii) forces at t_{n+1}
  virtual void begin_forces(const Body<dim>&, int /*activity*/) {}
  /// Adds to the forces of the nodes of a range of due points, and to their stresses.
  virtual void add_forces(const Body<dim>&, int /*activity*/, const LevelRange&) {}
  virtual void end_forces(const Body<dim>&, int /*activity*/) {}
  /// Adds to the forces of the nodes that are kicked, times the finest steps in their own.
  virtual void add_loads(const Body<dim>&, const LevelRange&) {}

  /// The macro step of dt (s) is made: what is staggered behind it.
  virtual void end_step(const Body<dim>&, double /*dt*/) {}
};

} // namespace cnem
