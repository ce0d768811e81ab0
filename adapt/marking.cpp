#include "adapt/marking.hpp"

#include "core/geometry/mates.hpp"
#include "core/index.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <queue>

namespace cnem::adapt {

namespace {

/// The marks at one tolerance.
Field marked(const Field& spacing, const Indicator& indicator, const MarkingRules& rules, double tolerance,
             const Field& size, Marking& count) {
  const auto n = static_cast<double>(size.size());
  const double limit = tolerance * indicator.norm / std::sqrt(n);
  Field wanted = size;
  count = {0, 0, tolerance};
  constexpr double followed = 1.35; // a cloud this much coarser or finer than wanted is still to follow
  for (std::size_t i = 0; i < size.size(); ++i) {
    if (indicator.error[i] > limit && size[i] > rules.h_min) {
      if (spacing[i] > followed * size[i]) continue;
      wanted[i] = std::max(0.5 * size[i], rules.h_min);
      ++count.refined;
    } else if (indicator.error[i] < rules.coarsen * limit && size[i] < rules.h_max) {
      if (size[i] > followed * spacing[i]) continue;
      wanted[i] = std::min(2.0 * size[i], rules.h_max);
      ++count.coarsened;
    }
  }
  return wanted;
}

template<int dim> double sum_over_cells(const Field& volume, const Field& size) {
  double nodes = 0.0;
  for (std::size_t i = 0; i < size.size(); ++i) {
    double cell = cell_of_spacing<dim>;
    for (int k = 0; k < dim; ++k) cell *= size[i];
    nodes += volume[i] / cell;
  }
  return nodes;
}

} // namespace

double nodes_wanted(const Structure& structure, const Field& size) {
  return sum_over_cells<2>(structure.cells.volume, size);
}

double nodes_wanted(const SpaceStructure& structure, const Field& size) {
  return sum_over_cells<3>(structure.cell, size);
}

template<int dim>
Marking mark(const Cloud<dim>& cloud, const StructureOf<dim>& structure, const Indicator& indicator,
             const MarkingRules& rules, Field& size) {
  Marking count;
  if (!(indicator.norm > 0.0)) return count;
  const Field spacing = spacing_of(cloud, structure);
  constexpr double raise = 1.25;
  constexpr int most = 60;
  double tolerance = rules.tolerance;
  Field wanted = marked(spacing, indicator, rules, tolerance, size, count);
  const auto too_many = [&] {
    Field grown = wanted;
    limit_growth<dim>(cloud, structure, rules.growth, grown);
    return nodes_wanted(structure, grown) > static_cast<double>(rules.max_nodes);
  };
  for (int k = 0; k < most && count.refined > 0 && too_many(); ++k)
    wanted = marked(spacing, indicator, rules, tolerance *= raise, size, count);
  size = std::move(wanted);
  return count;
}

template<int dim>
void limit_growth(const Cloud<dim>& cloud, const StructureOf<dim>& structure, double growth, Field& size) {
  std::vector<std::array<NodeIndex, 2>> mates = mated_nodes(cloud);
  for (std::size_t k = mates.size(); k-- > 0;) mates.push_back({mates[k][1], mates[k][0]});
  std::sort(mates.begin(), mates.end());
  /// visit(k, limit) for all that a node of spacing h keeps to a limit it is above.
  const auto for_each_above = [&](NodeIndex i, double h, const auto& visit) {
    const auto look = [&](NodeIndex k, double limit) {
      if (limit < size[index_of(k)] * (1.0 - 1e-12)) visit(k, limit);
    };
    for (const NodeIndex k : structure.neighbours(i))
      look(k, h + growth * (cloud.position[k] - cloud.position[i]).norm());
    for (auto mate = std::lower_bound(mates.begin(), mates.end(), std::array{i, NodeIndex{}});
         mate != mates.end() && (*mate)[0] == i; ++mate)
      look((*mate)[1], h);
  };
  using Entry = std::pair<double, NodeIndex>;
  std::priority_queue<Entry, std::vector<Entry>, std::greater<>> front;
  for (const NodeIndex i : cloud.position.indices()) { // who lowers none now lowers none later
    bool lowers = false;
    for_each_above(i, size[index_of(i)], [&](NodeIndex, double) { lowers = true; });
    if (lowers) front.emplace(size[index_of(i)], i);
  }
  while (!front.empty()) {
    const auto [h, i] = front.top();
    front.pop();
    if (h > size[index_of(i)]) continue; // lowered since
    for_each_above(i, h, [&](NodeIndex k, double limit) {
      size[index_of(k)] = limit;
      front.emplace(limit, k);
    });
  }
}

template Marking mark<2>(const Cloud<2>&, const StructureOf<2>&, const Indicator&, const MarkingRules&,
                         Field&);
template void limit_growth<2>(const Cloud<2>&, const StructureOf<2>&, double, Field&);
template Marking mark<3>(const Cloud<3>&, const StructureOf<3>&, const Indicator&, const MarkingRules&,
                         Field&);
template void limit_growth<3>(const Cloud<3>&, const StructureOf<3>&, double, Field&);

} // namespace cnem::adapt
