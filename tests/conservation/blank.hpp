#pragma once
// A rectangle to resample: 1 m by 0.6 m, a density of 1.
#include "adapt/plane/resample.hpp"
#include "cnem/scni.hpp"
#include "core/index.hpp"
#include "tests/clouds.hpp"

#include <algorithm>
#include <cmath>
#include <gtest/gtest.h>

namespace cnem::adapt {

struct Blank {
  Cloud<2> cloud;
  NodeProperties node;

  /// Gives each node of the cloud the mass of its cell, nothing held.
  void weigh(double spacing, Space space = Space::plane) {
    const Structure structure = build_structure(cloud, space);
    node.mass.clear();
    for (const NodeIndex i : cloud.position.indices()) node.mass.push_back(structure.volume(i));
    const std::size_t n = node.mass.size();
    node.jacobian.assign(n, 1.0);
    node.density.assign(n, 1.0);
    node.size.assign(n, spacing);
    node.held.assign(n, 0);
  }
};

/// Equal cells, but for `jitter`.
inline Blank blank(double spacing, double jitter = 0.2) {
  Blank b;
  testing::add_loop(b.cloud, testing::rectangle(1.0, 0.6), spacing);
  testing::fill(b.cloud, testing::Lattice::hexagonal, spacing, jitter, 0.5 * spacing, 1);
  b.weigh(spacing);
  return b;
}

/// Gradients of C-NEM are exact for linear fields.
inline void expect_exact_patch(const Cloud<2>& cloud) {
  scni::Cnem method{scni::Options{}};
  const DiscreteOperators<2> op = method.rebuild(cloud).mechanics;
  double worst = 0.0;
  for (std::size_t p = 0; p < static_cast<std::size_t>(op.points); ++p) {
    Mat2 gradient = -Mat2::Identity();
    Vec2 sum = Vec2::Zero();
    double largest = 0.0;
    for (auto e = index_of(op.row_begin[p]); e < index_of(op.row_begin[p + 1]); ++e) {
      const Vec2 b(op.gradient[0][e], op.gradient[1][e]);
      const Vec2 x = cloud.position[op.node[e]] - cloud.position[p];
      gradient += x * b.transpose();
      sum += b;
      largest = std::max(largest, b.norm() * x.norm());
    }
    worst = std::max({worst, gradient.norm() / std::max(1.0, largest)});
    ASSERT_LT(sum.norm(), 1e-9 * (1.0 + largest) / std::sqrt(op.volume[p]));
  }
  ASSERT_LT(worst, 1e-10);
}

} // namespace cnem::adapt
