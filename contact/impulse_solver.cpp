#include "contact/impulse_solver.hpp"

#include "contact/sweeper.hpp"
#include "core/index.hpp"

#include <Eigen/LU>
#include <algorithm>
#include <cmath>

namespace cnem::contact {
namespace {

constexpr double relative = 1e-9; ///< of the depth: what solved contacts may still move by
constexpr int sweeps_before = 2;  ///< the first system; before the next one three times as many, and so on

/// Moves a free tool together with all nodes that press on its faces so that their gaps close: exact when the
/// same nodes go on pressing without friction. Returns how far it moved anything, m.
template<int dim>
double shift_tool(std::vector<Contact<dim>>& contacts, std::span<const std::int32_t> group,
                  ReactionsOfNodes<dim>& nodes, Reaction<dim>& tool, ToolIndex index, double dt) {
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
  for (const std::int32_t c : group) {
    Contact<dim>& contact = contacts[index_of(c)];
    if (contact.tool != index || contact.pressing <= 0.0 || exists(contact.facet)) continue;
    if (char& known = taken[mover(nodes, contact.node[0])]; known)
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

/// Marks a group in space where bodies touch bodies; false where it is none.
template<int dim>
bool leave_to_sweeps(std::vector<Contact<dim>>& contacts, std::span<const std::int32_t> group) {
  const auto between_bodies = [&](std::int32_t c) { return !exists(contacts[index_of(c)].tool); };
  if (dim == 2 || std::none_of(group.begin(), group.end(), between_bodies)) return false;
  for (const std::int32_t c : group) contacts[index_of(c)].swept = true;
  return true;
}

} // namespace

template<int dim> double Contact<dim>::strength(double at) const {
  if (!(at > 0.0)) return 0.0;
  const double sliding_strength = coulomb * at;
  if (!smooth) return std::min(sliding_strength, limit);
  return limit > 0.0 ? -limit * std::expm1(-sliding_strength / limit) : 0.0;
}

template<int dim>
double ImpulseSolver<dim>::solve(std::vector<Contact<dim>>& contacts, ReactionsOfNodes<dim>& nodes,
                                 ReactionsOfTools<dim>& tools, double dt, double tolerance, int sweeps,
                                 double known_depth) {
  double deepest = known_depth;
  groups_.divide(contacts, nodes, tools);
  Reaction<dim> none; // the tool of contacts between nodes alone: it takes no impulse
  const auto sweeper = [&](std::int32_t c) {
    Contact<dim>& contact = contacts[index_of(c)];
    return Sweeper<dim>(contact, nodes, exists(contact.tool) ? tools[contact.tool] : none, dt);
  };
  for (std::size_t g = 0; g < groups_.size(); ++g) {
    const std::span<const std::int32_t> group = groups_[g];
    if (Sweeper<dim> only = sweeper(group[0]); group.size() == 1 && only.isotropic()) {
      if constexpr (dim == 3) deepest = std::max(deepest, -only.gap());
      only.press();
      only.rub();
      continue;
    }
    double depth = 0.0;
    mobility_.clear();
    for (const std::int32_t c : group) {
      depth = std::max(depth, -sweeper(c).gap());
      mobility_.push_back(sweeper(c).along(contacts[index_of(c)].normal));
    }
    sideways_.assign(group.size(), -1.0);
    deepest = std::max(deepest, depth);
    const double measure = std::max(depth, known_depth);
    double least = std::max(tolerance, relative * measure);
    int next = sweeps_before;
    for (int sweep = 1; sweep <= sweeps; ++sweep) {
      double moved = 0.0;
      for (std::size_t i = 0; i < group.size(); ++i) {
        Sweeper<dim> one = sweeper(group[i]);
        moved = std::max(moved, one.press(mobility_[i]));
        moved = std::max(moved, one.rub(sideways_[i]));
      }
      for (const ToolIndex t : tools.indices())
        if (!tools[t].inverse.isZero(0.0))
          moved = std::max(moved, shift_tool(contacts, group, nodes, tools[t], t, dt));
      if (moved <= least) break;
      if (sweep == next) {
        const auto outcome = system_.settle(contacts, group, nodes, tools, dt, depth, measure);
        next = outcome == ContactSystem<dim>::Outcome::costly ? 0 : 3 * next;
        if (next == 0 && leave_to_sweeps(contacts, group)) {
          least = std::max(least, rest_of_swept * measure);
          for (std::size_t i = 0; i < group.size(); ++i)
            if (sweeper(group[i]).isotropic()) sideways_[i] = mobility_[i];
        }
      }
    }
  }
  return deepest;
}

template struct Contact<2>;
template struct Contact<3>;
template class ImpulseSolver<2>;
template class ImpulseSolver<3>;

} // namespace cnem::contact
