// Crumbs: bodies of a few nodes, none of them inside, that are thinner than films may be or next to nothing:
// what is left of films that were cut, and debris that was pressed flat. Or debris that flies apart, some of
// it inside: its nodes bear nothing together and go their ways until the loop turns inside out.
#include "adapt/plane/apply_valid.hpp"
#include "adapt/plane/resample.hpp"
#include "core/index.hpp"

#include <algorithm>
#include <limits>
#include <set>
#include <span>
#include <utility>
#include <vector>

namespace cnem::adapt {

namespace {

/// The nodes of a loop of the boundary from one of them on; empty where there are more than `most`.
std::vector<NodeIndex> short_loop(const WorkingCloud& work, NodeIndex start, std::size_t most) {
  std::vector<NodeIndex> loop;
  NodeIndex i = start;
  do {
    if (loop.size() == most) return {};
    loop.push_back(i);
    i = work.next(i);
  } while (i != start);
  return loop;
}

/// The nodes of the body that a loop bounds, those inside last; empty where there are more than `most`, mates
/// or another loop.
std::vector<NodeIndex> body_of(const WorkingCloud& work, const Structure& structure,
                               const std::vector<NodeIndex>& loop, std::size_t most) {
  std::vector<NodeIndex> body = loop;
  for (std::size_t n = 0; n < body.size(); ++n) {
    if (work.on_boundary(body[n]) && work.has_mates(body[n])) return {};
    for (const NodeIndex k : structure.neighbours(body[n])) {
      if (std::find(body.begin(), body.end(), k) != body.end()) continue;
      if (work.on_boundary(k) || body.size() == most) return {};
      body.push_back(k);
    }
  }
  return body;
}

/// Whether twice the area of a loop over its length is below what bodies may be.
bool is_thin(const WorkingCloud& work, const std::vector<NodeIndex>& loop, const SplitRules& rules) {
  const auto& at = work.cloud().position;
  double twice = 0.0, length = 0.0;
  for (const NodeIndex i : loop) {
    const NodeIndex next = work.next(i);
    twice += cross(at[i] - at[loop.front()], at[next] - at[loop.front()]);
    length += (at[next] - at[i]).norm();
  }
  const double thinnest =
      std::max(rules.thinnest_film, rules.nothing * work.node().size[index_of(loop.front())]);
  return twice > 0.0 && twice < thinnest * length;
}

/// Whether a body is debris alone, with nodes of one facet as far apart as nothing holds them.
bool flies_apart(const WorkingCloud& work, const std::vector<NodeIndex>& body,
                 const std::vector<NodeIndex>& loop) {
  const auto& at = work.cloud().position;
  return std::all_of(body.begin(), body.end(), [&](NodeIndex i) { return work.is_debris(i); }) &&
         std::any_of(loop.begin(), loop.end(), [&](NodeIndex i) {
           const NodeIndex next = work.next(i);
           return (at[next] - at[i]).norm() > debris_flown * work.size_between(i, next);
         });
}

/// The nearest node at the boundary of other matter of the same part that is to stay; none where all of it
/// goes.
NodeIndex host_of(const WorkingCloud& work, const std::vector<NodeIndex>& crumb,
                  const IndexedVector<NodeIndex, char>& gone) {
  const auto& at = work.cloud().position;
  double nearest = std::numeric_limits<double>::infinity();
  NodeIndex host = NodeIndex::none;
  for (const NodeIndex k : work.nodes()) {
    if (!work.on_boundary(k) || gone[k] || !work.may_mix(crumb.front(), k)) continue;
    for (const NodeIndex i : crumb) {
      const double distance = (at[k] - at[i]).squaredNorm();
      if (distance >= nearest) continue;
      nearest = distance;
      host = k;
    }
  }
  return host;
}

struct Joining {
  std::vector<NodeIndex> crumb;
  NodeIndex host;
};

/// Returns how many.
int join(WorkingCloud& work, std::span<const Joining> joining) {
  IndexedVector<NodeIndex, char> gone(work.size(), 0);
  for (const auto& [crumb, host] : joining)
    for (const NodeIndex i : crumb) {
      work.move_now(i, host, 1.0);
      if (work.on_boundary(i)) work.bypass(i);
      gone[i] = 1;
    }
  work.drop(gone);
  work.refresh_facets();
  return static_cast<int>(joining.size());
}

} // namespace

void join_crumbs(WorkingCloud& work, Structure& structure, const SplitRules& rules, PassReport& report) {
  IndexedVector<NodeIndex, char> gone(work.size(), 0);
  std::vector<std::vector<NodeIndex>> crumbs;
  for (const NodeIndex start : work.nodes()) {
    if (!work.on_boundary(start)) continue;
    const std::size_t few = index_of(rules.least_loop);
    const std::vector<NodeIndex> loop = short_loop(work, start, 2 * few);
    if (loop.empty() || *std::min_element(loop.begin(), loop.end()) != start) continue;
    const std::vector<NodeIndex> body = body_of(work, structure, loop, 2 * few);
    const bool thin_loop = body.size() == loop.size() && loop.size() <= few && is_thin(work, loop, rules);
    if (body.empty() || !(thin_loop || flies_apart(work, body, loop))) continue;
    for (const NodeIndex i : body) gone[i] = 1;
    crumbs.push_back(body);
  }
  std::set<PieceIndex> elsewhere{rules.piece};
  for (const NodeIndex i : work.nodes())
    if (work.on_boundary(i) && !gone[i]) elsewhere.insert(work.piece(i));
  std::vector<Joining> joining;
  for (const std::vector<NodeIndex>& crumb : crumbs) {
    const bool may_go = std::all_of(crumb.begin(), crumb.end(), [&](NodeIndex i) {
      return !work.on_boundary(i) || elsewhere.contains(work.piece(i));
    });
    if (const NodeIndex host = may_go ? host_of(work, crumb, gone) : NodeIndex::none; exists(host)) {
      joining.push_back({crumb, host});
      continue;
    }
    for (const NodeIndex i : crumb) gone[i] = 0;
  }
  report.crumbs += apply_valid(work, structure, std::move(joining), join, report);
}

} // namespace cnem::adapt
