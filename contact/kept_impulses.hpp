#pragma once
// What contacts bore in the last step, where sweeps of the next begin.
#include "contact/reaction.hpp"
#include "core/fields/archive.hpp"

#include <vector>

namespace cnem::contact {

/// Keeps what presses in groups that are left to sweeps (Contact::swept). On faces of bodies that lie on each
/// other several times as many pairs of nodes, facets and edges meet as bear; sweeps from nothing would take
/// thousands to find out which. Between two steps little changes: the next begins with the pairs that bore
/// and with their impulses, and the others at the same nodes wait until they are seen to overlap.
template<int dim> class KeptImpulses {
public:
  void clear();
  bool empty() const { return contacts_.empty(); }

  /// Takes those of a step with Δt̄ = dt_mean (s), which left overlaps of up to `left` (m).
  void keep(const std::vector<Contact<dim>>& contacts, double dt_mean, double left);

  /// The same contact, if it is kept, with forces (N/m^(3−dim)) in place of impulses; else null. O(log).
  const Contact<dim>* find(const Contact<dim>& contact) const;
  /// Whether contacts that are kept have all its nodes.
  bool covers(const Contact<dim>& contact) const;
  double left() const { return left_; } ///< m; 0 where none are kept

  void archive(Archive& archive);

private:
  void index();

  std::vector<Contact<dim>> contacts_; ///< sorted by what they are between
  IndexedVector<BoundaryNodeIndex, char> has_node_;
  double left_ = 0.0;
};

extern template class KeptImpulses<2>;
extern template class KeptImpulses<3>;

} // namespace cnem::contact
