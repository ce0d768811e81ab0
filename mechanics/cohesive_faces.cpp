#include "mechanics/cohesive_faces.hpp"
#include "mechanics/placed_element.hpp"

#include <algorithm>
#include <cassert>
#include <utility>

namespace cnem {
CohesiveFaces::CohesiveFaces(std::vector<CohesiveSpec> specs, const Cloud<2>& cloud, bool left_to_contact)
    : left_to_contact_(left_to_contact) {
  for (CohesiveSpec& spec : specs) {
    CohesiveInterface& made = interface_.emplace_back();
    made.spec = std::move(spec);
    for (std::size_t s = 0; s < 2; ++s) {
      double arc = 0.0;
      made.face[s] = segments_of(cloud, made.spec.piece[s], s);
      for (BondedSegment& segment : made.face[s]) {
        segment.arc[0] = arc;
        arc += (cloud.position[segment.node[1]] - cloud.position[segment.node[0]]).norm();
        segment.arc[1] = arc;
      }
      made.length = arc;
    }
    build(made);
    for (std::size_t e = 0; e < made.element.size(); ++e)
      for (std::size_t end = 0; end < 2; ++end)
        for (const auto& [from, to] : made.spec.open) {
          const double middle = 0.5 * (made.element[e].arc[0] + made.element[e].arc[1]);
          if (middle > from && middle < to) made.state[e][end].damage = 1.0;
        }
  }
}

/// Elements where segments of both faces overlap, at rest.
void CohesiveFaces::build(CohesiveInterface& interface) const {
  interface.element.clear();
  const auto& [left, right] = interface.face;
  const double least = 1e-9 * interface.length; // ends of segments that differ by rounding are one
  for (std::size_t i = 0, j = 0; i < left.size() && j < right.size();) {
    const double from = std::max(left[i].arc[0], right[j].arc[0]),
                 to = std::min(left[i].arc[1], right[j].arc[1]);
    if (to - from > least) interface.element.push_back({{left[i], right[j]}, {from, to}});
    if (left[i].arc[1] <= right[j].arc[1])
      ++i;
    else
      ++j;
  }
  interface.state.assign(interface.element.size(), {});
}

CohesiveWork CohesiveFaces::evaluate(const Fields<2>& position) {
  CohesiveWork work;
  has_broken_ = false;
  for (std::size_t k = 0; k < 2; ++k) force_[k].assign(position[k].size(), 0.0);
  for (CohesiveInterface& interface : interface_) {
    const plasticity::CohesiveLaw& law = interface.spec.law;
    for (std::size_t e = 0; e < interface.element.size(); ++e) {
      if (free(interface.state[e][0]) && free(interface.state[e][1])) continue;
      const CohesiveElement& element = interface.element[e];
      const PlacedElement now(element, position);
      const double weight = element.weight();
      for (std::size_t end = 0; end < 2; ++end) {
        CohesiveEnd& state = interface.state[e][end];
        if (free(state)) continue;
        const Vec2 jump = now.jump(element, end);
        const double across = now.normal.dot(jump);
        const Vec2 separation(across - state.offset, now.along.dot(jump));
        const bool across_each_other = now.across_each_other();
        const double damage = across_each_other ? 1.0 : law.damage_at(separation, state.damage);
        const double pressed = std::min(separation.x(), 0.0) * std::min(state.separation.x(), 0.0);
        work.dissipated += weight * law.dissipated(state.separation, separation, damage - state.damage);
        has_broken_ |= damage >= 1.0 && state.damage < 1.0;
        state.damage = damage;
        state.separation = separation;
        if (free(state) || across_each_other) { // contact goes on with what is pressed, K stores no more
          work.dissipated += weight * 0.5 * law.stiffness * pressed;
          if (!free(state)) state.separation.setZero(); // it is booked
          continue;
        }
        work.stored += weight * law.stored(separation, damage);
        const Vec2 traction = law.traction(separation, damage);
        const Vec2 push = weight * (traction.x() * now.normal + traction.y() * now.along);
        const Vec2 couple =
            weight * (traction.y() * across - traction.x() * separation.y()) / now.stretch * now.normal;
        for (std::size_t s = 0; s < 2; ++s) {
          const auto values = element.values(s, end);
          for (std::size_t a = 0; a < 2; ++a) {
            const Vec2 part =
                (s == 0 ? -values[a] : values[a]) * push + (a == 0 ? 1.0 : -1.0) / now.span[s] * couple;
            for (std::size_t k = 0; k < 2; ++k)
              force_[k][index_of(element.side[s].node[a])] += part[static_cast<Eigen::Index>(k)];
          }
        }
      }
    }
  }
  return work;
}

/// Where the points of an end are apart by δ the couple of its tractions turns both segments, by lever arms
/// δ/span: a gradient of δ has N + arm for each node, and the arms of its side besides.
Field CohesiveFaces::stiffness_rows(const Fields<2>& position) const {
  Field row(position[0].size(), 0.0);
  for (const CohesiveInterface& interface : interface_)
    for (std::size_t e = 0; e < interface.element.size(); ++e) {
      if (free(interface.state[e][0]) && free(interface.state[e][1])) continue;
      const CohesiveElement& element = interface.element[e];
      const PlacedElement now(element, position);
      if (now.across_each_other()) continue;
      for (std::size_t end = 0; end < 2; ++end) {
        const CohesiveEnd& state = interface.state[e][end];
        if (free(state)) continue;
        const bool open = state.damage >= 1.0 && state.separation.x() >= 0.0; // bears nothing
        const double apart = open ? 0.0 : now.jump(element, end).norm() / now.stretch;
        const std::array<double, 2> arm{apart / now.span[0], apart / now.span[1]};
        const double whole = interface.spec.law.stiffness * element.weight() * 2.0 * (1.0 + arm[0] + arm[1]);
        for (std::size_t s = 0; s < 2; ++s) {
          const auto values = element.values(s, end);
          for (std::size_t a = 0; a < 2; ++a)
            row[index_of(element.side[s].node[a])] += whole * (values[a] + arm[s]);
        }
      }
    }
  return row;
}

double CohesiveFaces::frequency_bound(const Fields<2>& position, const Field& mass) const {
  const Field row = stiffness_rows(position);
  double bound = 0.0;
  for (std::size_t i = 0; i < row.size(); ++i) bound = std::max(bound, row[i] / mass[i]);
  return bound;
}

double CohesiveFaces::broken_length(const CohesiveInterface& interface) {
  double length = 0.0;
  for (std::size_t e = 0; e < interface.element.size(); ++e)
    for (const CohesiveEnd& end : interface.state[e])
      if (end.damage >= 1.0) length += interface.element[e].weight();
  return length;
}

contact::Bonds CohesiveFaces::bonds(const Cloud<2>& cloud) const {
  contact::Bonds bonds;
  if (interface_.empty() || !left_to_contact_) return bonds;
  bonds.rest(cloud.position.size(), cloud.facets.size());
  IndexedVector<NodeIndex, CloudFacetIndex> leaving(cloud.position.size(), CloudFacetIndex::none);
  for (const CloudFacetIndex f : cloud.facets.indices()) leaving[cloud.facets[f].node[0]] = f;
  for (std::size_t i = 0; i < interface_.size(); ++i)
    for (std::size_t s = 0; s < 2; ++s) {
      const auto number = as<std::int32_t>(2 * i + s);
      for (const BondedSegment& segment : interface_[i].face[s]) {
        const CloudFacetIndex f = leaving[segment.node[s == 0 ? 0 : 1]];
        bonds.face[f] = number;
        bonds.arc[f] = segment.arc;
      }
      for (std::size_t e = 0; e < interface_[i].element.size(); ++e) {
        const CohesiveElement& element = interface_[i].element[e];
        const BondedSegment& segment = element.side[s];
        for (std::size_t end = 0; end < 2; ++end) {
          const CohesiveEnd& state = interface_[i].state[e][end];
          const auto values = element.values(s, end);
          if (state.damage >= 1.0) {
            for (std::size_t a = 0; a < 2; ++a)
              if (values[a] > 0.0) {
                double& pressed = bonds.pressed[segment.node[a]];
                pressed = std::max(pressed, -(state.separation.x() + state.offset));
              }
            continue;
          }
          for (std::size_t a = 0; a < 2; ++a)
            if (values[a] > 0.5) {
              const NodeIndex node = segment.node[a];
              const double slid = state.separation.norm();
              if (std::exchange(bonds.bonded[node], number) != number)
                bonds.reach[node] = {segment.arc[a], segment.arc[a]};
              bonds.reach[node][0] = std::min(bonds.reach[node][0], segment.arc[a] - slid);
              bonds.reach[node][1] = std::max(bonds.reach[node][1], segment.arc[a] + slid);
            }
        }
      }
    }
  return bonds;
}

} // namespace cnem
