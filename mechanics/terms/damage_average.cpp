#include "mechanics/terms/damage_average.hpp"

#include "core/index.hpp"
#include "core/machine/parallel.hpp"
#include "mechanics/kinematics.hpp"
#include "plasticity/initiated.hpp"

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
  group_begin_.assign(1, 0);
  other_.clear();
  weight_.clear();
  group_.clear();
  counts_.clear();
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
    for (std::size_t e = begin_.back(); e < other_.size(); ++e) {
      const std::int32_t group = other_[e] / group_size;
      const auto first = group_.begin() + static_cast<std::ptrdiff_t>(group_begin_.back());
      if (std::find(first, group_.end(), group) == group_.end()) group_.push_back(group);
    }
    begin_.push_back(other_.size());
    group_begin_.push_back(group_.size());
  }
}

template<int dim> bool DamageAverage<dim>::grows_near(std::size_t p) const {
  return std::any_of(group_.begin() + static_cast<std::ptrdiff_t>(group_begin_[p]),
                     group_.begin() + static_cast<std::ptrdiff_t>(group_begin_[p + 1]),
                     [&](std::int32_t group) { return group_grows_[index_of(group)] != 0; });
}

template<int dim>
std::array<double, DamageAverage<dim>::rows> DamageAverage<dim>::sums(std::size_t first,
                                                                      std::size_t last) const {
  std::array<double, rows> sum{};
  std::array<std::size_t, rows> begin{}, length{};
  for (std::size_t r = 0; r < last - first; ++r) {
    begin[r] = begin_[first + r];
    length[r] = begin_[first + r + 1] - begin[r];
  }
  const auto add = [&](std::size_t r, std::size_t k) {
    sum[r] += weight_[begin[r] + k] * growth_[index_of(other_[begin[r] + k])];
  };
  const std::size_t common = *std::min_element(length.begin(), length.end());
  for (std::size_t k = 0; k < common; ++k)
    for (std::size_t r = 0; r < rows; ++r) add(r, k);
  for (std::size_t r = 0; r < rows; ++r)
    for (std::size_t k = common; k < length[r]; ++k) add(r, k);
  return sum;
}

template<int dim> void DamageAverage<dim>::share(PointState<dim>& point) {
  static_assert(block_size % group_size == 0 && block_size % rows == 0, "a group is of one block");
  const std::size_t n = point.size();
  growth_.resize(n);
  total_.resize(n);
  group_grows_.assign(n / group_size + 1, 0);
  std::atomic<bool> changed = counts_.size() != n;
  counts_.resize(n);
  for_each_block(n, [&](std::size_t begin, std::size_t end) {
    for (std::size_t p = begin; p < end; ++p) {
      const char counts = !plasticity::generic::initiated(before_[p], point.softening[p]);
      growth_[p] = counts ? point.damage[p] - before_[p] : 0.0;
      if (growth_[p] != 0.0) group_grows_[p / group_size] = 1;
      if (counts == counts_[p]) continue;
      counts_[p] = counts;
      changed.store(true, std::memory_order_relaxed);
    }
  });
  const bool stale = changed;
  for_each_block(n, [&](std::size_t begin, std::size_t end) {
    for (std::size_t p = begin; stale && p < end; ++p) {
      total_[p] = 0.0;
      for (std::size_t e = begin_[p]; e < begin_[p + 1]; ++e)
        if (counts_[index_of(other_[e])]) total_[p] += weight_[e];
    }
    for (std::size_t first = begin; first < end; first += rows) {
      const std::size_t last = std::min(first + rows, end);
      bool grows = false;
      for (std::size_t p = first; p < last && !grows; ++p) grows = grows_near(p);
      const std::array<double, rows> sum = grows ? sums(first, last) : std::array<double, rows>{};
      for (std::size_t p = first; p < last; ++p) {
        if (begin_[p] == begin_[p + 1] || !counts_[p]) continue;
        point.damage[p] = std::min(before_[p] + sum[p - first] / total_[p], 1.0); // p itself is among them
        point.initiation_strain[p] = plasticity::generic::initiated(point.damage[p], point.softening[p])
                                         ? point.plastic_strain[p]
                                         : 0.0;
      }
    }
  });
}

template class DamageAverage<2>;
template class DamageAverage<3>;

} // namespace cnem
