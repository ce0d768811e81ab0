#pragma once
// What ways through broken matter are made of, whether they go through the body (split) or end inside
// (crack).
#include "adapt/plane/resample.hpp"
#include "core/index.hpp"

namespace cnem::adapt {

class BrokenMatter {
public:
  BrokenMatter(const WorkingCloud& work, const Structure& structure, const SplitRules& rules)
      : work_(work), structure_(structure), broken_(work.node().broken), rules_(rules) {}

protected:
  const Vec2& at(NodeIndex i) const { return work_.cloud().position[i]; }
  bool broken(NodeIndex i) const { return broken_[index_of(i)] >= 1.0; }

  /// On a face that separation has made.
  bool face(NodeIndex i) const {
    return work_.piece(i) == rules_.piece || work_.piece(work_.previous(i)) == rules_.piece;
  }

  /// ∫ ds/broken along an edge, m, times a factor.
  double cost_of(NodeIndex i, NodeIndex k, double factor = 1.0) const {
    return (at(k) - at(i)).norm() * factor * 2.0 / (broken_[index_of(i)] + broken_[index_of(k)]);
  }

  const WorkingCloud& work_;
  const Structure& structure_;
  const Field& broken_; ///< [node]
  const SplitRules& rules_;
};

} // namespace cnem::adapt
