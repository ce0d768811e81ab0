#pragma once
// Which nodes are near a place in space.
#include "core/geometry/cloud.hpp"
#include "core/index.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <span>
#include <vector>

namespace cnem::adapt {

/// Nodes in the boxes of a grid of about the given spacing (m). O(N) to make.
class NodeGrid {
public:
  NodeGrid(std::span<const Vec3> position, double spacing) : position_(position) {
    Vec3 high = Vec3::Zero();
    if (!position.empty()) low_ = high = position.front();
    for (const Vec3& x : position) {
      low_ = low_.cwiseMin(x);
      high = high.cwiseMax(x);
    }
    // not many more boxes than nodes, however far these are apart
    const double most = 4.0 * static_cast<double>(position.size()) + 64.0;
    spacing_ = spacing;
    const auto count = [&] {
      double product = 1.0;
      for (Eigen::Index k = 0; k < 3; ++k) product *= std::floor((high - low_)[k] / spacing_) + 1.0;
      return product;
    };
    while (count() > most) spacing_ *= 1.5;
    for (std::size_t k = 0; k < 3; ++k)
      boxes_[k] = 1 + static_cast<std::ptrdiff_t>((high - low_)[static_cast<Eigen::Index>(k)] / spacing_);
    begin_.assign(index_of(boxes_[0] * boxes_[1] * boxes_[2]) + 1, 0);
    for (const Vec3& x : position) ++begin_[box_of(x) + 1];
    for (std::size_t b = 1; b < begin_.size(); ++b) begin_[b] += begin_[b - 1];
    node_.resize(position.size());
    std::vector<std::size_t> next(begin_.begin(), begin_.end() - 1);
    for (std::size_t i = 0; i < position.size(); ++i) node_[next[box_of(position[i])]++] = as<NodeIndex>(i);
  }

  /// visit(node, squared distance) for nodes nearer than `radius` to x, in an order that positions give.
  template<class Visit> void near(const Vec3& x, double radius, Visit&& visit) const {
    std::array<std::ptrdiff_t, 3> first{}, last{};
    for (std::size_t k = 0; k < 3; ++k) {
      const double at = x[static_cast<Eigen::Index>(k)] - low_[static_cast<Eigen::Index>(k)];
      const auto end = static_cast<double>(boxes_[k] - 1);
      first[k] = static_cast<std::ptrdiff_t>(std::clamp(std::floor((at - radius) / spacing_), 0.0, end));
      last[k] = static_cast<std::ptrdiff_t>(std::clamp(std::floor((at + radius) / spacing_), 0.0, end));
    }
    for (auto k = first[2]; k <= last[2]; ++k)
      for (auto j = first[1]; j <= last[1]; ++j)
        for (auto i = first[0]; i <= last[0]; ++i) {
          const auto box = index_of(i + boxes_[0] * (j + boxes_[1] * k));
          for (std::size_t n = begin_[box]; n < begin_[box + 1]; ++n) {
            const double squared = (position_[index_of(node_[n])] - x).squaredNorm();
            if (squared < radius * radius) visit(node_[n], squared);
          }
        }
  }

private:
  std::size_t box_of(const Vec3& x) const {
    std::array<std::ptrdiff_t, 3> b{};
    for (std::size_t k = 0; k < 3; ++k) {
      const auto c = static_cast<Eigen::Index>(k);
      b[k] = std::min(static_cast<std::ptrdiff_t>((x[c] - low_[c]) / spacing_), boxes_[k] - 1);
    }
    return index_of(b[0] + boxes_[0] * (b[1] + boxes_[1] * b[2]));
  }

  std::span<const Vec3> position_;
  Vec3 low_ = Vec3::Zero();
  double spacing_ = 1.0;
  std::array<std::ptrdiff_t, 3> boxes_{1, 1, 1};
  std::vector<std::size_t> begin_; ///< [box + 1]
  std::vector<NodeIndex> node_;    ///< box after box
};

} // namespace cnem::adapt
