#include "contact/contact_system.hpp"

#include "contact/sweeper.hpp"
#include "core/index.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <cassert>
#include <cmath>
#include <numeric>
#include <utility>

namespace cnem::contact {
namespace {

constexpr int rounds = 12;               ///< of states; those that take more rarely settle at all
constexpr double compliance = 1e-12;     ///< of a contact, over its mobility
constexpr double isotropic = 1e-9;       ///< by how much less mobilities along two axes are one
constexpr double linear = 1e-9;          ///< of its strength: what a contact that slips may be off by
constexpr double contradiction = 1e-6;   ///< of the depth: contacts that stay open by more are not solved
constexpr double most_thrown = 100.0;    ///< times the depth, or the way that the fastest slips
constexpr double most_turn = 1.0 - 1e-6; ///< S/|τ| of a contact that hardly slips, as its direction turns
constexpr double least_pivot = 1e-14;    ///< of what the diagonal was, in space
constexpr std::size_t most_on_tool = 32; ///< contacts that a free tool couples all with all
constexpr double most_work = 3e3;        ///< of an elimination in space, a contact: about 100 sweeps

/// dS/dp of Contact::strength at p ≥ 0.
template<int dim> double slope(const Contact<dim>& contact, double p) {
  const double pull = contact.coulomb * p;
  if (contact.smooth) return std::isfinite(pull) ? contact.coulomb * std::exp(-pull / contact.limit) : 0.0;
  return pull < contact.limit ? contact.coulomb : 0.0;
}

} // namespace

template<int dim>
typename ContactSystem<dim>::Outcome
ContactSystem<dim>::settle(std::vector<Contact<dim>>& contacts, std::span<const std::int32_t> group,
                           ReactionsOfNodes<dim>& nodes, ReactionsOfTools<dim>& tools, double dt,
                           double depth, double known_depth) {
  Reaction<dim> none;
  const auto sweeper = [&](std::int32_t c) {
    Contact<dim>& contact = contacts[index_of(c)];
    return Sweeper<dim>(contact, nodes, exists(contact.tool) ? tools[contact.tool] : none, dt);
  };
  member_.clear();
  rubs_ = false;
  for (const std::int32_t c : group)
    if (!take(c, contacts[index_of(c)], sweeper(c), dt)) return Outcome::unsettled;
  if (!couple(contacts, nodes, tools)) return Outcome::costly;
  number();
  if (wide(band_)) return Outcome::costly;
  fill();
  look(contacts);
  bool settled = false;
  for (int round = 0; round < rounds && !settled; ++round) {
    if (!solve(contacts)) return Outcome::unsettled;
    settled = !look(contacts);
  }
  if (!settled || !consistent(dt, depth, known_depth)) return Outcome::unsettled;
  for (const Member& member : member_) {
    Vec<dim> sliding = member.impulse(1) * member.axis[1];
    if constexpr (dim == 3) sliding += member.impulse(2) * member.axis[2];
    sweeper(member.contact).set(std::max(0.0, member.impulse(0)), sliding);
  }
  return Outcome::settled;
}

/// Lists a member; false where it slips along what holds it, which no impulse stops.
template<int dim>
bool ContactSystem<dim>::take(std::int32_t c, const Contact<dim>& contact, const Sweeper<dim>& sweeper,
                              double dt) {
  Member& member = member_.emplace_back();
  member.contact = c;
  take_axes(member, contact, sweeper);
  const Vec<dim> slip = sweeper.slip();
  member.given[0] = contact.pressing;
  member.velocity[0] = sweeper.gap() / dt;
  double rubbing = 0.0;
  for (std::size_t k = 1; k < dim; ++k) {
    member.given[k] = contact.sliding.dot(member.axis[k]);
    member.velocity[k] = slip.dot(member.axis[k]);
    rubbing += std::abs(member.given[k]);
    if (dim == 3 && member.mobility[k] == 0.0 && member.sideways > 0.0 &&
        std::abs(member.velocity[k]) > linear * slip.norm())
      return false;
  }
  member.before = member.velocity;
  rubs_ = rubs_ || (contact.coulomb > 0.0 && contact.limit > 0.0) || rubbing != 0.0;
  return true;
}

/// Whether what the last solution closes is closed, what it lets stick sticks, and none is thrown.
template<int dim> bool ContactSystem<dim>::consistent(double dt, double depth, double known_depth) const {
  double way = known_depth; // m
  for (const Member& member : member_)
    for (std::size_t k = 1; k < width(); ++k) way = std::max(way, std::abs(member.before[k]) * dt);
  const double thrown = std::max(most_thrown * depth, known_depth);
  for (const Member& member : member_) {
    if (member.state == State::open) continue;
    if (!(std::abs(member.velocity[0]) * dt <= contradiction * known_depth)) return false;
    if (!(std::abs(member.change[0]) * member.mobility[0] * dt <= thrown)) return false;
    if constexpr (dim == 3)
      for (std::size_t k = 1; k < width(); ++k) {
        if (!(std::abs(member.velocity[k] - member.before[k]) * dt <= most_thrown * way)) return false;
        if (member.state == State::sticking && !(std::abs(member.velocity[k]) * dt <= contradiction * way))
          return false;
      }
  }
  return true;
}

/// Along the surface the principal axes of the mobility, so that one of them is held where nodes are.
template<int dim>
void ContactSystem<dim>::take_axes(Member& member, const Contact<dim>& contact,
                                   const Sweeper<dim>& sweeper) const {
  const Vec<dim>& n = member.axis[0] = contact.normal;
  if constexpr (dim == 2) {
    member.axis[1] = left_normal(n);
  } else {
    const Vec3 u = n.unitOrthogonal(), v = n.cross(u);
    const double uu = sweeper.along(u), vv = sweeper.along(v), across = sweeper.along((u + v).normalized());
    const double twist = 2.0 * across - uu - vv, apart = uu - vv; // twice the mixed term
    const double turn =
        std::hypot(twist, apart) > isotropic * (uu + vv) ? 0.5 * std::atan2(twist, apart) : 0.0;
    member.axis[1] = std::cos(turn) * u + std::sin(turn) * v;
    member.axis[2] = n.cross(member.axis[1]);
  }
  for (std::size_t k = 0; k < dim; ++k) member.mobility[k] = sweeper.along(member.axis[k]);
  member.sideways = *std::max_element(member.mobility.begin() + 1, member.mobility.end());
}

/// Whether an elimination costs more than the sweeps it may save.
template<int dim> bool ContactSystem<dim>::wide(std::size_t band) const {
  return dim == 3 && static_cast<double>(width() * band * band) > most_work;
}

/// Whether the band is wide in whatever order, as known without any: of d members that one feels, itself
/// among them, some are d/2 places away.
template<int dim> bool ContactSystem<dim>::surely_wide() {
  if (dim == 2) return false;
  constexpr std::size_t slots = Contact<dim>::slots;
  first_end_.resize(member_.size());
  for (auto& first : first_end_) first.fill(end_.size());
  for (std::size_t from = 0, e = 0; e < end_.size(); ++e) {
    if (end_[e].node != end_[from].node) from = e;
    auto& first = first_end_[index_of(end_[e].member)];
    *std::find(first.begin(), first.end(), end_.size()) = from;
  }
  place_.assign(member_.size(), -1); // here: by which member it was seen last
  for (std::size_t m = 0; m < member_.size(); ++m) {
    std::size_t feels = 0;
    for (std::size_t a = 0; a < slots; ++a)
      for (std::size_t first = first_end_[m][a], e = first;
           e < end_.size() && end_[e].node == end_[first].node; ++e)
        if (std::int32_t& by = place_[index_of(end_[e].member)]; by != as<std::int32_t>(m)) {
          by = as<std::int32_t>(m);
          ++feels;
        }
    if (wide(width() * (feels / 2 + 1) - 1)) return true;
  }
  return false;
}

/// Lists the links; false where a free tool makes too many, or the band will be wide.
template<int dim>
bool ContactSystem<dim>::couple(const std::vector<Contact<dim>>& contacts, const ReactionsOfNodes<dim>& nodes,
                                const ReactionsOfTools<dim>& tools) {
  end_.clear();
  for (std::size_t m = 0; m < member_.size(); ++m) {
    const Contact<dim>& contact = contacts[index_of(member_[m].contact)];
    for (std::size_t a = 0; a < Contact<dim>::slots; ++a)
      if (contact.weight[a] != 0.0)
        end_.push_back({mover(nodes, contact.node[a]), as<std::int32_t>(m), contact.weight[a]});
  }
  std::sort(end_.begin(), end_.end(), [](const End& a, const End& b) {
    return std::pair(a.node, a.member) < std::pair(b.node, b.member);
  });
  if (surely_wide()) return false;
  link_.clear();
  for (auto from = end_.begin(); from != end_.end();) {
    const auto to = std::find_if(from, end_.end(), [&](const End& end) { return end.node != from->node; });
    for (auto one = from; one != to; ++one)
      for (auto other = from; other != to; ++other)
        link_.push_back(
            {one->member, other->member, one->weight * other->weight, &nodes[from->node].inverse});
    from = to;
  }
  for (const ToolIndex t : tools.indices()) {
    if (tools[t].inverse.isZero(0.0)) continue;
    queue_.clear();
    for (std::size_t m = 0; m < member_.size(); ++m)
      if (contacts[index_of(member_[m].contact)].tool == t) queue_.push_back(as<std::int32_t>(m));
    if (queue_.size() > most_on_tool) return false;
    for (const std::int32_t one : queue_)
      for (const std::int32_t other : queue_) link_.push_back({one, other, 1.0, &tools[t].inverse});
  }
  return true;
}

/// Numbers the members breadth first, from one that is far from the first; knows the band then.
template<int dim> void ContactSystem<dim>::number() {
  const std::size_t n = member_.size();
  std::sort(link_.begin(), link_.end(), [](const Link& a, const Link& b) {
    return std::pair(a.one, a.other) < std::pair(b.one, b.other);
  });
  first_link_.assign(n + 1, 0);
  for (const Link& link : link_) ++first_link_[index_of(link.one) + 1];
  std::partial_sum(first_link_.begin(), first_link_.end(), first_link_.begin());
  std::int32_t start = 0;
  for (int search = 0; search < 2; ++search) {
    place_.assign(n, -1);
    queue_.assign(1, start);
    place_[index_of(start)] = 0;
    for (std::size_t q = 0; q < queue_.size(); ++q) {
      const std::size_t m = index_of(queue_[q]);
      for (std::size_t l = first_link_[m]; l < first_link_[m + 1]; ++l) {
        const std::int32_t other = link_[l].other;
        if (place_[index_of(other)] >= 0) continue;
        place_[index_of(other)] = as<std::int32_t>(queue_.size());
        queue_.push_back(other);
      }
    }
    start = queue_.back();
  }
  assert(queue_.size() == n);
  std::int32_t apart = 0;
  for (const Link& link : link_)
    apart = std::max(apart, std::abs(place_[index_of(link.one)] - place_[index_of(link.other)]));
  band_ = width() * (index_of(apart) + 1) - 1;
}

template<int dim> std::size_t ContactSystem<dim>::row(std::int32_t member, std::size_t k) const {
  return width() * index_of(place_[index_of(member)]) + k;
}

/// Such that [column] is an entry of the band.
template<int dim> double* ContactSystem<dim>::row_of(std::vector<double>& matrix, std::size_t row) const {
  return matrix.data() + row * 2 * band_ + band_;
}

/// The mobilities: velocities of all members per impulse of each.
template<int dim> void ContactSystem<dim>::fill() {
  mobility_.assign(width() * member_.size() * (2 * band_ + 1), 0.0);
  for (const Link& link : link_) {
    const Mat<dim> inverse = link.weight * *link.inverse;
    for (std::size_t k = 0; k < width(); ++k)
      for (std::size_t l = 0; l < width(); ++l)
        row_of(mobility_, row(link.one, k))[row(link.other, l)] +=
            member_[index_of(link.one)].axis[k].dot(inverse * member_[index_of(link.other)].axis[l]);
  }
}

/// Of the last solution, with the friction that would let it stick.
template<int dim>
typename ContactSystem<dim>::State ContactSystem<dim>::state_of(const Contact<dim>& contact,
                                                                const Member& member,
                                                                Vec<dim - 1>& friction) const {
  friction.setZero();
  if (member.mobility[0] == 0.0) return State::open;
  const double pressing = member.impulse(0) - member.velocity[0] / member.mobility[0];
  if (pressing <= 0.0) return State::open;
  const double strength = contact.strength(pressing);
  if (!rubs_ || member.sideways == 0.0 || strength <= 0.0) return State::pressing;
  for (std::size_t k = 1; k < dim; ++k)
    friction[static_cast<Eigen::Index>(k) - 1] =
        member.impulse(k) - (member.mobility[k] > 0.0 ? member.velocity[k] / member.sideways : 0.0);
  return friction.norm() <= strength ? State::sticking : State::slipping;
}

/// Takes the states from the last solution; true when it is not yet one.
template<int dim> bool ContactSystem<dim>::look(const std::vector<Contact<dim>>& contacts) {
  bool changed = false;
  for (Member& member : member_) {
    const Contact<dim>& contact = contacts[index_of(member.contact)];
    Vec<dim - 1> friction;
    const State state = state_of(contact, member, friction);
    changed = changed || state != member.state;
    member.state = state;
    if (state != State::slipping) continue;
    const Vec<dim - 1> before = member.direction;
    member.wanted = friction.norm();
    member.direction = friction / member.wanted;
    changed = changed || member.direction.dot(before) < 0.0;
    const double strength = contact.strength(member.impulse(0));
    for (std::size_t k = 1; k < dim; ++k) friction[static_cast<Eigen::Index>(k) - 1] = member.impulse(k);
    changed = changed || (friction - strength * member.direction).norm() > linear * strength;
  }
  return changed;
}

/// One equation for each impulse, from the states.
template<int dim> void ContactSystem<dim>::set_rows(const std::vector<Contact<dim>>& contacts) {
  matrix_ = mobility_;
  right_.resize(width() * member_.size());
  for (std::size_t m = 0; m < member_.size(); ++m) {
    const Member& member = member_[m];
    for (std::size_t k = 0; k < width(); ++k) {
      const std::size_t r = row(as<std::int32_t>(m), k);
      double* const entry = row_of(matrix_, r);
      const bool held = k > 0 && member.state == State::sticking && member.mobility[k] == 0.0;
      if (!held && member.state != State::open &&
          (k == 0 || member.state == State::sticking)) { // comes to rest
        entry[r] *= 1.0 + compliance;
        right_[r] = -member.before[k];
        continue;
      }
      std::fill(entry + r - band_, entry + r + band_ + 1, 0.0);
      entry[r] = 1.0;
      right_[r] = held ? 0.0 : -member.given[k]; // what is held keeps what it bears
      if (k > 0 && member.state == State::slipping)
        set_slip(contacts[index_of(member.contact)], as<std::int32_t>(m), k);
    }
  }
}

/// Friction as large as it can be, against the slip: S(p) τ/|τ|, τ the friction that would let it stick. In
/// space the direction turns with τ by P/|τ|, P = 1 − direction ⊗ direction; S/|τ| is kept below 1, which it
/// is at the solution, so that rows stay regular on the way.
template<int dim>
void ContactSystem<dim>::set_slip(const Contact<dim>& contact, std::int32_t m, std::size_t k) {
  const Member& member = member_[index_of(m)];
  const std::size_t r = row(m, k);
  double* const entry = row_of(matrix_, r);
  const auto along = [&](std::size_t l) { return member.direction[static_cast<Eigen::Index>(l) - 1]; };
  const double pressing = std::max(0.0, member.impulse(0)), rise = slope(contact, pressing),
               strength = contact.strength(pressing);
  entry[row(m, 0)] = -along(k) * rise;
  right_[r] += along(k) * (strength - rise * (pressing - member.given[0]));
  if constexpr (dim == 3) {
    const double share = std::min(strength / member.wanted, most_turn);
    for (std::size_t l = 1; l < dim; ++l) {
      const double turn = share * ((k == l ? 1.0 : 0.0) - along(k) * along(l)),
                   moved = turn / member.sideways;
      const std::size_t other = row(m, l), first = other - std::min(other, band_),
                        last = std::min(right_.size(), other + band_ + 1);
      const double* const velocity = row_of(mobility_, other);
      for (std::size_t c = std::max(first, r - std::min(r, band_)); c < std::min(last, r + band_ + 1); ++c)
        entry[c] += moved * velocity[c];
      entry[other] -= turn;
      right_[r] += moved * (member.velocity[l] - member.before[l]) - turn * member.change[l];
    }
  }
}

/// Gauss's, without pivoting: in the plane all rows that are not the identity have mobilities, which are
/// definite; in space false where slip and normal impulses couple so that a pivot vanishes.
template<int dim> bool ContactSystem<dim>::eliminate() {
  const std::size_t n = right_.size();
  if constexpr (dim == 3) {
    diagonal_.resize(n);
    for (std::size_t r = 0; r < n; ++r) diagonal_[r] = std::abs(row_of(matrix_, r)[r]);
  }
  for (std::size_t r = 0; r < n; ++r) {
    const double* const pivot = row_of(matrix_, r);
    if (pivot[r] == 0.0) return false;
    if constexpr (dim == 3)
      if (!(std::abs(pivot[r]) > least_pivot * diagonal_[r])) return false;
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

template<int dim> bool ContactSystem<dim>::solve(const std::vector<Contact<dim>>& contacts) {
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

template class ContactSystem<2>;
template class ContactSystem<3>;

} // namespace cnem::contact
