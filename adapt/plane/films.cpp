// Films, thinner than a cell: cut where they are thinnest, before their faces pass each other.
#include "adapt/plane/cut.hpp"

#include "core/index.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <tuple>
#include <utility>
#include <vector>

namespace cnem::adapt {

namespace {

struct Waist {
  double thickness; ///< in units of the wanted spacing
  NodeIndex node;   ///< at one face
  NodeIndex start;  ///< at the other: the node, or the start of the facet that has none yet
  double place;     ///< on that facet; 0: at its start
};

/// Between boundary nodes across films that are to be cut, or between one and the foot of it on a facet, the
/// thinnest first.
std::vector<Waist> waists(const WorkingCloud& work, const Structure& structure, const SplitRules& rules) {
  const auto& mesh = structure.mesh;
  const auto at = [&](NodeIndex i) -> const Vec2& { return work.cloud().position[i]; };
  const auto ends_cut = [&](NodeIndex i) { return work.on_boundary(i) && !work.has_mates(i); };
  const auto broken = [&](NodeIndex i) { return work.node().broken[index_of(i)] >= 1.0; };
  std::vector<Waist> found;
  const auto consider = [&](NodeIndex i, NodeIndex start, double place, double distance, bool is_broken) {
    const double thickness = distance / work.size_between(i, start);
    if (distance < rules.thinnest_film || (is_broken && thickness < rules.film))
      found.push_back({thickness, i, start, place});
  };
  for (const NodeIndex i : work.nodes())
    for (const NodeIndex k : structure.neighbours(i))
      if (i < k && ends_cut(i) && ends_cut(k) && work.next(i) != k && work.previous(i) != k)
        consider(i, k, 0.0, (at(k) - at(i)).norm(), broken(i) && broken(k));
  for (const SimplexIndex t : mesh.node.indices())
    for (std::size_t k = 0; k < 3; ++k) {
      const std::size_t next = (k + 1) % 3, last = (k + 2) % 3;
      // with two facets it is a corner
      if (!exists(mesh.facet[t][k]) || exists(mesh.facet[t][next]) || exists(mesh.facet[t][last])) continue;
      const NodeIndex i = mesh.node[t][k], a = mesh.node[t][next], b = mesh.node[t][last];
      if (!ends_cut(i) || !ends_cut(a) || !ends_cut(b)) continue;
      const Foot foot = foot_on(at(i), at(a), at(b));
      const double length = (at(b) - at(a)).norm();
      // feet beside an end are left to that end
      if (std::min(foot.place, 1.0 - foot.place) * length > foot.distance)
        consider(i, a, foot.place, foot.distance, broken(i) && broken(a) && broken(b));
    }
  std::sort(found.begin(), found.end(), [](const Waist& a, const Waist& b) {
    return std::tie(a.thickness, a.node, a.start) < std::tie(b.thickness, b.node, b.start);
  });
  return found;
}

/// Puts a node on a facet, with the matter of the cell it takes. Returns its number; none, with nothing
/// changed, when there is no room for one.
NodeIndex insert_foot(WorkingCloud& work, Structure& structure, const Waist& waist) {
  WorkingCloud changed = work;
  const NodeIndex made = changed.insert_between(waist.start, work.next(waist.start), true, waist.place);
  changed.refresh_facets();
  std::optional<Structure> after = structure_if_valid(changed.cloud(), structure.space);
  if (!after) return NodeIndex::none;
  IndexedVector<NodeIndex, char> is_made(changed.size(), 0);
  is_made[made] = 1;
  changed.move(stolen(changed.cloud(), structure, *after, is_made));
  if (!(changed.node().mass[index_of(made)] > 0.0)) return NodeIndex::none;
  work = std::move(changed);
  structure = std::move(*after);
  return made;
}

bool cut_at(WorkingCloud& work, Structure& structure, const Waist& waist, const SplitRules& rules) {
  WorkingCloud opened = work;
  Structure after = structure;
  const NodeIndex to = waist.place > 0.0 ? insert_foot(opened, after, waist) : waist.start;
  if (!exists(to) || shaves(opened, waist.node, to, rules) || shaves(opened, to, waist.node, rules) ||
      !open_cut(opened, after, std::array{Path{waist.node, to}}, rules, 0.0))
    return false;
  work = std::move(opened);
  structure = std::move(after);
  return true;
}

} // namespace

void cut_films(WorkingCloud& work, Structure& structure, const SplitRules& rules, PassReport& report) {
  constexpr int most = 8;     // cuts in one pass
  constexpr int smallest = 2; // nodes of a crumb, besides the two of the cut
  for (int k = 0; k < most; ++k) {
    const BoundaryLoops loops(work);
    const std::vector<Waist> found = waists(work, structure, rules);
    const auto cut = std::find_if(found.begin(), found.end(), [&](const Waist& waist) {
      const double length = waist.thickness * work.size_between(waist.node, waist.start);
      const int least = waist.thickness < rules.nothing ? smallest : rules.least_loop;
      return loops.parts(waist.node, waist.start, rules.part * length, least) &&
             cut_at(work, structure, waist, rules);
    });
    if (cut == found.end()) return;
    ++report.films;
    ++report.cuts;
    ++report.opened;
  }
}

} // namespace cnem::adapt
