#pragma once
// Mass and volume of nodes are brought together again by exchange between neighbours, in the plane and in
// space.
#include "adapt/matter.hpp"
#include "adapt/pass_report.hpp"

#include <algorithm>

namespace cnem::adapt {

struct BalanceLimits {
  double light, heavy; ///< ρ₀V/(mJ) below which a node gives mass away, and above which it takes some
  int sweeps;
};

/// r_i = ρ₀ V_i/(m_i J_i) of one node, or the matter in its share over m_i, –. Structure: volume(node).
template<class Structure>
double volume_ratio(const Matter& matter, const Structure& structure, NodeIndex node) {
  const NodeProperties& p = matter.node();
  if (!p.matter.empty()) return p.matter[index_of(node)] / p.mass[index_of(node)];
  return p.density[index_of(node)] * structure.volume(node) /
         (p.mass[index_of(node)] * p.jacobian[index_of(node)]);
}

/// Neighbours whose ratios differ exchange half of what would make them equal, the worst nodes first.
/// Structure: volume(node) and neighbours(node).
template<class Structure>
void balance(Matter& matter, const Structure& structure, const BalanceLimits& limits, PassReport& report) {
  std::vector<std::pair<double, NodeIndex>> out;
  const auto distance = [](double r) { return std::max(r, 1.0 / r); };
  for (int sweep = 0; sweep < limits.sweeps; ++sweep) {
    out.clear();
    for (const NodeIndex i : IndexRange<NodeIndex>(matter.node().mass.size())) {
      const double r = volume_ratio(matter, structure, i);
      if (r < limits.light || r > limits.heavy) out.emplace_back(-distance(r), i);
    }
    if (out.empty()) return;
    std::sort(out.begin(), out.end());
    for (const auto& [order, i] : out) {
      for (const NodeIndex j : structure.neighbours(i)) {
        const double mine = volume_ratio(matter, structure, i), other = volume_ratio(matter, structure, j);
        if (mine >= limits.light && mine <= limits.heavy) break;
        // the ratio falls as mass comes: who has the larger one takes
        const bool takes = mine > limits.heavy;
        if (takes ? other >= mine : other <= mine) continue;
        const NodeIndex from = takes ? j : i, to = takes ? i : j;
        const NodeProperties& p = matter.node();
        const double wanted_from = p.mass[index_of(from)] * volume_ratio(matter, structure, from),
                     wanted_to = p.mass[index_of(to)] * volume_ratio(matter, structure, to);
        const double equal = (wanted_to * p.mass[index_of(from)] - wanted_from * p.mass[index_of(to)]) /
                             (wanted_from + wanted_to);
        const double fraction = 0.5 * equal / p.mass[index_of(from)];
        if (!(fraction > 1e-6)) continue;
        matter.move_now(from, to, fraction);
        ++report.balanced;
      }
    }
  }
}

} // namespace cnem::adapt
