#pragma once
// One contact in a sweep of projected Gauss-Seidel: its gap, its slip, and the impulses that mend them.
#include "contact/impulse_solver.hpp"

#include <algorithm>
#include <cmath>

namespace cnem::contact {

template<int dim> class Sweeper {
public:
  Sweeper(Contact<dim>& contact, ReactionsOfNodes<dim>& nodes, Reaction<dim>& tool, double dt)
      : contact_(contact), nodes_(nodes), tool_(tool), dt_(dt) {}

  /// m, at the end of the step.
  double gap() const {
    double sum = -contact_.level - dt_ * contact_.normal.dot(tool_.change);
    each([&](double weight, const Reaction<dim>& node, const Vec<dim>& change) {
      sum += weight * contact_.normal.dot(node.position + dt_ * change);
    });
    return sum;
  }

  /// m/s, along the surface.
  Vec<dim> slip() const {
    Vec<dim> slip = -(contact_.surface + tool_.change);
    each([&](double weight, const Reaction<dim>& node, const Vec<dim>& change) {
      slip += weight * (node.velocity + change);
    });
    return slip - slip.dot(contact_.normal) * contact_.normal;
  }

  /// All return how far they moved the contact point, m. mobility: along the normal, the same in all sweeps.
  double press() { return press(along(contact_.normal)); }
  double press(double mobility) {
    if (mobility <= 0.0) return 0.0;
    return press_by(-gap() / (dt_ * mobility)) * dt_ * mobility;
  }

  /// mobility_of_all: along the surface, where it is the same in all directions; else < 0.
  double rub(double mobility_of_all = -1.0) {
    const double strength = contact_.strength();
    if (strength <= 0.0 && contact_.sliding.squaredNorm() == 0.0) return 0.0;
    const Vec<dim> slip = this->slip();
    const double speed = slip.norm();
    double mobility = mobility_of_all;
    if (mobility < 0.0) mobility = speed > 0.0 ? along(slip / speed) : 0.0;
    Vec<dim> wanted = contact_.sliding;
    if (mobility > 0.0) wanted -= slip / mobility;
    const double length = wanted.norm();
    if (length > strength) wanted *= strength / length;
    const Vec<dim> change = wanted - contact_.sliding;
    contact_.sliding = wanted;
    apply(change);
    return change.norm() * dt_ * mobility;
  }

  /// Adds to the normal impulse, which stays ≥ 0; returns the size of what was added.
  double press_by(double impulse) {
    const double before = contact_.pressing;
    contact_.pressing = std::max(0.0, before + impulse);
    apply((contact_.pressing - before) * contact_.normal);
    return std::abs(contact_.pressing - before);
  }

  /// Takes these impulses, whatever they were before.
  void set(double pressing, const Vec<dim>& sliding) {
    apply((pressing - contact_.pressing) * contact_.normal + sliding - contact_.sliding);
    contact_.pressing = pressing;
    contact_.sliding = sliding;
  }

  /// Velocity of the contact point of the nodes along u per unit impulse along u; 0 where they are held, also
  /// where u is off what holds them by less than 1e-3 rad: a face in a plane of symmetry that is flat but for
  /// rounding would throw nodes along it. Nor can what is tied to itself part: where the weights of tied
  /// nodes cancel, nothing moves.
  double node_mobility(const Vec<dim>& u) const {
    double sum = 0.0, free = 0.0;
    for (std::size_t a = 0; a < Contact<dim>::slots; ++a) {
      const double weight = contact_.weight[a];
      if (weight == 0.0) continue;
      const BoundaryNodeIndex moves = mover(nodes_, contact_.node[a]);
      double together = 0.0; // of all that an impulse on this one moves
      for (std::size_t b = 0; b < Contact<dim>::slots; ++b)
        if (contact_.weight[b] != 0.0 && mover(nodes_, contact_.node[b]) == moves)
          together += contact_.weight[b];
      const Mat<dim>& inverse = nodes_[contact_.node[a]].inverse;
      sum += weight * together * u.dot(inverse * u);
      free += weight * weight * inverse.trace();
    }
    return sum > 1e-6 * free ? sum : 0.0;
  }

  /// The same of nodes against tool.
  double along(const Vec<dim>& u) const {
    const double tool = u.dot(tool_.inverse * u);
    return node_mobility(u) + (tool > 1e-12 * tool_.inverse.trace() ? tool : 0.0);
  }

  /// Whether impulses along the normal cause no slip, nor those along the surface a gap.
  bool isotropic() const {
    bool all = tool_.inverse.isZero(0.0);
    each([&](double, const Reaction<dim>& node, const Vec<dim>&) {
      all = all && node.inverse == node.inverse(0, 0) * Mat<dim>::Identity();
    });
    return all;
  }

private:
  template<class Do> void each(Do&& act) const {
    for (std::size_t a = 0; a < Contact<dim>::slots; ++a)
      if (contact_.weight[a] != 0.0)
        act(contact_.weight[a], nodes_[contact_.node[a]], nodes_[mover(nodes_, contact_.node[a])].change);
  }

  void apply(const Vec<dim>& impulse) {
    each([&](double weight, const Reaction<dim>& node, Vec<dim>& change) {
      change += weight * (node.inverse * impulse);
    });
    tool_.change -= tool_.inverse * impulse;
  }

  Contact<dim>& contact_;
  ReactionsOfNodes<dim>& nodes_;
  Reaction<dim>& tool_;
  double dt_;
};

} // namespace cnem::contact
