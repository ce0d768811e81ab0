#include "adapt/plane/flow.hpp"

#include "core/index.hpp"

#include <algorithm>
#include <utility>

namespace cnem::adapt {

void Flow::look(const PointState<2>& point, const Structure& structure, double time) {
  constexpr double flows = 0.05, ceased = 0.5;
  Field power(rest_.size());
  double total = 0.0, squared = 0.0, rate = 0.0;
  for (std::size_t i = 0; i < power.size(); ++i) {
    power[i] = point.equivalent_stress[i] * point.plastic_rate[i];
    const double work = power[i] * structure.volume(as<NodeIndex>(i));
    total += work;
    squared += work * power[i];
    rate += work * point.plastic_rate[i];
  }
  const double passed = time - std::exchange(seen_, time);
  if (!(total > 0.0)) return;
  const double strain = rate / total * passed, least = flows * squared / total;
  for (std::size_t i = 0; i < power.size(); ++i)
    rest_[i] = power[i] >= least ? 0.0 : std::min(rest_[i] + strain / ceased, 1.0);
}

void Flow::archive(Archive& archive, std::size_t nodes) {
  if (archive.loading()) rest_.resize(nodes);
  archive.field("run/adapt/rest", "1", rest_);
  archive.number("run/adapt/rest_seen", "s", seen_);
}

} // namespace cnem::adapt
