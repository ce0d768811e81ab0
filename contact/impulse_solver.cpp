#include "contact/impulse_solver.hpp"

#include "core/index.hpp"

#include <Eigen/LU>
#include <algorithm>
#include <cmath>

namespace cnem::contact {
namespace {

template<int dim> class Sweeper {
public:
  Sweeper(Contact<dim>& contact, ReactionsOfNodes<dim>& nodes, Reaction<dim>& tool, double dt)
      : contact_(contact), nodes_(nodes), tool_(tool), dt_(dt) {}

  double gap() {
    double sum = -contact_.level - dt_ * contact_.normal.dot(tool_.change);
    for (std::size_t a = 0; a < Contact<dim>::slots; ++a)
      if (contact_.weight[a] != 0.0) {
        const Reaction<dim>& node = at(a);
        sum += contact_.weight[a] * contact_.normal.dot(node.position + dt_ * node.change);
      }
    return sum;
  }

  /// Both return how far they moved the contact point, m.
  double press() {
    const double mobility = along(contact_.normal);
    if (mobility <= 0.0) return 0.0;
    return press_by(-gap() / (dt_ * mobility)) * dt_ * mobility;
  }

  double rub() {
    const double strength = contact_.strength();
    if (strength <= 0.0 && contact_.sliding.squaredNorm() == 0.0) return 0.0;
    Vec<dim> slip = -(contact_.surface + tool_.change);
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

  /// Adds to the normal impulse, which stays ≥ 0; returns the size of what was added.
  double press_by(double impulse) {
    const double before = contact_.pressing;
    contact_.pressing = std::max(0.0, before + impulse);
    apply((contact_.pressing - before) * contact_.normal);
    return std::abs(contact_.pressing - before);
  }

  /// Velocity of the contact point of the nodes along u per unit impulse along u; 0 where they are held.
  double node_mobility(const Vec<dim>& u) {
    double sum = 0.0, free = 0.0;
    for (std::size_t a = 0; a < Contact<dim>::slots; ++a) {
      const double w2 = contact_.weight[a] * contact_.weight[a];
      if (w2 == 0.0) continue;
      sum += w2 * u.dot(at(a).inverse * u);
      free += w2 * at(a).inverse.trace();
    }
    return sum > 1e-12 * free ? sum : 0.0;
  }

private:
  Reaction<dim>& at(std::size_t a) { return nodes_[contact_.node[a]]; }

  /// The same of nodes against tool.
  double along(const Vec<dim>& u) {
    const double tool = u.dot(tool_.inverse * u);
    return node_mobility(u) + (tool > 1e-12 * tool_.inverse.trace() ? tool : 0.0);
  }

  void apply(const Vec<dim>& impulse) {
    for (std::size_t a = 0; a < Contact<dim>::slots; ++a)
      if (contact_.weight[a] != 0.0) at(a).change += contact_.weight[a] * (at(a).inverse * impulse);
    tool_.change -= tool_.inverse * impulse;
  }

  Contact<dim>& contact_;
  ReactionsOfNodes<dim>& nodes_;
  Reaction<dim>& tool_;
  double dt_;
};

/// Moves a free tool together with all nodes that press on its faces so that their gaps close: exact when the
/// same nodes go on pressing without friction. Returns how far it moved anything, m.
template<int dim>
double shift_tool(std::vector<Contact<dim>>& contacts, ReactionsOfNodes<dim>& nodes, Reaction<dim>& tool,
                  ToolIndex index, double dt) {
  struct Pressing {
    Sweeper<dim> sweeper;
    Vec<dim> normal;
    double gap, mobility;
  };
  std::vector<Pressing> list;
  IndexedVector<BoundaryNodeIndex, char> taken(nodes.size(),
                                               0); // a node between two faces of the tool counts once
  Mat<dim> stiffness = Mat<dim>::Zero();
  Vec<dim> drive = Vec<dim>::Zero();
  for (Contact<dim>& contact : contacts) {
    if (contact.tool != index || contact.pressing <= 0.0 || exists(contact.facet)) continue;
    if (char& known = taken[contact.node[0]]; known)
      continue;
    else
      known = 1;
    Sweeper<dim> sweeper(contact, nodes, tool, dt);
    const double mobility = sweeper.node_mobility(contact.normal);
    if (mobility <= 0.0) return 0.0; // a held node stops the tool by itself
    const double gap = sweeper.gap();
    stiffness += contact.normal * contact.normal.transpose() / mobility;
    drive += gap / (dt * mobility) * contact.normal;
    list.push_back({sweeper, contact.normal, gap, mobility});
  }
  if (list.size() < 2) return 0.0;
  const Mat<dim> system = Mat<dim>::Identity() + tool.inverse * stiffness;
  const Vec<dim> change = system.inverse() * (tool.inverse * drive);
  double moved = 0.0;
  for (Pressing& pressing : list) {
    const double impulse = (pressing.normal.dot(change) - pressing.gap / dt) / pressing.mobility;
    moved = std::max(moved, pressing.sweeper.press_by(impulse) * dt * pressing.mobility);
  }
  return moved;
}

} // namespace

template<int dim> double Contact<dim>::strength() const {
  if (!(pressing > 0.0)) return 0.0;
  const double sliding_strength = coulomb * pressing;
  if (!smooth) return std::min(sliding_strength, limit);
  return limit > 0.0 ? -limit * std::expm1(-sliding_strength / limit) : 0.0;
}

namespace {

/// Which contacts need no more looking at: one that a sweep left as it was, to the bit, stays so until
/// another moves its nodes or its tool.
template<int dim> class Resting {
public:
  Resting(std::size_t contacts, std::size_t nodes, std::size_t tools)
      : node_moves_(nodes, 0), tool_moves_(tools, 0), at_rest_(contacts, -1) {}

  bool holds(std::size_t c, const Contact<dim>& contact) const { return at_rest_[c] == moves(contact); }
  void moved(const Contact<dim>& contact, const Reaction<dim>& tool) {
    for (std::size_t a = 0; a < Contact<dim>::slots; ++a)
      if (contact.weight[a] != 0.0) ++node_moves_[contact.node[a]];
    if (exists(contact.tool) && !tool.inverse.isZero(0.0)) ++tool_moves_[contact.tool];
  }
  void rested(std::size_t c, const Contact<dim>& contact) { at_rest_[c] = moves(contact); }
  void all_moved() { std::fill(at_rest_.begin(), at_rest_.end(), -1); }

private:
  std::int64_t moves(const Contact<dim>& contact) const {
    std::int64_t sum = exists(contact.tool) ? tool_moves_[contact.tool] : 0;
    for (std::size_t a = 0; a < Contact<dim>::slots; ++a)
      if (contact.weight[a] != 0.0) sum += node_moves_[contact.node[a]];
    return sum;
  }

  IndexedVector<BoundaryNodeIndex, std::int64_t> node_moves_;
  IndexedVector<ToolIndex, std::int64_t> tool_moves_;
  std::vector<std::int64_t> at_rest_; ///< [contact] moves until it was found at rest; −1: it was not
};

} // namespace

template<int dim>
void solve_impulses(std::vector<Contact<dim>>& contacts, ReactionsOfNodes<dim>& nodes,
                    ReactionsOfTools<dim>& tools, double dt, double tolerance, int sweeps) {
  Reaction<dim> none; // the tool of contacts between nodes alone: it takes no impulse
  Resting<dim> resting(contacts.size(), nodes.size(), tools.size());
  for (int sweep = 0; sweep < sweeps; ++sweep) {
    double moved = 0.0;
    for (std::size_t c = 0; c < contacts.size(); ++c) {
      Contact<dim>& contact = contacts[c];
      if (resting.holds(c, contact)) continue;
      Reaction<dim>& tool = exists(contact.tool) ? tools[contact.tool] : none;
      Sweeper<dim> sweeper(contact, nodes, tool, dt);
      const double pressing = contact.pressing;
      const Vec<dim> sliding = contact.sliding;
      moved = std::max(moved, sweeper.press());
      moved = std::max(moved, sweeper.rub());
      if (contact.pressing != pressing || contact.sliding != sliding)
        resting.moved(contact, tool);
      else
        resting.rested(c, contact);
    }
    for (const ToolIndex t : tools.indices())
      if (!tools[t].inverse.isZero(0.0)) {
        moved = std::max(moved, shift_tool(contacts, nodes, tools[t], t, dt));
        resting.all_moved();
      }
    if (moved <= tolerance) return;
  }
}

template double Contact<2>::strength() const;
template double Contact<3>::strength() const;
template void solve_impulses<2>(std::vector<Contact<2>>&, ReactionsOfNodes<2>&, ReactionsOfTools<2>&, double,
                                double, int);
template void solve_impulses<3>(std::vector<Contact<3>>&, ReactionsOfNodes<3>&, ReactionsOfTools<3>&, double,
                                double, int);

} // namespace cnem::contact
