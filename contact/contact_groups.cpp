#include "contact/contact_groups.hpp"

#include "core/index.hpp"

#include <numeric>

namespace cnem::contact {

template<int dim> std::int32_t ContactGroups<dim>::root(std::int32_t contact) {
  while (parent_[index_of(contact)] != contact)
    contact = parent_[index_of(contact)] = parent_[index_of(parent_[index_of(contact)])];
  return contact;
}

/// The root of a group is its first contact.
template<int dim> void ContactGroups<dim>::join(std::int32_t& known, std::int32_t contact) {
  if (known < 0) {
    known = contact;
    return;
  }
  const std::int32_t a = root(known), b = root(contact);
  parent_[index_of(std::max(a, b))] = std::min(a, b);
}

template<int dim>
void ContactGroups<dim>::divide(const std::vector<Contact<dim>>& contacts, const ReactionsOfNodes<dim>& nodes,
                                const ReactionsOfTools<dim>& tools) {
  if (at_node_.size() < nodes.size()) at_node_.resize(nodes.size(), -1);
  at_tool_.assign(tools.size(), -1);
  parent_.resize(contacts.size());
  std::iota(parent_.begin(), parent_.end(), 0);
  const auto each_node = [&](const Contact<dim>& contact, auto&& act) {
    for (std::size_t a = 0; a < Contact<dim>::slots; ++a)
      if (contact.weight[a] != 0.0) act(mover(nodes, contact.node[a]));
  };
  for (std::size_t c = 0; c < contacts.size(); ++c) {
    const Contact<dim>& contact = contacts[c];
    each_node(contact, [&](BoundaryNodeIndex b) {
      if (!nodes[b].inverse.isZero(0.0)) join(at_node_[b], as<std::int32_t>(c));
    });
    if (exists(contact.tool) && !tools[contact.tool].inverse.isZero(0.0))
      join(at_tool_[contact.tool], as<std::int32_t>(c));
  }
  number_.resize(contacts.size());
  begin_.assign(1, 0);
  for (std::size_t c = 0; c < contacts.size(); ++c) {
    const std::int32_t first = root(as<std::int32_t>(c));
    if (index_of(first) == c) {
      number_[c] = as<std::int32_t>(begin_.size() - 1);
      begin_.push_back(0);
    }
    ++begin_[index_of(number_[index_of(first)]) + 1];
  }
  std::partial_sum(begin_.begin(), begin_.end(), begin_.begin());
  member_.resize(contacts.size());
  for (std::size_t c = contacts.size(); c-- > 0;) {
    // from the back, so that begin_ of the next group runs down to its own
    const auto group = index_of(number_[index_of(root(as<std::int32_t>(c)))]);
    member_[--begin_[group + 1]] = as<std::int32_t>(c);
  }
  begin_.erase(begin_.begin());
  begin_.push_back(contacts.size());
  for (const Contact<dim>& contact : contacts)
    each_node(contact, [&](BoundaryNodeIndex b) { at_node_[b] = -1; });
}

template class ContactGroups<2>;
template class ContactGroups<3>;

} // namespace cnem::contact
