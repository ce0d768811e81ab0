#include "contact/contact_system.hpp"

#include "contact/sweeper.hpp"
#include "core/index.hpp"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <utility>

namespace cnem::contact {
namespace {

constexpr int rounds = 12;               ///< of states; those that take more rarely settle at all
constexpr double compliance = 1e-12;     ///< of a contact, over its mobility
constexpr double linear = 1e-9;          ///< of its strength: what a contact that slips may be off by
constexpr double contradiction = 1e-6;   ///< of the depth: contacts that stay open by more are not solved
constexpr double most_thrown = 100.0;    ///< times the depth
constexpr std::size_t most_on_tool = 32; ///< contacts that a free tool couples all with all

/// dS/dp of Contact::strength at p ≥ 0.
double slope(const Contact<2>& contact, double p) {
  const double pull = contact.coulomb * p;
  if (contact.smooth) return std::isfinite(pull) ? contact.coulomb * std::exp(-pull / contact.limit) : 0.0;
  return pull < contact.limit ? contact.coulomb : 0.0;
}

} // namespace

bool ContactSystem::settle(std::vector<Contact<2>>& contacts, std::span<const std::int32_t> group,
                           ReactionsOfNodes<2>& nodes, ReactionsOfTools<2>& tools, double dt, double depth) {
  Reaction<2> none;
  const auto sweeper = [&](std::int32_t c) {
    Contact<2>& contact = contacts[index_of(c)];
    return Sweeper<2>(contact, nodes, exists(contact.tool) ? tools[contact.tool] : none, dt);
  };
  member_.clear();
  rubs_ = false;
  for (const std::int32_t c : group) {
    const Contact<2>& contact = contacts[index_of(c)];
    const Sweeper<2> one = sweeper(c);
    Member& member = member_.emplace_back();
    member.contact = c;
    member.axis = {contact.normal, left_normal(contact.normal)};
    member.given = {contact.pressing, contact.sliding.dot(member.axis[1])};
    member.velocity = member.before = {one.gap() / dt, one.slip().dot(member.axis[1])};
    member.mobility = {one.along(member.axis[0]), one.along(member.axis[1])};
    rubs_ = rubs_ || (contact.coulomb > 0.0 && contact.limit > 0.0) || member.given[1] != 0.0;
  }
  if (!couple(contacts, nodes, tools)) return false;
  number();
  fill();
  look(contacts);
  bool settled = false;
  for (int round = 0; round < rounds && !settled; ++round) {
    if (!solve(contacts)) return false;
    settled = !look(contacts);
  }
  if (!settled) return false;
  for (const Member& member : member_) {
    if (member.state == State::open) continue;
    if (!(std::abs(member.velocity[0]) * dt <= contradiction * depth)) return false;
    if (!(std::abs(member.change[0]) * member.mobility[0] * dt <= most_thrown * depth)) return false;
  }
  for (const Member& member : member_)
    sweeper(member.contact).set(std::max(0.0, member.impulse(0)), member.impulse(1) * member.axis[1]);
  return true;
}

/// Lists the links; false where a free tool makes too many.
bool ContactSystem::couple(const std::vector<Contact<2>>& contacts, const ReactionsOfNodes<2>& nodes,
                           const ReactionsOfTools<2>& tools) {
  end_.clear();
  for (std::size_t m = 0; m < member_.size(); ++m) {
    const Contact<2>& contact = contacts[index_of(member_[m].contact)];
    for (std::size_t a = 0; a < Contact<2>::slots; ++a)
      if (contact.weight[a] != 0.0)
        end_.push_back({mover(nodes, contact.node[a]), as<std::int32_t>(m), contact.weight[a]});
  }
  std::sort(end_.begin(), end_.end(), [](const End& a, const End& b) {
    return std::pair(a.node, a.member) < std::pair(b.node, b.member);
  });
  link_.clear();
  for (auto from = end_.begin(); from != end_.end();) {
    const auto to = std::find_if(from, end_.end(), [&](const End& end) { return end.node != from->node; });
    for (auto one = from; one != to; ++one)
      for (auto other = from; other != to; ++other)
        link_.push_back(
            {one->member, other->member, one->weight * other->weight * nodes[from->node].inverse});
    from = to;
  }
  for (const ToolIndex t : tools.indices()) {
    if (tools[t].inverse.isZero(0.0)) continue;
    queue_.clear();
    for (std::size_t m = 0; m < member_.size(); ++m)
      if (contacts[index_of(member_[m].contact)].tool == t) queue_.push_back(as<std::int32_t>(m));
    if (queue_.size() > most_on_tool) return false;
    for (const std::int32_t one : queue_)
      for (const std::int32_t other : queue_) link_.push_back({one, other, tools[t].inverse});
  }
  return true;
}

/// Numbers the members breadth first, from one that is far from the first.
void ContactSystem::number() {
  const std::size_t n = member_.size();
  std::sort(link_.begin(), link_.end(), [](const Link& a, const Link& b) {
    return std::pair(a.one, a.other) < std::pair(b.one, b.other);
  });
  std::int32_t start = 0;
  for (int search = 0; search < 2; ++search) {
    place_.assign(n, -1);
    queue_.assign(1, start);
    place_[index_of(start)] = 0;
    for (std::size_t q = 0; q < queue_.size(); ++q) {
      auto link = std::lower_bound(link_.begin(), link_.end(), queue_[q],
                                   [](const Link& a, std::int32_t m) { return a.one < m; });
      for (; link != link_.end() && link->one == queue_[q]; ++link) {
        if (place_[index_of(link->other)] >= 0) continue;
        place_[index_of(link->other)] = as<std::int32_t>(queue_.size());
        queue_.push_back(link->other);
      }
    }
    start = queue_.back();
  }
  assert(queue_.size() == n);
}

std::size_t ContactSystem::row(std::int32_t member, std::size_t k) const {
  return width() * index_of(place_[index_of(member)]) + k;
}

/// Such that [column] is an entry of the band.
double* ContactSystem::row_of(std::vector<double>& matrix, std::size_t row) const {
  return matrix.data() + row * 2 * band_ + band_;
}

/// The mobilities: velocities of all members per impulse of each.
void ContactSystem::fill() {
  std::int32_t apart = 0;
  for (const Link& link : link_)
    apart = std::max(apart, std::abs(place_[index_of(link.one)] - place_[index_of(link.other)]));
  band_ = width() * (index_of(apart) + 1) - 1;
  mobility_.assign(width() * member_.size() * (2 * band_ + 1), 0.0);
  for (const Link& link : link_)
    for (std::size_t k = 0; k < width(); ++k)
      for (std::size_t l = 0; l < width(); ++l)
        row_of(mobility_, row(link.one, k))[row(link.other, l)] +=
            member_[index_of(link.one)].axis[k].dot(link.inverse * member_[index_of(link.other)].axis[l]);
}

ContactSystem::State ContactSystem::state_of(const Contact<2>& contact, const Member& member) const {
  if (member.mobility[0] == 0.0) return State::open;
  const double pressing = member.impulse(0) - member.velocity[0] / member.mobility[0];
  if (pressing <= 0.0) return State::open;
  const double strength = contact.strength(pressing);
  if (!rubs_ || member.mobility[1] == 0.0 || strength <= 0.0) return State::pressing;
  const double sliding = member.impulse(1) - member.velocity[1] / member.mobility[1];
  if (std::abs(sliding) <= strength) return State::sticking;
  return sliding > 0.0 ? State::forwards : State::backwards;
}

/// Takes the states from the last solution; true when it is not yet one.
bool ContactSystem::look(const std::vector<Contact<2>>& contacts) {
  bool changed = false;
  for (Member& member : member_) {
    const Contact<2>& contact = contacts[index_of(member.contact)];
    const State state = state_of(contact, member);
    changed = changed || state != member.state;
    member.state = state;
    if (state != State::forwards && state != State::backwards) continue;
    const double strength = contact.strength(member.impulse(0));
    changed = changed || std::abs(std::abs(member.impulse(1)) - strength) > linear * strength;
  }
  return changed;
}

/// One equation for each impulse, from the states.
void ContactSystem::set_rows(const std::vector<Contact<2>>& contacts) {
  matrix_ = mobility_;
  right_.resize(width() * member_.size());
  for (std::size_t m = 0; m < member_.size(); ++m) {
    const Member& member = member_[m];
    const Contact<2>& contact = contacts[index_of(member.contact)];
    for (std::size_t k = 0; k < width(); ++k) {
      const std::size_t r = row(as<std::int32_t>(m), k);
      double* const entry = row_of(matrix_, r);
      if (member.state != State::open && (k == 0 || member.state == State::sticking)) { // comes to rest
        entry[r] *= 1.0 + compliance;
        right_[r] = -member.before[k];
        continue;
      }
      std::fill(entry + r - band_, entry + r + band_ + 1, 0.0);
      entry[r] = 1.0;
      right_[r] = -member.given[k];
      if (k == 1 && (member.state == State::forwards || member.state == State::backwards)) {
        const double sign = member.state == State::forwards ? 1.0 : -1.0;
        const double pressing = std::max(0.0, member.impulse(0)), rise = slope(contact, pressing);
        entry[r - 1] = -sign * rise;
        right_[r] += sign * (contact.strength(pressing) - rise * (pressing - member.given[0]));
      }
    }
  }
}

/// Gauss's, without pivots: rows that are not the identity have mobilities, which are definite.
bool ContactSystem::eliminate() {
  const std::size_t n = right_.size();
  for (std::size_t r = 0; r < n; ++r) {
    const double* const pivot = row_of(matrix_, r);
    if (pivot[r] == 0.0) return false;
    const std::size_t end = std::min(n, r + band_ + 1);
    for (std::size_t below = r + 1; below < end; ++below) {
      double* const entry = row_of(matrix_, below);
      if (entry[r] == 0.0) continue;
      const double factor = entry[r] / pivot[r];
      for (std::size_t c = r + 1; c < end; ++c) entry[c] -= factor * pivot[c];
      right_[below] -= factor * right_[r];
    }
  }
  for (std::size_t r = n; r-- > 0;) {
    const double* const entry = row_of(matrix_, r);
    for (std::size_t c = r + 1; c < std::min(n, r + band_ + 1); ++c) right_[r] -= entry[c] * right_[c];
    right_[r] /= entry[r];
  }
  return true;
}

bool ContactSystem::solve(const std::vector<Contact<2>>& contacts) {
  set_rows(contacts);
  if (!eliminate()) return false;
  const std::size_t n = right_.size();
  for (std::size_t m = 0; m < member_.size(); ++m)
    for (std::size_t k = 0; k < width(); ++k) {
      const std::size_t r = row(as<std::int32_t>(m), k);
      const double* const entry = row_of(mobility_, r);
      double sum = 0.0;
      for (std::size_t c = r - std::min(r, band_); c < std::min(n, r + band_ + 1); ++c)
        sum += entry[c] * right_[c];
      member_[m].change[k] = right_[r];
      member_[m].velocity[k] = member_[m].before[k] + sum;
    }
  return true;
}

} // namespace cnem::contact
