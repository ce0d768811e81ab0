#pragma once
// Which contacts feel each other.
#include "contact/reaction.hpp"

#include <cstdint>
#include <span>
#include <vector>

namespace cnem::contact {

/// Divides contacts into groups that share neither a node that moves nor a free tool.
template<int dim> class ContactGroups {
public:
  /// Numbers of contacts: groups in the order of their first contact, members in increasing order. Costs
  /// O(contacts), and O(nodes) where there are more of them than ever before.
  void divide(const std::vector<Contact<dim>>& contacts, const ReactionsOfNodes<dim>& nodes,
              const ReactionsOfTools<dim>& tools);

  std::size_t size() const { return begin_.size() - 1; }
  std::span<const std::int32_t> operator[](std::size_t group) const {
    return {member_.data() + begin_[group], begin_[group + 1] - begin_[group]};
  }

private:
  std::int32_t root(std::int32_t contact);
  void join(std::int32_t& known, std::int32_t contact);

  std::vector<std::int32_t> parent_;                       ///< [contact] of a forest
  IndexedVector<BoundaryNodeIndex, std::int32_t> at_node_; ///< a contact at it; −1 between calls
  IndexedVector<ToolIndex, std::int32_t> at_tool_;
  std::vector<std::int32_t> number_; ///< [contact] of the group it is the root of
  std::vector<std::size_t> begin_;   ///< [group]
  std::vector<std::int32_t> member_;
};

extern template class ContactGroups<2>;
extern template class ContactGroups<3>;

} // namespace cnem::contact
