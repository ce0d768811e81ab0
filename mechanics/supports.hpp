#pragma once
// Prescribed motion of boundary nodes: symmetry planes, velocities, displacements.
#include "contact/contact.hpp"
#include "core/fields/archive.hpp"
#include "core/fields/state.hpp"
#include "core/operators/resampling.hpp"
#include "core/time_table.hpp"
#include "core/vec.hpp"
#include "mechanics/ties.hpp"

#include <cstdint>
#include <string>
#include <utility>
#include <vector>

namespace cnem {

/// One prescribed component of motion for a set of nodes.
template<int dim> struct Support {
  enum class Kind { symmetry, velocity, displacement };
  std::string name; ///< of the boundary condition, for messages and the history
  Kind kind = Kind::symmetry;
  Vec<dim> direction; ///< unit vector of the prescribed component
  TimeTable value;    ///< m/s or m along `direction`; unused for symmetry
  std::vector<NodeIndex> nodes;
  std::vector<PieceIndex> pieces{}; ///< boundary pieces whose nodes are all held, also new ones
};

/// All supports of a run, resolved into orthonormal prescribed directions for each node.
template<int dim> class Supports {
public:
  Supports() = default;

  /// A node may be held by several supports. Where two share a direction the first stands; a symmetry plane
  /// that is oblique to an earlier direction holds what is left free of it. Throws InputError when a *moving*
  /// support is oblique to another one of the same node.
  Supports(std::vector<Support<dim>> supports, std::size_t nodes);

  /// Others, with the work that has been done so far.
  void replace(std::vector<Support<dim>> supports, std::size_t nodes);

  /// Holds the nodes of a changed cloud, with those that are tied to them.
  void resample(const Resampling<dim>& change, const Ties<dim>& ties);

  /// Replaces the prescribed components of the velocity v_{n+1/2} by the mean velocity of the step [time,
  /// time + dt], so that positions follow the prescribed motion exactly. `before` is v_{n−1/2}, dt_mean =
  /// (Δt₁ + Δt₂)/2. Adds reactions and their work to the totals below.
  void apply(double time, double dt, double dt_mean, const Field& mass, const Fields<dim>& before,
             Fields<dim>& velocity);

  /// Held nodes with the projector on the directions they are free to move in.
  const std::vector<contact::NodeConstraint<dim>>& constraints() const { return constraints_; }

  /// A direction in which a node is held; those of one node are orthonormal.
  struct Prescribed {
    NodeIndex node;
    std::int32_t support; ///< index into list()
    Vec<dim> direction;
  };
  const std::vector<Prescribed>& prescribed() const { return prescribed_; }
  /// Displacement (m) along its direction that support s has prescribed since time 0.
  double displacement(std::int32_t s, double time) const;

  const std::vector<Support<dim>>& list() const { return support_; }
  /// Reaction of support s on the body in the last step, N/m^(3−dim).
  const std::vector<Vec<dim>>& reactions() const { return reaction_; }
  /// Reports these instead: means over several calls of `apply`.
  void report(std::vector<Vec<dim>> reactions) { reaction_ = std::move(reactions); }
  /// Work done by all supports since the start, J/m^(3−dim).
  double work() const { return work_; }

  /// Carries the lists of nodes of a resampled cloud out or in.
  void archive_nodes(Archive& archive, std::size_t nodes);
  /// Carries reactions and work out or in.
  void archive(Archive& archive);

private:
  void resolve(std::size_t nodes);

  std::vector<Support<dim>> support_;
  /// What holding a node in a direction takes in a step.
  struct Share {
    double force; ///< along the direction, N/m^(3−dim)
    double work;  ///< J/m^(3−dim)
  };

  std::vector<Prescribed> prescribed_;
  std::vector<Share> share_;            ///< [of prescribed] of a step, scratch
  std::vector<std::size_t> first_held_; ///< [constraint + 1] into prescribed
  std::vector<contact::NodeConstraint<dim>> constraints_;
  std::vector<Vec<dim>> reaction_;
  double work_ = 0.0;
};

extern template class Supports<2>;
extern template class Supports<3>;

} // namespace cnem
