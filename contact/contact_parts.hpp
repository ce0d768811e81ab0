#pragma once
// What the parts of contact share.
#include "contact/reaction.hpp"
#include "core/fields/vector_at.hpp"

namespace cnem::contact {

template<int dim> Vec<dim> at(const Fields<dim>& field, NodeIndex node) {
  return vector_at<dim>(field, index_of(node));
}

/// Velocity of the point where a contact acts, from one vector per boundary node.
template<int dim, class PerNode> Vec<dim> at_contact(const Contact<dim>& contact, PerNode&& value) {
  Vec<dim> sum = Vec<dim>::Zero();
  for (std::size_t a = 0; a < Contact<dim>::slots; ++a)
    if (contact.weight[a] != 0.0) sum += contact.weight[a] * value(contact.node[a]);
  return sum;
}

} // namespace cnem::contact
