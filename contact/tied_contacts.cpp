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

/// Whether an impulse of the one moves everything as one of the other does, whatever the order of their
/// nodes: edges of two sides may run against each other, and in a pair with its image the sides are swapped.
template<int dim>
bool RigidContact<dim>::tied_alike(const Contact<dim>& one, const Contact<dim>& other) const {
  const double cosine = one.normal.dot(other.normal);
  if (one.tool != other.tool || std::abs(cosine) < 1.0 - alike) return false;
  const double side = cosine > 0.0 ? 1.0 : -1.0;
  const auto weight_on = [&](const Contact<dim>& contact, BoundaryNodeIndex group) {
    double sum = 0.0;
    for (std::size_t a = 0; a < Contact<dim>::slots; ++a)
      if (contact.weight[a] != 0.0 && first_of(contact.node[a]) == group) sum += contact.weight[a];
    return sum;
  };
  const auto all_alike = [&](const Contact<dim>& contact) {
    for (std::size_t a = 0; a < Contact<dim>::slots; ++a) {
      const BoundaryNodeIndex group = first_of(contact.node[a]);
      if (contact.weight[a] != 0.0 &&
          std::abs(weight_on(one, group) - side * weight_on(other, group)) > alike)
        return false;
    }
    return true;
  };
  if (!all_alike(one) || !all_alike(other)) return false;
  for (std::size_t a = 0; a < Contact<dim>::slots; ++a) {
    if (one.weight[a] == 0.0) continue;
    bool shared = false;
    for (std::size_t b = 0; b < Contact<dim>::slots; ++b)
      shared = shared || (other.weight[b] != 0.0 && other.node[b] == one.node[a]);
    if (!shared) return true; // it has a partner there
  }
  return false;
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

/// kg, by which a contact resists along any direction: 1/Σ w²/m of its nodes, were none of them tied.
template<int dim> double RigidContact<dim>::mass_of(const Contact<dim>& contact, const Field& mass) const {
  double inverse = 0.0;
  for (std::size_t a = 0; a < Contact<dim>::slots; ++a)
    if (const double w = contact.weight[a]; w != 0.0)
      inverse += w * w / mass[index_of(surface_.node[contact.node[a]])];
  return 1.0 / inverse;
}

/// Lets a contact bear for its twin as well: it presses by its mass, and what friction bears adds up, as far
/// as one law says it (where one has no bound in shear, both together have none). True when friction changes.
template<int dim>
bool RigidContact<dim>::join(Contact<dim>& bearing, const Contact<dim>& contact, std::size_t of,
                             std::vector<Twin>& twins, const Field& mass) const {
  double whole = mass_of(bearing, mass) + mass_of(contact, mass);
  for (const Twin& twin : twins)
    if (twin.of == of) whole += mass_of(twin.contact, mass);
  twins.push_back({contact, of});
  const double coulomb = bearing.coulomb, limit = bearing.limit;
  if (const double share = mass_of(contact, mass) / whole; contact.coulomb != coulomb) // both may be infinite
    bearing.coulomb = (1.0 - share) * coulomb + share * contact.coulomb;
  if (coulomb == 0.0) { // what slips freely, as where it melts, has no bound to add
    bearing.limit = contact.limit;
    bearing.smooth = contact.smooth;
  } else if (contact.coulomb > 0.0) {
    bearing.limit += contact.limit;
    bearing.smooth = bearing.smooth && contact.smooth; // a smooth law has a bound
  }
  return bearing.coulomb != coulomb || bearing.limit != limit;
}

/// Each of those that were solved for as one gets its share by its mass, and is listed.
template<int dim>
void RigidContact<dim>::share_out(std::vector<Contact<dim>>& contacts, std::vector<Twin>& twins,
                                  const Field& mass) const {
  std::vector<double> whole(twins.empty() ? 0 : contacts.size(), 0.0);
  for (const Twin& twin : twins) {
    if (whole[twin.of] == 0.0) whole[twin.of] = mass_of(contacts[twin.of], mass);
    whole[twin.of] += mass_of(twin.contact, mass);
  }
  for (Twin& twin : twins) {
    const Contact<dim>& of = contacts[twin.of];
    const double share = mass_of(twin.contact, mass) / whole[twin.of];
    twin.contact.pressing = share * of.pressing;
    // on sides that are swapped it acts against the other's
    twin.contact.sliding = std::copysign(share, of.normal.dot(twin.contact.normal)) * of.sliding;
  }
  for (std::size_t c = 0; c < whole.size(); ++c) {
    if (whole[c] == 0.0) continue;
    const double share = mass_of(contacts[c], mass) / whole[c];
    contacts[c].pressing *= share;
    contacts[c].sliding *= share;
  }
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
  template double RigidContact<dim>::mass_of(const Contact<dim>&, const Field&) const;                       \
  template bool RigidContact<dim>::join(Contact<dim>&, const Contact<dim>&, std::size_t, std::vector<Twin>&, \
                                        const Field&) const;                                                 \
  template void RigidContact<dim>::share_out(std::vector<Contact<dim>>&, std::vector<Twin>&, const Field&)   \
      const;
CNEM_INSTANTIATE(2)
CNEM_INSTANTIATE(3)
#undef CNEM_INSTANTIATE

} // namespace cnem::contact
