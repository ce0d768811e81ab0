#include "adapt/resample.hpp"

#include "core/index.hpp"

#include <algorithm>
#include <cassert>
#include <cmath>

namespace cnem::adapt {

PassReport& PassReport::operator+=(const PassReport& other) {
  for (int PassReport::*count :
       {&PassReport::cracks, &PassReport::advances, &PassReport::cuts, &PassReport::opened,
        &PassReport::films, &PassReport::folded, &PassReport::outside, &PassReport::removed,
        &PassReport::removed_boundary, &PassReport::promoted, &PassReport::inserted,
        &PassReport::inserted_boundary, &PassReport::balanced, &PassReport::undone})
    this->*count += other.*count;
  volume_change += other.volume_change;
  return *this;
}

double volume_ratio(const WorkingCloud& work, const Structure& structure, NodeIndex node) {
  const NodeProperties& p = work.node();
  if (!p.matter.empty()) return p.matter[index_of(node)] / p.mass[index_of(node)];
  return p.density[index_of(node)] * structure.volume(node) /
         (p.mass[index_of(node)] * p.jacobian[index_of(node)]);
}

/// Neighbours whose ratios differ exchange half of what would make them equal, the worst nodes first.
void balance(WorkingCloud& work, const Structure& structure, const Thresholds& thresholds,
             PassReport& report) {
  std::vector<std::pair<double, NodeIndex>> out;
  const auto distance = [](double r) { return std::max(r, 1.0 / r); };
  for (int sweep = 0; sweep < thresholds.rounds; ++sweep) {
    out.clear();
    for (const NodeIndex i : work.nodes()) {
      const double r = volume_ratio(work, structure, i);
      if (r < thresholds.light || r > thresholds.heavy) out.emplace_back(-distance(r), i);
    }
    if (out.empty()) return;
    std::sort(out.begin(), out.end());
    for (const auto& [order, i] : out) {
      for (const NodeIndex j : structure.neighbours(i)) {
        const double mine = volume_ratio(work, structure, i), other = volume_ratio(work, structure, j);
        if (mine >= thresholds.light && mine <= thresholds.heavy) break;
        // the ratio falls as mass comes: who has the larger one takes
        const bool takes = mine > thresholds.heavy;
        if (takes ? other >= mine : other <= mine) continue;
        const NodeIndex from = takes ? j : i, to = takes ? i : j;
        const NodeProperties& p = work.node();
        const double wanted_from = p.mass[index_of(from)] * volume_ratio(work, structure, from),
                     wanted_to = p.mass[index_of(to)] * volume_ratio(work, structure, to);
        const double equal = (wanted_to * p.mass[index_of(from)] - wanted_from * p.mass[index_of(to)]) /
                             (wanted_from + wanted_to);
        const double fraction = 0.5 * equal / p.mass[index_of(from)];
        if (!(fraction > 1e-6)) continue;
        work.move_now(from, to, fraction);
        ++report.balanced;
      }
    }
  }
}

std::optional<Resampling<2>> balanced(const Cloud<2>& cloud, const Structure& structure,
                                      NodeProperties properties, const Thresholds& thresholds,
                                      PassReport& report) {
  WorkingCloud work(cloud, std::move(properties));
  const int before = report.balanced;
  balance(work, structure, thresholds, report);
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
    split(work, *structure, rules.split, report);
    if (rules.split.cracks) open_cracks(work, *structure, rules.split, report);
    cut_films(work, *structure, rules.split, report);
  }
  const Thresholds& thresholds = rules.thresholds;
  for (int round = 0; round < thresholds.rounds; ++round)
    if (!thin(work, *structure, thresholds, report)) break;
  for (int round = 0; round < thresholds.rounds; ++round)
    if (!fill(work, *structure, thresholds, rules.placement, report)) break;
  balance(work, *structure, thresholds, report);
  report.volume_change = enclosed_measure(work.cloud(), rules.space) - enclosed_measure(cloud, rules.space);
  work.begin_with(structure->mesh.node, structure->mesh.neighbour);
  Resampling<2> change = work.finish();
  change.old_position = cloud.position;
  return change;
}

} // namespace cnem::adapt
