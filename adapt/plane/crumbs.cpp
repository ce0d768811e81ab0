// Crumbs: what is left of films that were cut, thinner than films may be, without a node inside.
#include "adapt/plane/resample.hpp"
#include "core/index.hpp"

#include <algorithm>
#include <limits>
#include <optional>
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

/// Whether a loop bounds a body of its own without inner nodes, twice its area over its length below
/// `thickness` (m), that nothing refers to.
bool is_crumb(const WorkingCloud& work, const Structure& structure, const std::vector<NodeIndex>& loop,
              double thickness) {
  const auto& at = work.cloud().position;
  double twice = 0.0, length = 0.0;
  for (const NodeIndex i : loop) {
    const NodeIndex next = work.next(i);
    if (work.held(i) || work.has_mates(i)) return false;
    for (const NodeIndex k : structure.neighbours(i))
      if (std::find(loop.begin(), loop.end(), k) == loop.end()) return false;
    twice += cross(at[i] - at[loop.front()], at[next] - at[loop.front()]);
    length += (at[next] - at[i]).norm();
  }
  return twice > 0.0 && twice < thickness * length;
}

/// The nearest node at the boundary of other matter of the same part that is to stay, no farther from a node
/// of the crumb than its spacing and the extent of the crumb; none where there is none.
NodeIndex host_of(const WorkingCloud& work, const std::vector<NodeIndex>& crumb,
                  const IndexedVector<NodeIndex, char>& gone) {
  const auto& at = work.cloud().position;
  double extent = 0.0;
  for (const NodeIndex i : crumb)
    for (const NodeIndex k : crumb) extent = std::max(extent, (at[k] - at[i]).norm());
  double nearest = std::numeric_limits<double>::infinity();
  NodeIndex host = NodeIndex::none;
  for (const NodeIndex k : work.nodes()) {
    if (!work.on_boundary(k) || gone[k] || !work.may_mix(crumb.front(), k)) continue;
    for (const NodeIndex i : crumb) {
      const double distance = (at[k] - at[i]).norm();
      if (distance >= std::min(nearest, work.node().size[index_of(k)] + extent)) continue;
      nearest = distance;
      host = k;
    }
  }
  return host;
}

} // namespace

void join_crumbs(WorkingCloud& work, Structure& structure, const SplitRules& rules, PassReport& report) {
  if (!(rules.thinnest_film > 0.0)) return;
  WorkingCloud joined = work;
  IndexedVector<NodeIndex, char> gone(work.size(), 0);
  std::vector<std::vector<NodeIndex>> crumbs;
  for (const NodeIndex start : work.nodes()) {
    if (!work.on_boundary(start)) continue;
    const std::vector<NodeIndex> loop = short_loop(work, start, index_of(rules.least_loop));
    if (loop.empty() || *std::min_element(loop.begin(), loop.end()) != start) continue;
    if (is_crumb(work, structure, loop, rules.thinnest_film)) crumbs.push_back(loop);
  }
  for (const std::vector<NodeIndex>& loop : crumbs)
    for (const NodeIndex i : loop) gone[i] = 1;
  int count = 0;
  for (const std::vector<NodeIndex>& loop : crumbs) {
    const NodeIndex host = host_of(work, loop, gone);
    for (const NodeIndex i : loop) {
      gone[i] = exists(host);
      if (!exists(host)) continue;
      joined.move_now(i, host, 1.0);
      joined.bypass(i);
    }
    count += exists(host);
  }
  if (count == 0) return;
  joined.drop(gone);
  joined.refresh_facets();
  std::optional<Structure> after = structure_if_valid(joined.cloud(), structure.space);
  if (!after) {
    ++report.undone;
    return;
  }
  work = std::move(joined);
  structure = std::move(*after);
  report.crumbs += count;
}

} // namespace cnem::adapt
