// Contact of nodes that are tied to each other: an impulse on one moves them all, and where all touch alike
// their contacts are one, which bears for all.
#include "contact/contact.hpp"
#include "contact/contact_parts.hpp"
#include "core/index.hpp"

#include <algorithm>
#include <cmath>

namespace cnem::contact {
namespace {

constexpr double alike = 1e-9; ///< of weights, and 1 less the cosine of normals, that are the same

} // namespace

/// Links the nodes of each group.
template<int dim> void RigidContact<dim>::set_tied(IndexedSpan<NodeIndex, const std::int32_t> group) {
  tied_.assign(surface_.node.size(), {BoundaryNodeIndex::none, BoundaryNodeIndex::none});
  if (group.empty()) return;
  std::vector<BoundaryNodeIndex> first, last; // [group]
  for (const BoundaryNodeIndex b : tied_.indices()) {
    const std::int32_t g = group[surface_.node[b]];
    if (g < 0) continue;
    if (index_of(g) >= first.size()) {
      first.resize(index_of(g) + 1, BoundaryNodeIndex::none);
      last.resize(index_of(g) + 1, BoundaryNodeIndex::none);
    }
    if (exists(last[index_of(g)]))
      tied_[last[index_of(g)]].next = b;
    else
      first[index_of(g)] = b;
    tied_[b].first = first[index_of(g)];
    last[index_of(g)] = b;
  }
}

/// Notes what the nodes of a contact answer to impulses.
template<int dim> void RigidContact<dim>::take(const Contact<dim>& contact, const ContactStep<dim>& step) {
  for (std::size_t a = 0; a < Contact<dim>::slots; ++a)
    if (contact.weight[a] != 0.0 && !is_taken_[contact.node[a]]) take(contact.node[a], step);
}

/// Of a node and all that are tied to it.
template<int dim> void RigidContact<dim>::take(BoundaryNodeIndex node, const ContactStep<dim>& step) {
  const BoundaryNodeIndex first = tied_[node].first;
  const auto each = [&](auto&& act) {
    if (!exists(first)) return act(node);
    for (BoundaryNodeIndex b = first; exists(b); b = tied_[b].next) act(b);
  };
  double mass = 0.0;
  each([&](BoundaryNodeIndex b) { mass += step.mass[index_of(surface_.node[b])]; });
  each([&](BoundaryNodeIndex b) {
    is_taken_[b] = 1;
    taken_.push_back(b);
    reactions_[b] = {.inverse = free_[b] / mass,
                     .position = end_[b],
                     .velocity = at<dim>(step.velocity, surface_.node[b]),
                     .change = Vec<dim>::Zero(),
                     .moves_with = first};
  });
}

/// m, of a contact with the impulses found so far.
template<int dim> double RigidContact<dim>::gap(const Contact<dim>& contact, double dt) const {
  const Vec<dim> x = at_contact(contact, [&](BoundaryNodeIndex b) { return end_[b]; });
  const double tool =
      exists(contact.tool) ? dt * contact.normal.dot(tool_reactions_[contact.tool].change) : 0.0;
  return contact.normal.dot(x) - contact.level - tool;
}

/// Whether an impulse of the one moves everything as one of the other does.
template<int dim>
bool RigidContact<dim>::tied_alike(const Contact<dim>& one, const Contact<dim>& other) const {
  if (one.tool != other.tool || one.normal.dot(other.normal) < 1.0 - alike) return false;
  bool partners = false;
  for (std::size_t a = 0; a < Contact<dim>::slots; ++a) {
    if (std::abs(one.weight[a] - other.weight[a]) > alike) return false;
    if (one.weight[a] == 0.0 || one.node[a] == other.node[a]) continue;
    const BoundaryNodeIndex first = tied_[one.node[a]].first;
    if (!exists(first) || tied_[other.node[a]].first != first) return false;
    partners = true;
  }
  return partners;
}

/// The contact of partners that bears what this one would.
template<int dim>
std::optional<std::size_t> RigidContact<dim>::twin_of(const Contact<dim>& contact,
                                                      const std::vector<Contact<dim>>& among) const {
  bool tied = false;
  for (std::size_t a = 0; a < Contact<dim>::slots; ++a)
    tied = tied || (contact.weight[a] != 0.0 && exists(tied_[contact.node[a]].first));
  if (!tied) return {};
  const auto found = std::find_if(among.begin(), among.end(),
                                  [&](const Contact<dim>& one) { return tied_alike(one, contact); });
  if (found == among.end()) return {};
  return index_of(found - among.begin());
}

/// Each of those that were solved for as one gets its share by the mass of its node, and is listed.
template<int dim>
void RigidContact<dim>::share_out(std::vector<Contact<dim>>& contacts, std::vector<Twin>& twins,
                                  const Field& mass, const Surface<dim>& surface) {
  if (twins.empty()) return;
  const auto own = [&](const Contact<dim>& c) { return mass[index_of(surface.node[c.node[0]])]; };
  std::vector<double> all;
  for (const Contact<dim>& contact : contacts) all.push_back(own(contact));
  for (const Twin& twin : twins) all[twin.of] += own(twin.contact);
  const auto take_share = [&](Contact<dim>& contact, const Contact<dim>& of, double whole) {
    const double share = own(contact) / whole;
    contact.pressing = share * of.pressing;
    contact.sliding = share * of.sliding;
  };
  for (Twin& twin : twins) take_share(twin.contact, contacts[twin.of], all[twin.of]);
  for (std::size_t c = 0; c < all.size(); ++c) take_share(contacts[c], contacts[c], all[c]);
  for (const Twin& twin : twins) contacts.push_back(twin.contact);
}

#define CNEM_INSTANTIATE(dim)                                                                                \
  template void RigidContact<dim>::set_tied(IndexedSpan<NodeIndex, const std::int32_t>);                     \
  template void RigidContact<dim>::take(const Contact<dim>&, const ContactStep<dim>&);                       \
  template void RigidContact<dim>::take(BoundaryNodeIndex, const ContactStep<dim>&);                         \
  template double RigidContact<dim>::gap(const Contact<dim>&, double) const;                                 \
  template bool RigidContact<dim>::tied_alike(const Contact<dim>&, const Contact<dim>&) const;               \
  template std::optional<std::size_t> RigidContact<dim>::twin_of(const Contact<dim>&,                        \
                                                                 const std::vector<Contact<dim>>&) const;    \
  template void RigidContact<dim>::share_out(std::vector<Contact<dim>>&, std::vector<Twin>&, const Field&,   \
                                             const Surface<dim>&);
CNEM_INSTANTIATE(2)
CNEM_INSTANTIATE(3)
#undef CNEM_INSTANTIATE

} // namespace cnem::contact
