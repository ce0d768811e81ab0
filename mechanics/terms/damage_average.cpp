#include "mechanics/terms/damage_average.hpp"

#include "core/index.hpp"
#include "core/machine/parallel.hpp"
#include "mechanics/kinematics.hpp"

#include <algorithm>
#include <array>
#include <atomic>
#include <cmath>
#include <map>

namespace cnem {

template<int dim>
DamageAverage<dim>::DamageAverage(const std::vector<plasticity::Material>& materials) : active_(false) {
  for (const plasticity::Material& material : materials) {
    radius_.push_back(material.damage ? material.damage->length : 0.0);
    active_ = active_ || radius_.back() > 0.0;
  }
}

template<int dim>
void DamageAverage<dim>::list(const DiscreteOperators<dim>& operators, const Fields<dim>& reference,
                              const PointState<dim>& point) {
  const std::size_t n = point.size();
  Fields<dim> x;
  for (std::size_t k = 0; k < dim; ++k) {
    x[k].resize(n);
    interpolate<dim>(operators, reference[k], x[k], 0, n);
  }
  using Key = std::array<std::int64_t, dim>;
  const double side = *std::max_element(radius_.begin(), radius_.end());
  const auto key_of = [&](std::size_t p) {
    Key key;
    for (std::size_t k = 0; k < dim; ++k) key[k] = static_cast<std::int64_t>(std::floor(x[k][p] / side));
    return key;
  };
  std::map<Key, std::vector<std::int32_t>> grid;
  for (std::size_t p = 0; p < n; ++p) grid[key_of(p)].push_back(static_cast<std::int32_t>(p));
  begin_.assign(1, 0);
  other_.clear();
  weight_.clear();
  constexpr int around = dim == 2 ? 9 : 27;
  for (std::size_t p = 0; p < n; ++p) {
    const std::int32_t material = point.material[p];
    const double radius = radius_[index_of(material)];
    for (int c = 0; radius > 0.0 && c < around; ++c) {
      Key key = key_of(p);
      for (int k = 0, rest = c; k < dim; ++k, rest /= 3) key[index_of(k)] += rest % 3 - 1;
      const auto found = grid.find(key);
      if (found == grid.end()) continue;
      for (const std::int32_t q : found->second) {
        double squared = 0.0;
        for (std::size_t k = 0; k < dim; ++k) squared += std::pow((x[k][index_of(q)] - x[k][p]) / radius, 2);
        if (squared >= 1.0 || point.material[index_of(q)] != material) continue;
        other_.push_back(q);
        weight_.push_back((1.0 - squared) * (1.0 - squared) * operators.volume[index_of(q)]);
      }
    }
    begin_.push_back(other_.size());
  }
}

template<int dim> void DamageAverage<dim>::share(PointState<dim>& point) {
  growth_.resize(point.size());
  near_growth_.assign(point.size(), 0);
  for_each_block(point.size(), [&](std::size_t begin, std::size_t end) {
    for (std::size_t p = begin; p < end; ++p) {
      growth_[p] = point.damage[p] - before_[p];
      if (growth_[p] == 0.0) continue;
      for (std::size_t e = begin_[p]; e < begin_[p + 1]; ++e) // lists are symmetric
        std::atomic_ref(near_growth_[index_of(other_[e])]).store(1, std::memory_order_relaxed);
    }
  });
  for_each_block(point.size(), [&](std::size_t begin, std::size_t end) {
    for (std::size_t p = begin; p < end; ++p) {
      if (begin_[p] == begin_[p + 1] || before_[p] >= 1.0) continue;
      double sum = 0.0, total = 1.0;
      if (near_growth_[p]) {
        total = 0.0;
        for (std::size_t e = begin_[p]; e < begin_[p + 1]; ++e) {
          const std::size_t q = index_of(other_[e]);
          const double weight = before_[q] < 1.0 ? weight_[e] : 0.0;
          sum += weight * growth_[q];
          total += weight;
        }
      }
      point.damage[p] = std::min(before_[p] + sum / total, 1.0); // p itself is among them
      point.initiation_strain[p] = point.damage[p] >= 1.0 ? point.plastic_strain[p] : 0.0;
    }
  });
}

template class DamageAverage<2>;
template class DamageAverage<3>;

} // namespace cnem
