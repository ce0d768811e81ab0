#pragma once
// Unilateral contacts with friction between weighted nodes and planes of rigid tools or facets of other
// nodes, solved for impulses.
#include "contact/contact_groups.hpp"
#include "contact/contact_system.hpp"
#include "contact/reaction.hpp"

#include <span>
#include <vector>

namespace cnem::contact {

/// Finds the impulses of all contacts of a step. Keeps nothing but memory from one solution to the next.
///
/// Contacts that share no node (nor a free tool) do not feel each other. One that is alone has a closed
/// form. Several that feel each other are swept by projected Gauss-Seidel, which finds out who presses, slips
/// and sticks but converges slowly where contacts nearly coincide; a linear system for those found
/// (contact/contact_system.hpp) takes them to the solution, and one more sweep shows that it is one. Where it
/// is not, as between tools that leave a node no room, sweeps go on.
///
/// In space groups of bodies on bodies with a wide band (faces that lie on each other) are left to sweeps and
/// marked as such (Contact::swept).
template<int dim> class ImpulseSolver {
public:
  static constexpr double rest_of_swept = 1e-4; ///< of the depth: what these may still move by

  /// Solves in place: contacts get their impulses, nodes and tools their change of velocity, starting from
  /// what they have. Contacts that feel each other are done when a sweep moves none of them by more than
  /// `tolerance` (m) or 1e-9 of how deep the deepest was, at the latest after `sweeps`. Where many nodes
  /// press on one free tool, each sweep also moves the tool together with all of them, as Gauss-Seidel alone
  /// would need as many sweeps as the contacting nodes are heavier than the tool.
  /// known_depth (m): that of the deepest contact in earlier solutions of the same step, by which groups that
  /// are less deep are measured, too: what is left to a later solution may be as little as rounding. Returns
  /// the larger of it and the depth of the deepest contact (m), in the plane of those in groups alone.
  double solve(std::vector<Contact<dim>>& contacts, ReactionsOfNodes<dim>& nodes,
               ReactionsOfTools<dim>& tools, double dt, double tolerance, int sweeps,
               double known_depth = 0.0);

private:
  ContactGroups<dim> groups_;
  ContactSystem<dim> system_;
  std::vector<double> mobility_; ///< 1/kg, of the contacts of a group along their normals
  std::vector<double> sideways_; ///< 1/kg, along their surfaces where the group is swept; < 0: not known
};

extern template class ImpulseSolver<2>;
extern template class ImpulseSolver<3>;

} // namespace cnem::contact
