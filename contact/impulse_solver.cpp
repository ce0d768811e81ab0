#include "contact/impulse_solver.hpp"

#include <algorithm>
#include <cmath>

namespace cnem::contact {
namespace {

template<int dim> class Sweeper {
public:
  Sweeper(Contact<dim>& contact, std::vector<Reaction<dim>>& nodes, double dt)
      : contact_(contact), nodes_(nodes), dt_(dt) {}

  /// Both return how far they moved the contact point, m.
  double press() {
    const double mobility = along(contact_.normal);
    if (mobility <= 0.0) return 0.0;
    double gap = -contact_.level;
    for (std::size_t a = 0; a < Contact<dim>::slots; ++a)
      if (contact_.weight[a] != 0.0) {
        const Reaction<dim>& node = at(a);
        gap += contact_.weight[a] * contact_.normal.dot(node.position + dt_ * node.change);
      }
    const double before = contact_.pressing;
    contact_.pressing = std::max(0.0, before - gap / (dt_ * mobility));
    const double change = contact_.pressing - before;
    apply(change * contact_.normal);
    return std::abs(change) * dt_ * mobility;
  }

  double rub() {
    const double strength =
        contact_.pressing > 0.0 ? std::min(contact_.coulomb * contact_.pressing, contact_.limit) : 0.0;
    if (strength <= 0.0 && contact_.sliding.squaredNorm() == 0.0) return 0.0;
    Vec<dim> slip = -contact_.surface;
    for (std::size_t a = 0; a < Contact<dim>::slots; ++a)
      if (contact_.weight[a] != 0.0) slip += contact_.weight[a] * (at(a).velocity + at(a).change);
    slip -= slip.dot(contact_.normal) * contact_.normal;
    const double speed = slip.norm();
    const double mobility = speed > 0.0 ? along(slip / speed) : 0.0;
    Vec<dim> wanted = contact_.sliding;
    if (mobility > 0.0) wanted -= slip / mobility;
    const double length = wanted.norm();
    if (length > strength) wanted *= strength / length;
    const Vec<dim> change = wanted - contact_.sliding;
    contact_.sliding = wanted;
    apply(change);
    return change.norm() * dt_ * mobility;
  }

private:
  Reaction<dim>& at(std::size_t a) { return nodes_[static_cast<std::size_t>(contact_.node[a])]; }

  /// Velocity of the contact point along u per unit impulse along u; 0 where the nodes are held.
  double along(const Vec<dim>& u) {
    double sum = 0.0, free = 0.0;
    for (std::size_t a = 0; a < Contact<dim>::slots; ++a) {
      const double w2 = contact_.weight[a] * contact_.weight[a];
      if (w2 == 0.0) continue;
      sum += w2 * u.dot(at(a).inverse * u);
      free += w2 * at(a).inverse.trace();
    }
    return sum > 1e-12 * free ? sum : 0.0;
  }

  void apply(const Vec<dim>& impulse) {
    for (std::size_t a = 0; a < Contact<dim>::slots; ++a)
      if (contact_.weight[a] != 0.0) at(a).change += contact_.weight[a] * (at(a).inverse * impulse);
  }

  Contact<dim>& contact_;
  std::vector<Reaction<dim>>& nodes_;
  double dt_;
};

} // namespace

template<int dim>
void solve_impulses(std::vector<Contact<dim>>& contacts, std::vector<Reaction<dim>>& nodes, double dt,
                    double tolerance, int sweeps) {
  for (int sweep = 0; sweep < sweeps; ++sweep) {
    double moved = 0.0;
    for (Contact<dim>& contact : contacts) {
      Sweeper<dim> sweeper(contact, nodes, dt);
      moved = std::max(moved, sweeper.press());
      moved = std::max(moved, sweeper.rub());
    }
    if (moved <= tolerance) return;
  }
}

template void solve_impulses<2>(std::vector<Contact<2>>&, std::vector<Reaction<2>>&, double, double, int);

} // namespace cnem::contact
