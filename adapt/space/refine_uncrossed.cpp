#include "adapt/space/refine_uncrossed.hpp"

#include "core/index.hpp"
#include "voronoi/space/crossings.hpp"

namespace cnem::adapt {

UncrossedSurface refine_uncrossed(const Cloud<3>& cloud, const NodeProperties& properties, const Field& size,
                                  const SpaceRules& rules, bool sound) {
  IndexedVector<NodeIndex, char> held = properties.held, crossed(held.size(), 0);
  const PeriodImages images(cloud, rules.periods);
  Field matter(size.size());
  for (std::size_t i = 0; i < matter.size(); ++i) matter[i] = properties.filled(as<NodeIndex>(i));
  IndexedVector<NodeIndex, char> debris(held.size());
  for (const NodeIndex i : debris.indices()) debris[i] = properties.is_debris(i);
  constexpr int most = 4;
  for (int n = 0;; ++n) {
    UncrossedSurface result{WorkingSurface(cloud, held, rules.surface), {}, size, {}};
    result.surface.hold_between(crossed);
    result.surface.leave_apart(debris);
    if (n == most) {
      result.sound = sound;
      result.changes.into.assign(cloud.position.size(), NodeIndex::none);
      ++result.report.undone;
      return result;
    }
    result.changes =
        refine_surface(result.surface, result.size, matter, rules.thresholds.surface, result.report, images);
    Cloud<3> after;
    after.position = result.surface.position();
    after.facets = result.surface.facets();
    after.twins = cloud.twins;
    after.body = cloud.body;
    if (!after.body.empty())
      for (const auto& [a, b] : result.changes.made) after.body.push_back(std::int32_t{after.body[a]});
    const auto pairs =
        sound ? voronoi::crossings(after, result.surface.changed_facets(cloud)) : voronoi::crossings(after);
    if (pairs.empty()) return result;
    const auto hold = [&](NodeIndex i) { held[i] = crossed[i] = 1; };
    for (const auto& pair : pairs)
      for (const CloudFacetIndex f : pair) {
        // old nodes of the facet and those that its new ones come from
        std::vector<NodeIndex> stack(after.facets[f].node.begin(), after.facets[f].node.end());
        while (!stack.empty()) {
          const NodeIndex i = stack.back();
          stack.pop_back();
          if (index_of(i) < held.size()) {
            hold(i);
            result.surface.around(i, [&](auto e) {
              if (index_of(result.surface.end(e)) < held.size()) hold(result.surface.end(e));
            });
          } else {
            const auto& ends = result.changes.made[index_of(i) - held.size()];
            stack.insert(stack.end(), ends.begin(), ends.end());
          }
        }
      }
    for (const NodeIndex i : cloud.position.indices()) { // what has gone into nodes there stays, too
      NodeIndex at = i;
      while (exists(result.changes.into[at])) at = result.changes.into[at];
      if (index_of(at) < held.size() && crossed[at]) hold(i);
    }
  }
}

} // namespace cnem::adapt
