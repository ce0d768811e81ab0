// Tools that answer nodes inside them one by one, as contact/responses/list.hpp has it.
#include "contact/arc_offset.hpp"
#include "contact/contact.hpp"
#include "contact/sweeper.hpp"
#include "core/index.hpp"

#include <algorithm>

namespace cnem::contact {

/// Looks where nodes were at t_n, so that the force is that of a spring in an explicit step. Keeps the
/// contacts in `answered_`.
template<int dim> void RigidContact<dim>::respond(const Poses<dim>& poses, const ContactStep<dim>& step) {
  answered_.clear();
  answered_twins_.clear();
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
    const std::size_t first = answered_.size();
    std::vector<double> depth;
    for (const Entry<dim>& entry : entries_) {
      const Contact<dim> contact = on_face(t, inside_[index_of(entry.index)], entry.at, step);
      if (const auto twin = twin_of(contact, answered_)) {
        join(answered_[*twin], contact, *twin, answered_twins_, step.mass);
        double& deepest = depth[*twin - first];
        deepest = std::max(deepest, -entry.at.distance);
        continue;
      }
      take(contact, step);
      answered_.push_back(contact);
      depth.push_back(-entry.at.distance);
    }
    for (std::size_t k = 0; k < depth.size(); ++k) answer(answered_[first + k], depth[k], step);
  }
  for (const BoundaryNodeIndex b : taken_) end_[b] = reactions_[b].position + step.dt * change(b);
}

template<int dim>
void RigidContact<dim>::answer(Contact<dim>& contact, double depth, const ContactStep<dim>& step) {
  const BoundaryNodeIndex node = contact.node[0];
  Reaction<dim>& tool = tool_reactions_[contact.tool];
  const Reaction<dim>& own = reactions_[node];
  const Push<dim> push = tools_[contact.tool].response.push(
      Intrusion<dim>{.depth = depth,
                     .dt = step.dt,
                     .dt_mean = step.dt_mean,
                     .normal = contact.normal,
                     .tool = tool.velocity + tool.change,
                     .approach = tool.velocity + tool.change - own.velocity - change(node),
                     .mobility = own.inverse + tool.inverse});
  Sweeper<dim> sweeper(contact, reactions_, tool, step.dt);
  const double pressing = push.impulse.dot(contact.normal);
  sweeper.set(pressing, push.impulse - pressing * contact.normal);
  if (push.rubs) sweeper.rub();
}

template void RigidContact<2>::respond(const Poses<2>&, const ContactStep<2>&);
template void RigidContact<2>::answer(Contact<2>&, double, const ContactStep<2>&);
template void RigidContact<3>::respond(const Poses<3>&, const ContactStep<3>&);
template void RigidContact<3>::answer(Contact<3>&, double, const ContactStep<3>&);

} // namespace cnem::contact
