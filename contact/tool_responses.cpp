// Tools that answer nodes inside them one by one, as contact/responses/list.hpp has it.
#include "contact/arc_offset.hpp"
#include "contact/contact_friction.hpp"
#include "contact/sweeper.hpp"
#include "core/index.hpp"

namespace cnem::contact {

/// Looks where nodes were at t_n, so that the force is that of a spring in an explicit step. Keeps the
/// contacts in `answered_`.
template<int dim> void RigidContact<dim>::respond(const Poses<dim>& poses, const ContactStep<dim>& step) {
  answered_.clear();
  for (const ToolIndex t : tools_.indices()) {
    const Tool<dim>& tool = tools_[t];
    if (tool.response.exact()) continue;
    inside_.clear(), from_.clear(), entries_.clear();
    for (const BoundaryNodeIndex b : near_.nodes(t)) {
      Vec<dim> place = start_[b] - poses[t].start;
      if (tool.equal_areas) place += arc_offset<dim>(surface_, *tool.shape, b, start_, poses[t].start);
      if (!tool.shape->bounds().contains(place)) continue;
      inside_.push_back(b);
      from_.push_back(place);
    }
    if (inside_.empty()) continue;
    tool.shape->entries(from_, from_, entries_);
    for (const Entry<dim>& entry : entries_) answer(inside_[index_of(entry.index)], t, entry.at, step);
  }
  for (const BoundaryNodeIndex b : taken_) end_[b] = reactions_[b].position + step.dt * reactions_[b].change;
}

template<int dim>
void RigidContact<dim>::answer(BoundaryNodeIndex node, ToolIndex t, const SurfacePoint<dim>& at,
                               const ContactStep<dim>& step) {
  Contact<dim> contact;
  contact.tool = t;
  contact.feature = at.feature;
  contact.node[0] = node;
  contact.weight[0] = 1.0;
  contact.normal = at.normal;
  set_friction(contact, step, [&] { return rubbing_area(node, step.window); });
  take(contact, step);
  Reaction<dim>& tool = tool_reactions_[t];
  const Reaction<dim>& own = reactions_[node];
  const Push<dim> push = tools_[t].response.push(
      Intrusion<dim>{.depth = -at.distance,
                     .dt = step.dt,
                     .dt_mean = step.dt_mean,
                     .normal = at.normal,
                     .tool = tool.velocity + tool.change,
                     .approach = tool.velocity + tool.change - own.velocity - own.change,
                     .mobility = own.inverse + tool.inverse});
  Sweeper<dim> sweeper(contact, reactions_, tool, step.dt);
  const double pressing = push.impulse.dot(at.normal);
  sweeper.set(pressing, push.impulse - pressing * at.normal);
  if (push.rubs) sweeper.rub();
  answered_.push_back(contact);
}

template void RigidContact<2>::respond(const Poses<2>&, const ContactStep<2>&);
template void RigidContact<2>::answer(BoundaryNodeIndex, ToolIndex, const SurfacePoint<2>&,
                                      const ContactStep<2>&);
template void RigidContact<3>::respond(const Poses<3>&, const ContactStep<3>&);
template void RigidContact<3>::answer(BoundaryNodeIndex, ToolIndex, const SurfacePoint<3>&,
                                      const ContactStep<3>&);

} // namespace cnem::contact
