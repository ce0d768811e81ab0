#include "adapt/plane/resample.hpp"

#include "core/index.hpp"

#include <cassert>

namespace cnem::adapt {

std::optional<Resampling<2>> balanced(const Cloud<2>& cloud, const Structure& structure,
                                      NodeProperties properties, const Thresholds& thresholds,
                                      PassReport& report) {
  WorkingCloud work(cloud, std::move(properties));
  const int before = report.balanced;
  balance(work, structure, thresholds.balance(), report);
  if (report.balanced == before) return std::nullopt;
  Resampling<2> change = work.finish();
  change.old_position = cloud.position;
  change.points_stay = true;
  return change;
}

Resampling<2> resample(const Cloud<2>& cloud, std::optional<Structure> structure, NodeProperties properties,
                       const ResampleRules& rules, PassReport& report) {
  assert(!structure || structure->space == rules.space);
  WorkingCloud work(cloud, std::move(properties), rules.split.piece);
  if (!structure) {
    mend_boundary(work, report);
    drop_outside(work, report);
    structure = build_structure(work.cloud(), rules.space);
  }
  drop_strayed(work, *structure, report);
  if (!work.node().broken.empty()) {
    join_crumbs(work, *structure, rules.split, report);
    split(work, *structure, rules.split, report);
    if (rules.split.cracks) open_cracks(work, *structure, rules.split, report);
    cut_films(work, *structure, rules.split, report);
  }
  join_ends(work, *structure, report);
  const Thresholds& thresholds = rules.thresholds;
  for (int round = 0; round < thresholds.rounds; ++round)
    if (!thin(work, *structure, thresholds, report)) break;
  for (int round = 0; round < thresholds.rounds; ++round)
    if (!fill(work, *structure, thresholds, rules.placement, report)) break;
  balance(work, *structure, thresholds.balance(), report);
  report.volume_change = enclosed_measure(work.cloud(), rules.space) - enclosed_measure(cloud, rules.space);
  work.begin_with(structure->mesh.node, structure->mesh.neighbour);
  Resampling<2> change = work.finish();
  change.old_position = cloud.position;
  return change;
}

} // namespace cnem::adapt
