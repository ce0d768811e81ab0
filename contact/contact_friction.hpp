#pragma once
// Friction of a contact, for the parts of contact that make them.
#include "contact/contact.hpp"
#include "contact/contact_parts.hpp"

#include <algorithm>
#include <array>
#include <cmath>

namespace cnem::contact {

/// Of the material of the node that bears the most.
template<int dim>
const Friction& RigidContact<dim>::friction_of(const Contact<dim>& contact,
                                               const ContactStep<dim>& step) const {
  if (!exists(contact.tool)) return law_.friction;
  const Tool<dim>& tool = tools_[contact.tool];
  if (tool.friction_by_material.empty()) return tool.friction;
  const auto most = std::max_element(contact.weight.begin(), contact.weight.end()) - contact.weight.begin();
  return tool.friction_by_material[index_of(step.material[contact.node[index_of(most)]])];
}

/// Takes the law as it is for the contact; `rubbing_area` is asked where the law needs it.
template<int dim>
template<class Area>
void RigidContact<dim>::set_friction(Contact<dim>& contact, const ContactStep<dim>& step,
                                     Area&& rubbing_area) const {
  const Friction& friction = friction_of(contact, step);
  const bool on_tool = exists(contact.tool);
  if (on_tool) contact.surface = tool_reactions_[contact.tool].velocity;
  Rubbing rubbing;
  const auto sides = [&](BoundaryValues values) { // mean of each: the node's, or edge's, and the facet's
    std::array<double, 2> mean{};
    for (std::size_t a = 0; a < Contact<dim>::slots; ++a)
      if (const double w = contact.weight[a]; w != 0.0)
        mean[w > 0.0 ? 0 : 1] += std::abs(w) * values[contact.node[a]];
    return mean;
  };
  if (friction.needs_flow_stress()) {
    const auto [one, other] = sides(step.flow_stress);
    rubbing.flow_stress = on_tool ? one : std::min(one, other);
  }
  if (friction.rubs() && !step.temperature.empty()) {
    const auto [one, other] = sides(step.temperature);
    rubbing.temperature = on_tool ? one : std::max(one, other);
  }
  if (friction.rubs() && !step.melting.empty()) {
    const auto [one, other] = sides(step.melting);
    rubbing.melting = on_tool ? one : std::min(one, other);
  }
  if (friction.needs_speed()) {
    const auto predicted = [&](BoundaryNodeIndex b) { return at<dim>(step.velocity, surface_.node[b]); };
    const Vec<dim> slip = at_contact(contact, predicted) - contact.surface;
    rubbing.speed = (slip - slip.dot(contact.normal) * contact.normal).norm();
  }
  const FrictionBound bound = friction.bound(rubbing);
  contact.coulomb = bound.coefficient;
  contact.smooth = bound.smooth;
  contact.limit = std::isinf(bound.shear) ? infinite : bound.shear * rubbing_area() * step.dt_mean;
}

} // namespace cnem::contact
